// Error against the reference over time, for the best scheme, the paper's and per-pixel path
// tracing, in one run on one machine with the same rays and lights. Prints JSON.
//
// The reference comes in two independent halves, and errors are cross products with both, so that
// its own noise cancels. Time is wall time after loading. The cache is charged with drawing the
// picture that is measured, once; pictures drawn before it, only to be measured, are free.

#include "apps/open_scene.h"
#include "base/image_difference.h"
#include "base/random.h"
#include "import/image_file.h"
#include "run_program.h"
#include "sample_renderer/gather_renderer.h"
#include "sample_renderer/path_renderer.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/reference_renderer.h"

#include <fmt/format.h>

#include <bit>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace chiaro {
namespace {

using Clock = std::chrono::steady_clock;

struct Reference {
    Image half_1, half_2;
};

// All that the methods share.
struct Stage {
    Scene scene;
    RayCaster rays;
    AreaLights area_lights;
    View view;
    int threads;

    Stage(Scene s, const Camera& camera, const PictureSize& size, int n)
        : scene(std::move(s)),
          rays(scene, n),
          area_lights(scene),
          view(camera, size.width, size.height),
          threads(n) {}
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
};

// Tells scenes and cameras apart, so that no reference is taken for another's.
std::uint32_t fingerprint(const Scene& scene, const View& view) {
    std::uint32_t h = 0;
    const auto add = [&](float x) { h = hash32(h, std::bit_cast<std::uint32_t>(x)); };
    const auto add_vector = [&](Vec3 v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    };
    for (const Mesh& mesh : scene.meshes)
        for (const Vec3& p : mesh.positions) add_vector(p);
    for (const Material& m : scene.materials) {
        add_vector(m.base_color);
        add_vector(m.emission);
    }
    for (const PunctualLight& light : scene.lights) add_vector(light.intensity);
    for (const float corner : {0.0f, 100.0f}) {
        const Ray ray = view.ray(corner, corner);
        add_vector(ray.origin);
        add_vector(ray.direction);
    }
    return h;
}

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

Image reference_half(const Stage& stage, int spp, std::uint32_t seed, const std::string& file) {
    if (std::filesystem::exists(file)) return read_image(file);
    ReferenceRenderer renderer(make_lit_scene(stage.scene, stage.rays, stage.area_lights),
                               stage.view, {seed, stage.threads});
    renderer.add_pass(static_cast<std::uint32_t>(spp));
    const Image image = renderer.image();
    write_exr(file, image);
    return image;
}

// Times at which to measure: each a fifth later than the one before.
struct Checkpoints {
    double next = 0.02;
    bool due(double seconds) {
        if (seconds < next) return false;
        while (next <= seconds) next *= 1.2;
        return true;
    }
};

nlohmann::json row(double seconds, const Image& picture, const Reference& reference) {
    const ImageDifference d = difference(picture, reference.half_1, reference.half_2);
    return {{"seconds", seconds}, {"psnr", d.psnr}, {"relmse", d.relmse}};
}

template <typename Renderer>
nlohmann::json measure_cache(const Stage& stage, Scheme scheme, double seconds,
                             const Reference& reference) {
    OpenSides open_sides(stage.scene);
    Renderer renderer(stage.scene, stage.rays, stage.area_lights, &open_sides, stage.threads);
    UpdateSettings settings;
    settings.scheme = scheme;
    settings.threads = stage.threads;

    nlohmann::json rows = nlohmann::json::array();
    Checkpoints checkpoints;
    double spent = 0;
    auto start = Clock::now();
    UpdateCycle cycle(stage.rays, stage.graphs, renderer, open_sides, settings);
    cycle.look_from(stage.view);
    for (bool first = true; spent < seconds; first = false) {
        cycle.run();
        spent += seconds_since(start);
        if (first || checkpoints.due(spent)) {
            const auto drawing = Clock::now();
            const Image picture = cycle.picture();
            // A picture that is looked at has to be drawn once.
            const double draw_seconds = seconds_since(drawing);
            rows.push_back(row(spent + draw_seconds, picture, reference));
            rows.back()["bytes_per_patch"] = static_cast<double>(cycle.bytes()) /
                                             static_cast<double>(cycle.cache().patches().size());
            rows.back()["points"] = cycle.statistics().points_shaded;
        }
        start = Clock::now();
    }
    return rows;
}

nlohmann::json measure_path_tracing(const Stage& stage, double seconds,
                                    const Reference& reference) {
    nlohmann::json rows = nlohmann::json::array();
    Checkpoints checkpoints;
    double spent = 0;
    auto start = Clock::now();
    ReferenceRenderer renderer(make_lit_scene(stage.scene, stage.rays, stage.area_lights),
                               stage.view, {77, stage.threads});
    while (spent < seconds) {
        renderer.add_pass(1);
        spent += seconds_since(start);
        if (renderer.samples() <= 4 || checkpoints.due(spent)) {
            rows.push_back(row(spent, renderer.image(), reference));
            rows.back()["spp"] = renderer.samples();
        }
        start = Clock::now();
    }
    return rows;
}

}  // namespace

int run(int argc, char** argv) {
    Options options;
    double seconds = 20, path_seconds = 60;
    int spp = 256;
    std::string name = "scene", folder = "out/quality";
    CLI::App app("Error over time of the Shading Cache and of path tracing.");
    add_scene_options(app, options);
    add_view_options(app, options);
    add_render_options(app, options);
    app.add_option("--seconds", seconds, "for each scheme of the cache");
    app.add_option("--path-seconds", path_seconds, "for path tracing");
    app.add_option("--spp", spp, "paths a pixel of each half of the reference");
    app.add_option("--name", name, "of the scene, in the files that are kept");
    app.add_option("--folder", folder, "where references are kept");
    CLI11_PARSE(app, argc, argv);

    const int threads = thread_count(options);
    const PictureSize size = parse_size(options.size);
    Scene scene = open_scene(options);
    const Camera camera = choose_camera(scene, options);
    add_headlamp_if_dark(scene, camera);
    const Stage stage(std::move(scene), camera, size, threads);

    std::filesystem::create_directories(folder);
    const std::string stem = fmt::format("{}/{}_{}_{}_{:08x}", folder, name, options.size, spp,
                                         fingerprint(stage.scene, stage.view));
    const Reference reference = {reference_half(stage, spp, 1001, stem + "_1.exr"),
                                 reference_half(stage, spp, 1002, stem + "_2.exr")};
    nlohmann::ordered_json result;
    result["scene"] = name;
    result["size"] = options.size;
    result["threads"] = threads;
    result["reference_spp"] = 2 * spp;
    result["methods"]["best"] =
        measure_cache<GatherRenderer>(stage, Scheme::best, seconds, reference);
    result["methods"]["best, traced"] =
        measure_cache<PathRenderer>(stage, Scheme::best, seconds, reference);
    result["methods"]["paper"] =
        measure_cache<PathRenderer>(stage, Scheme::paper, seconds, reference);
    result["methods"]["path"] = measure_path_tracing(stage, path_seconds, reference);
    std::printf("%s\n", result.dump(1).c_str());
    return 0;
}

}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run);
}
