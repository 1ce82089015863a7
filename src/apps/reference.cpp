// chiaro reference: per-pixel path tracing, the ground truth.

#include "apps/commands.h"
#include "apps/open_scene.h"
#include "apps/output.h"
#include "base/error.h"
#include "image_generator/view_curves.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/reference_renderer.h"

#include <chrono>
#include <cmath>

namespace chiaro {

int reference_command(const Options& options) {
    constexpr int kDefaultSpp = 64;
    check_outputs(options);
    check_only_path(options);
    if (options.spp && (*options.spp < 1 || *options.spp > 1 << 24))
        throw Error("--spp", "it must lie between 1 and 16777216");
    check_time(options);
    const int threads = thread_count(options);
    const PictureSize size = parse_size(options.size);
    Scene scene = open_scene(options);
    Camera camera = choose_camera(scene, options);
    apply_edits(scene, camera, options);

    RayCaster rays(scene, threads, curve_tolerance(options));
    const View view(camera, size.width, size.height);
    show_curves(rays, view, threads);
    const AreaLights area_lights(scene);
    ReferenceRenderer renderer(make_lit_scene(scene, rays, area_lights), view,
                               {short_seed(options.seed), threads});

    catch_interrupts();
    ProgressBar bar;
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const int spp = options.spp.value_or(options.time ? 1 << 24 : kDefaultSpp);
    const double seconds = options.time.value_or(INFINITY);
    do {
        renderer.add_pass(1);
        const int done = static_cast<int>(renderer.samples());
        bar.show(std::max(static_cast<double>(done) / spp, elapsed() / seconds),
                 std::to_string(done) + " samples a pixel");
    } while (!interrupted() && elapsed() < seconds && static_cast<int>(renderer.samples()) < spp);
    save_picture(options.output, options, renderer.image());
    return 0;
}

}  // namespace chiaro
