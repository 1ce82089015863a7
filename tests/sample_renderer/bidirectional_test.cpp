// The renderer `bidirectional` against `path`, which finds all that it finds by other ways.
#include "sample_renderer/bidirectional_renderer.h"

#include "sample_renderer/glossy_scenes.h"
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

namespace chiaro::tiny {
namespace {

struct Estimate {
    double mean = 0, variance = 0;  // of the mean
};

// Luminance of the indirect light at a place, by seeds whose scatter tells the variance.
Estimate estimate(SampleRenderer& renderer, const MeterPlace& place, std::uint32_t samples) {
    constexpr std::uint32_t kSeeds = 64;
    std::vector<ShadeRequest> requests;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed)
        requests.push_back(
            {.place = place,
             .light = Light::indirect,
             .seed = hash32(seed + (getenv("SALT") ? 1000 * atoi(getenv("SALT")) : 0)),
             .samples = (getenv("MORE") ? atoi(getenv("MORE")) : 1) * samples / kSeeds});
    std::vector<ShadeResult> results(kSeeds);
    renderer.shade(requests, results);
    Estimate e;
    double squares = 0;
    for (const ShadeResult& r : results) {
        const double y = luminance(r.mean);
        e.mean += y / kSeeds;
        squares += y * y / kSeeds;
    }
    e.variance = (squares - e.mean * e.mean) / (kSeeds - 1);
    return e;
}

// 6 standard errors, as the scatter over 64 seeds of each tells them: false alarm about 1e-7 a
// place (Student's t of 63 degrees at least).
void expect_agreement(Scene scene, std::span<const MeterPlace> places, std::uint32_t samples,
                      const char* what) {
    const Meter meter(std::move(scene));
    PathRenderer path(meter.scene, meter.caster, meter.area_lights, nullptr, 1);
    BidirectionalRenderer joined(meter.scene, meter.caster, meter.area_lights, nullptr, 1);
    for (const MeterPlace& place : places) {
        const Estimate a = estimate(path, place, samples);
        const Estimate b = estimate(joined, place, samples / 4);
        const double error = std::sqrt(a.variance + b.variance);
        std::printf("%-22s %9.5f %9.5f  z %5.2f  rel %.2f%% (path %.2f%%)\n", what, a.mean, b.mean,
                    (b.mean - a.mean) / error, 100 * error / a.mean,
                    100 * std::sqrt(a.variance) / a.mean);
        EXPECT_NEAR(b.mean, a.mean, 6 * error) << what << " " << place.position.x;
    }
}

const MeterPlace kPlaces[] = {{{0.3f, 0.2f, 0.001f}, {0, 0, 1}}, {{1.9f, 1.3f, 0.4f}, {-1, 0, 0}}};
const MeterPlace kFloor[] = {{{0.3f, 0.2f, 0.001f}, {0, 0, 1}}};

// A room of 4 x 4 x 3 with a block in it.
Scene room(MaterialId (*walls)(Scene&), MaterialId (*block)(Scene&)) {
    Scene scene;
    const MaterialId of_walls = walls(scene);
    add_room(scene, {-2, -2, 0}, {2, 2, 3}, of_walls);
    add_box(scene, {-1, -0.8f, 0.3f}, {-0.2f, 0.6f, 1.1f}, block(scene));
    return scene;
}
MaterialId grey(Scene& scene) {
    return add_material(scene, {0.7f, 0.5f, 0.3f});
}
MaterialId brushed(Scene& scene) {
    return add_glossy(scene, Rgb(0.8f, 0.7f, 0.6f), metal(0.5f));
}
MaterialId shiny(Scene& scene) {
    return add_glossy(scene, Rgb(0.5f), plastic(0.3f));
}
MaterialId lacquer(Scene& scene) {
    return add_glossy(scene, Rgb(0.5f), plastic(0));
}
MaterialId mirror(Scene& scene) {
    return add_glossy(scene, Rgb(0.9f), metal(0));
}
MaterialId clear_glass(Scene& scene) {
    return add_glossy(scene, Rgb(1), glass(0, false));
}
MaterialId ground_glass(Scene& scene) {
    return add_glossy(scene, Rgb(0.9f), glass(0.4f, false));
}
MaterialId clear_pane(Scene& scene) {
    return add_glossy(scene, {0.9f, 0.6f, 0.6f}, glass(0, true));
}
MaterialId ground_pane(Scene& scene) {
    return add_glossy(scene, Rgb(0.9f), glass(0.4f, true));
}

void add_lamp(Scene& scene) {
    add_quad(scene, {-0.6f, -0.5f, 2.9f}, {0, 1, 0}, {1.2f, 0, 0},
             add_material(scene, Rgb(0.3f), Rgb(10)));
}

TEST(Bidirectional, AgreesWithPathsAtAreaLights) {
    const std::tuple<const char*, MaterialId (*)(Scene&), MaterialId (*)(Scene&)> all[] = {
        {"diffuse", grey, grey},
        {"brushed", grey, brushed},
        {"brushed room", brushed, brushed},
        {"plastic room", shiny, shiny},
        {"lacquer", lacquer, lacquer},
        {"mirror", grey, mirror},
        {"clear glass", grey, clear_glass},
        {"ground glass", grey, ground_glass},
        {"pane", grey, clear_pane},
        {"ground pane", grey, ground_pane}};
    for (const auto& [name, walls, block] : all) {
        Scene scene = room(walls, block);
        add_lamp(scene);
        expect_agreement(std::move(scene), kPlaces, 1 << 17, name);
    }
}

TEST(Bidirectional, AgreesWithPathsAtLampsAndSuns) {
    const std::pair<const char*, MaterialId (*)(Scene&)> all[] = {{"diffuse", grey},
                                                                  {"plastic", shiny},
                                                                  {"brushed", brushed},
                                                                  {"ground glass", ground_glass},
                                                                  {"pane", clear_pane}};
    for (const auto& [name, block] : all) {
        for (int kind = 0; kind < 3; ++kind) {
            Scene scene = room(grey, block);
            if (kind == 2) {
                scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin() + 1);
                --scene.meshes[0].quad_count;
                scene.lights.push_back(sun({0.3f, 0.2f, -1}, Rgb(5)));
                scene.lights.push_back(sun({-0.3f, 0.4f, -1}, Rgb(2)));
            } else {
                scene.lights.push_back(point_light({0.5f, 1, 2}, Rgb(20)));
                if (kind == 1) {
                    scene.lights.back().kind = LightKind::spot;
                    scene.lights.back().direction = glm::normalize(Vec3(-1, -1, -1.2f));
                    scene.lights.back().inner_cone = 0.3f;
                    scene.lights.back().outer_cone = 0.6f;
                    scene.lights.push_back(point_light({-1.5f, -1.5f, 2}, Rgb(5)));
                }
            }
            expect_agreement(std::move(scene), kPlaces, 1 << 16, name);
        }
    }
}

