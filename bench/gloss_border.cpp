// Which gloss the cache should keep, and which is for rays a pixel: the error of a glossy thing's
// pixels after the same processor time, by roughness, with the border below and above it. Prints
// JSON.
//
// usage: gloss_border [SECONDS]

#include "base/tone_map.h"
#include "figures.h"
#include "run_program.h"
#include "sample_renderer/gather_renderer.h"
#include "sample_renderer/reference_renderer.h"
#include "scene/shapes.h"
#include "update/update_cycle.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace chiaro {
namespace {

enum class Thing { floor, ball };
enum class Kind { metal, plastic };

constexpr int kWidth = 240, kHeight = 180;
constexpr double kReferenceSeconds = 8;  // of each half
constexpr MaterialId kWall{0}, kRed{1}, kBlue{2}, kLamp{3}, kGlossy{4};

Material paint(Rgb color) {
    Material m;
    m.base_color = color;
    return m;
}

// A room of 6 x 3 x 6 m with coloured walls, two boxes and a panel under the ceiling; its floor, or
// a ball in it, is glossy.
Scene make_room(Thing thing, Kind kind, float roughness) {
    Scene scene;
    scene.materials = {paint(Rgb(0.7f)), paint({0.7f, 0.15f, 0.1f}), paint({0.1f, 0.2f, 0.6f}),
                       paint(Rgb(0)),
                       paint(kind == Kind::metal ? Rgb(0.9f, 0.8f, 0.6f) : Rgb(0.3f))};
    scene.materials[index_of(kLamp)].emission = Rgb(20);
    scene.materials[index_of(kGlossy)].gloss = {.model = GlossModel::metallic_roughness,
                                                .metallic = kind == Kind::metal ? 1.0f : 0.0f,
                                                .roughness = roughness};
    const auto put = [&scene](const Mesh& part, MaterialId material) {
        Mesh mesh;
        add(mesh, part, material);
        scene.meshes.push_back(std::move(mesh));
        scene.objects.push_back({.mesh = static_cast<MeshId>(scene.meshes.size() - 1)});
    };
    put(quad({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}),
        thing == Thing::floor ? kGlossy : kWall);
    put(quad({-3, 3, -3}, {3, 3, -3}, {3, 3, 3}, {-3, 3, 3}), kWall);
    put(quad({-3, 0, -3}, {3, 0, -3}, {3, 3, -3}, {-3, 3, -3}), kWall);
    put(quad({3, 0, 3}, {-3, 0, 3}, {-3, 3, 3}, {3, 3, 3}), kWall);
    put(quad({-3, 0, 3}, {-3, 0, -3}, {-3, 3, -3}, {-3, 3, 3}), kRed);
    put(quad({3, 0, -3}, {3, 0, 3}, {3, 3, 3}, {3, 3, -3}), kBlue);
    put(quad({-0.6f, 2.99f, -1.2f}, {0.6f, 2.99f, -1.2f}, {0.6f, 2.99f, -0.2f},
             {-0.6f, 2.99f, -0.2f}),
        kLamp);
    put(box({-2, 0, -2.2f}, {-1.2f, 1.6f, -1.4f}, kBottom), kRed);
    put(box({1, 0, -2.4f}, {1.8f, 0.8f, -1.6f}, kBottom), kWall);
    if (thing == Thing::ball) {
        std::vector<Vec2> profile;
        for (int i = 0; i <= 24; ++i) {
            const float angle = kPi * static_cast<float>(i) / 24;
            profile.emplace_back(0.8f * std::sin(angle), 0.9f - 0.8f * std::cos(angle));
        }
        put(lathe(profile, 48), kGlossy);
    }
    check_scene(scene);
    return scene;
}

View look_at_it() {
    Camera camera;
    camera.eye = {0, 1.4f, 2.8f};
    camera.target = {0, 0.7f, -1};
    camera.vertical_fov = 50;
    return View(camera, kWidth, kHeight);
}

struct Stage {
    Scene scene;
    RayCaster rays;
    AreaLights area_lights;
    MeshGraphs graphs;
    View view = look_at_it();

    explicit Stage(Scene s)
        : scene(std::move(s)),
          rays(scene, 1),
          area_lights(scene),
          graphs(scene, coarser_levels(Scheme::best), 1) {}
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
};

Image reference(const Stage& stage, std::uint32_t seed) {
    const LitScene lit = make_lit_scene(stage.scene, stage.rays, stage.area_lights);
    ReferenceRenderer renderer(lit, stage.view, {.seed = seed, .threads = 1});
    const double start = processor_seconds();
    while (processor_seconds() - start < kReferenceSeconds) renderer.add_pass(8);
    return renderer.image();
}

// What is glossy is cached from facets of width `cached` on.
Image picture(Stage& stage, float cached, double seconds) {
    OpenSides open_sides(stage.scene);
    GatherRenderer renderer(stage.scene, stage.rays, stage.area_lights, &open_sides, 1);
    UpdateSettings settings;
    settings.cached_facets = cached;
    UpdateCycle cycle(stage.rays, stage.graphs, renderer, open_sides, settings);
    const double start = processor_seconds();
    cycle.look_from(stage.view);
    while (processor_seconds() - start < seconds) cycle.run();
    return cycle.picture();
}

// Of the pixels in which the glossy material is seen [dB], as difference() has it.
double psnr(const Stage& stage, const Image& a, const Image& half_1, const Image& half_2) {
    Image mean = half_1;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = 0.5f * (half_1.pixels[i] + half_2.pixels[i]);
    const float k = comparison_exposure(mean);
    const auto curve = [k](float x) { return double(comparison_curve(std::max(x, 0.0f) * k)); };
    double sum = 0;
    int count = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const Ray ray =
                stage.view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            Hit hit;
            stage.rays.intersect({&ray, 1}, {&hit, 1}, RayKind::camera);
            if (!hit || material_of(stage.scene, hit.point) != kGlossy) continue;
            for (int c = 0; c < 3; ++c) {
                const double value = curve(a.at(x, y)[c]);
                sum += (value - curve(half_1.at(x, y)[c])) * (value - curve(half_2.at(x, y)[c]));
                ++count;
            }
        }
    return -10 * std::log10(std::max(sum / count, 1e-9));
}

}  // namespace

int run_gloss_border(int argc, char** argv) {
    const double seconds = argc > 1 ? std::atof(argv[1]) : 3;
    fmt::print("{{\"seconds\": {}, \"rows\": [", seconds);
    const char* comma = "";
    for (const Thing thing : {Thing::floor, Thing::ball})
        for (const Kind kind : {Kind::metal, Kind::plastic})
            for (const float roughness : {0.15f, 0.2f, 0.25f, 0.3f, 0.4f, 0.6f}) {
                Stage stage(make_room(thing, kind, roughness));
                const std::array halves = {reference(stage, 1), reference(stage, 2)};
                const auto error = [&](float cached) {
                    return psnr(stage, picture(stage, cached, seconds), halves[0], halves[1]);
                };
                fmt::print(
                    "{}\n  {{\"thing\": \"{}\", \"kind\": \"{}\", \"roughness\": {:.2f}, "
                    "\"pixels_psnr\": {:.2f}, \"cached_psnr\": {:.2f}}}",
                    comma, thing == Thing::floor ? "floor" : "ball",
                    kind == Kind::metal ? "metal" : "plastic", roughness, error(kInfinity),
                    error(0));
                std::fflush(stdout);
                comma = ",";
            }
    fmt::print("\n]}}\n");
    return 0;
}

}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run_gloss_border);
}
