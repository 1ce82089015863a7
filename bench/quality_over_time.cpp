// Error against the reference over time, for schemes of the cache and per-pixel path tracing, in
// one run on one machine with the same rays and lights. Prints JSON.
//
// The reference comes in two independent halves, and errors are cross products with both, so that
// its own noise cancels. Time is wall time after loading. The cache is charged with drawing the
// picture that is measured, once; pictures drawn before it, only to be measured, are free.
//
// --bisect halves the scene's edges until they are short. Its surfaces stay where they are, and so
// the reference is that of the plain scene.

#include "apps/open_scene.h"
#include "base/error.h"
#include "base/random.h"
#include "base/tone_map.h"
#include "figures.h"
#include "import/image_file.h"
#include "import/resolve_edits.h"
#include "quality_methods.h"
#include "run_program.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/reference_renderer.h"
#include "scene/bisect_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace chiaro {
namespace {

struct Settings {
    double seconds = 20, path_seconds = 60;
    int spp = 256;
    std::string name = "scene", folder = "out/quality";
    float bisect = 0;
    std::vector<std::string> methods = {"best", "traced", "paper", "path"};
    std::string changes;
    double before = 10;
    std::string pictures;
    std::vector<double> picture_times = {0.25, 0.5, 1, 2, 4};
};

void add_options(CLI::App& app, Settings& s) {
    app.add_option("--seconds", s.seconds, "for each scheme of the cache");
    app.add_option("--path-seconds", s.path_seconds, "for path tracing");
    app.add_option("--spp", s.spp, "paths a pixel of each half of the reference");
    app.add_option("--name", s.name, "of the scene, in the files that are kept");
    app.add_option("--folder", s.folder, "where references are kept");
    app.add_option("--bisect", s.bisect,
                   "halve edges until none is longer than this part of the scene's diagonal, as "
                   "200 for 1/200")
        ->check(CLI::PositiveNumber);
    app.add_option("--changes", s.changes,
                   "an edit script: the picture that is measured is that of the edited scene, "
                   "which is new to all methods but `edited`");
    app.add_option("--before", s.before, "seconds for which `edited` has known the scene before");
    app.add_option("--methods", s.methods,
                   "of best, roots, traced, bidirectional, paper, edited, path")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--pictures", s.pictures, "a folder for pictures at several times");
    app.add_option("--picture-times", s.picture_times, "those times in seconds, ascending")
        ->delimiter(',')
        ->allow_extra_args(false);
}

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
    for (const PunctualLight& light : scene.lights) {
        add_vector(light.on ? light.intensity : Rgb(0));
        add_vector(light.position);
        add_vector(light.direction);
    }
    for (const Object& object : scene.objects) {
        add_vector(object.shown ? object.emission_scale : Rgb(-1));
        for (int i = 0; i < 4; ++i) add_vector(Vec3(object.to_world[i]));
    }
    for (const float corner : {0.0f, 100.0f}) {
        const Ray ray = view.ray(corner, corner);
        add_vector(ray.origin);
        add_vector(ray.direction);
    }
    return h;
}

// Halves that were made before are read from their files, which begin with `stem`.
Reference find_reference(const Scene& scene, const View& view, int threads, int spp,
                         const std::string& stem) {
    std::optional<Stage> stage;
    const auto half = [&](int number) {
        const std::string file = fmt::format("{}_{}.exr", stem, number);
        if (std::filesystem::exists(file)) return read_image(file);
        if (!stage) stage.emplace(scene, view, threads);
        ReferenceRenderer renderer(make_lit_scene(stage->scene, stage->rays, stage->area_lights),
                                   view, {1000u + number, threads});
        renderer.add_pass(static_cast<std::uint32_t>(spp));
        const Image image = renderer.image();
        write_exr(file, image);
        return image;
    };
    return {half(1), half(2)};
}

Image mean(const Reference& reference) {
    Image image = reference.half_1;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = 0.5f * (image.pixels[i] + reference.half_2.pixels[i]);
    return image;
}

}  // namespace

int run(int argc, char** argv) {
    Options options;
    Settings settings;
    CLI::App app("Error over time of the Shading Cache and of path tracing.");
    add_scene_options(app, options);
    add_view_options(app, options);
    add_render_options(app, options);
    add_options(app, settings);
    CLI11_PARSE(app, argc, argv);

    std::vector<const Method*> methods;
    for (const std::string& name : settings.methods) methods.push_back(&method_of(name));
    if (settings.changes.empty() &&
        std::ranges::any_of(methods, [](const Method* m) { return m->edited; }))
        throw Error("--methods", "'edited' has no edits", "give a script by --changes");
    const int threads = thread_count(options);
    const PictureSize size = parse_size(options.size);
    Scene scene = open_scene(options);
    Camera camera = choose_camera(scene, options);
    add_headlamp_if_dark(scene, camera);
    std::optional<Before> before;
    if (!settings.changes.empty()) {
        before = {scene, camera, resolve_edits(read_edits(settings.changes), scene, camera),
                  settings.before};
        for (const Edit& edit : before->edits) apply(scene, camera, edit);
    }
    const View view(camera, size.width, size.height);

    std::filesystem::create_directories(settings.folder);
    const std::string stem = fmt::format("{}/{}_{}_{}_{:08x}", settings.folder, settings.name,
                                         options.size, settings.spp, fingerprint(scene, view));
    const Reference reference = find_reference(scene, view, threads, settings.spp, stem);

    const Stopwatch bisecting;
    if (settings.bisect > 0) bisect_edges(scene, bounds(scene).diagonal() / settings.bisect);
    const double bisecting_seconds = bisecting.seconds();
    Stage stage(std::move(scene), view, threads);

    const Image truth = mean(reference);
    const Measuring measuring = {
        .stage = stage,
        .reference = reference,
        .seconds = settings.seconds,
        .path_seconds = settings.path_seconds,
        .picture_folder = settings.pictures,
        .picture_times = settings.picture_times,
        .exposure = options.exposure ? std::exp2(*options.exposure) : automatic_exposure(truth),
        .before = before ? &*before : nullptr};
    if (!settings.pictures.empty()) {
        std::filesystem::create_directories(settings.pictures);
        keep_picture(measuring, "reference", truth);
    }

    nlohmann::ordered_json result;
    result["scene"] = settings.name;
    result["size"] = options.size;
    result["threads"] = threads;
    result["reference_spp"] = 2 * settings.spp;
    result["bisect"] = settings.bisect;
    result["loading"] = {{"triangles", triangle_count(stage.scene)},
                         {"bisecting_seconds", bisecting_seconds},
                         {"embree_seconds", stage.loading.embree_seconds},
                         {"embree_bytes", stage.loading.embree_bytes},
                         {"area_lights_seconds", stage.loading.area_lights_seconds}};
    for (const Method* method : methods) {
        nlohmann::ordered_json measured = measure(*method, measuring);
        result["methods"][method->title] = measured["rows"];
        measured.erase("rows");
        result["of_methods"][method->title] = measured;
    }
    std::printf("%s\n", result.dump(1).c_str());
    return 0;
}

}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run);
}