TEST(Bidirectional, AgreesWithPathsAboutLeaningNormals) {
    const std::pair<const char*, MaterialId (*)(Scene&)> all[] = {
        {"diffuse ball", grey},           {"brushed ball", brushed},
        {"plastic ball", shiny},          {"mirror ball", mirror},
        {"lacquer ball", lacquer},        {"glass ball", clear_glass},
        {"ground ball", ground_glass},    {"pane ball", clear_pane},
        {"ground pane ball", ground_pane}};
    for (const auto& [name, material] : all) {
        Scene scene;
        add_room(scene, {-2, -2, 0}, {2, 2, 3}, grey(scene));
        add_ball(scene, {-0.4f, 0.2f, 1}, 0.8f, material(scene));
        add_lamp(scene);
        expect_agreement(std::move(scene), kPlaces, 1 << 17, name);
    }
}

TEST(Bidirectional, AgreesWithPathsAtLampsAboutLeaningNormals) {
    const std::pair<const char*, MaterialId (*)(Scene&)> all[] = {{"diffuse ball", grey},
                                                                  {"brushed ball", brushed},
                                                                  {"plastic ball", shiny},
                                                                  {"ground ball", ground_glass}};
    for (const auto& [name, material] : all) {
        Scene scene;
        add_room(scene, {-2, -2, 0}, {2, 2, 3}, grey(scene));
        add_ball(scene, {-0.4f, 0.2f, 1}, 0.8f, material(scene));
        scene.lights.push_back(point_light({0.5f, 1, 2}, Rgb(20)));
        expect_agreement(std::move(scene), kPlaces, 1 << 17, name);
    }
}

TEST(Bidirectional, AgreesWithPathsInOddRooms) {
    {  // lamp in a box with a gap
        Scene scene;
        add_room(scene, {-2, -2, 0}, {2, 2, 3}, grey(scene));
        const MaterialId white = add_material(scene, Rgb(0.9f));
        add_box(scene, {-1, -1, 1.5f}, {1, 1, 1.55f}, white);
        add_box(scene, {-1, -1, 1.6f}, {-0.95f, 1, 2.5f}, white);
        add_box(scene, {0.95f, -1, 1.6f}, {1, 1, 2.5f}, white);
        add_box(scene, {-1, -1, 1.6f}, {1, -0.95f, 2.5f}, white);
        add_box(scene, {-1, 0.95f, 1.6f}, {1, 1, 2.5f}, white);
        add_box(scene, {-1, -1, 2.5f}, {1, 1, 2.55f}, white);
        add_quad(scene, {-0.1f, -0.1f, 2.3f}, {0, 0.2f, 0}, {0.2f, 0, 0},
                 add_material(scene, Rgb(0.3f), Rgb(1000)));
        expect_agreement(std::move(scene), kPlaces, 1 << 18, "lamp in a box");
    }
    {  // see-through
        Scene scene = room(grey, grey);
        add_lamp(scene);
        const MaterialId veil = add_material(scene, Rgb(0.8f, 0.4f, 0.4f));
        scene.materials.back().alpha_mode = AlphaMode::blend;
        scene.materials.back().alpha = 0.4f;
        add_quad(scene, {-1, -1, 2}, {3, 0, 0}, {0, 3, 0.2f}, veil);
        scene.materials[2].alpha_mode = AlphaMode::blend;
        scene.materials[2].alpha = 0.6f;
        expect_agreement(std::move(scene), kPlaces, 1 << 17, "veils");
    }
    {  // many lights, two-sided
        Scene scene = room(grey, shiny);
        Rng rng(1);
        for (int i = 0; i < 30; ++i) {
            const Vec3 p =
                Vec3(3 * rng.uniform() - 1.5f, 3 * rng.uniform() - 1.5f, 0.5f + 2 * rng.uniform());
            add_quad(
                scene, p, 0.2f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()),
                0.2f * Vec3(rng.uniform(), rng.uniform(), -rng.uniform()),
                add_material(scene, Rgb(0.5f), Rgb(30 * rng.uniform(), 10, 10 * rng.uniform())));
            scene.materials.back().emits_backward = i % 2 == 0;
            scene.lights.push_back(point_light(p + Vec3(0.1f), Rgb(rng.uniform())));
        }
        scene.lights.push_back(sun({0.1f, 0.2f, -1}, Rgb(1000)));
        expect_agreement(std::move(scene), kPlaces, 1 << 17, "many lights");
    }
    {  // a lamp in the plane of the ceiling
        Scene scene = room(grey, grey);
        scene.lights.push_back(point_light({0.5f, 0.4f, 3}, Rgb(10)));
        expect_agreement(std::move(scene), kPlaces, 1 << 17, "ceiling");
    }
}

}  // namespace
}  // namespace chiaro::tiny
