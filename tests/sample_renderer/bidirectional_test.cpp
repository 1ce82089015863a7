// The renderer `bidirectional` against `path`, which finds by fewer ways what both find.
#include "sample_renderer/bidirectional_renderer.h"

#include "sample_renderer/ball.h"
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

#include <string>

namespace chiaro::tiny {
namespace {

struct Estimate {
    double mean = 0, variance = 0;  // of the mean
};

constexpr std::uint32_t kSeeds = 64;
const MeterPlace kFloor = {{0.3f, 0.2f, 0.001f}, {0, 0, 1}};

// Luminance of the indirect light on the floor, by seeds whose scatter tells the variance.
Estimate estimate(SampleRenderer& renderer, std::uint32_t samples) {
    std::vector<ShadeRequest> requests;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed)
        requests.push_back({.place = kFloor,
                            .light = Light::indirect,
                            .seed = hash32(seed),
                            .samples = samples / kSeeds});
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

// How far `bidirectional` is from `path`, in standard errors of the difference as the scatter of 64
// seeds of each tells them. A sound program is more than 6 away once in 10^7 times (Student's t of
// 63 degrees of freedom at least).
double distance(Scene scene, const std::string& what, std::uint32_t samples = 1 << 15) {
    const Meter meter(std::move(scene));
    PathRenderer path(meter.scene, meter.caster, meter.area_lights, nullptr, 1);
    BidirectionalRenderer joined(meter.scene, meter.caster, meter.area_lights, nullptr, 1);
    const Estimate a = estimate(path, samples), b = estimate(joined, samples / 4);
    const double error = std::sqrt(a.variance + b.variance);
    EXPECT_GT(a.mean, 0) << what;
    EXPECT_LT(error, 0.1 * a.mean) << what << ": tells nothing";
    return (b.mean - a.mean) / error;
}

struct Surface {
    const char* name;
    Rgb color;
    std::optional<Gloss> gloss;
};
const Surface kGrey = {"grey", {0.7f, 0.5f, 0.3f}, std::nullopt};
const Surface kBrushed = {"brushed metal", {0.8f, 0.7f, 0.6f}, metal(0.5f)};
const Surface kPlastic = {"plastic", Rgb(0.5f), plastic(0.3f)};
const Surface kGround = {"ground glass", Rgb(0.9f), glass(0.4f, false)};
const Surface kGroundPane = {"ground pane", Rgb(0.9f), glass(0.4f, true)};
const Surface kMirror = {"mirror", Rgb(0.9f), metal(0)};
const Surface kLacquer = {"lacquer", Rgb(0.5f), plastic(0)};
const Surface kGlass = {"glass", Rgb(1), glass(0, false)};
const Surface kPane = {"pane", {0.9f, 0.6f, 0.6f}, glass(0, true)};

MaterialId add(Scene& scene, const Surface& surface) {
    return surface.gloss ? add_glossy(scene, surface.color, *surface.gloss)
                         : add_material(scene, surface.color);
}

// A room of 4 x 4 x 3, whose ceiling is its second face, with a thing in it; nothing shines.
enum class Thing { block, ball };
Scene room(const Surface& walls, const Surface& surface, Thing thing) {
    Scene scene;
    scene.up = Vec3(0, 0, 1);
    add_room(scene, {-2, -2, 0}, {2, 2, 3}, add(scene, walls));
    if (thing == Thing::block)
        add_box(scene, {-1, -0.8f, 0.3f}, {-0.2f, 0.6f, 1.1f}, add(scene, surface));
    else
        add_ball(scene, {-0.4f, 0.2f, 1}, 0.8f, add(scene, surface));
    return scene;
}

void open_ceiling(Scene& scene) {
    scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin() + 1);
    --scene.meshes[0].quad_count;
}

void add_panel(Scene& scene) {
    add_quad(scene, {-0.6f, -0.5f, 2.9f}, {0, 1, 0}, {1.2f, 0, 0},
             add_material(scene, Rgb(0.3f), Rgb(10)));
}

void add_spot(Scene& scene) {
    scene.lights.push_back(point_light({0.5f, 1, 2}, Rgb(20)));
    scene.lights.back().kind = LightKind::spot;
    scene.lights.back().direction = glm::normalize(Vec3(-1, -1, -1.2f));
    scene.lights.back().inner_cone = 0.3f;
    scene.lights.back().outer_cone = 0.6f;
}

TEST(Bidirectional, AgreesWithPathAboutSurfacesOfAnyKind) {
    for (const Surface& surface :
         {kGrey, kBrushed, kPlastic, kGround, kGroundPane, kMirror, kLacquer, kGlass, kPane})
        for (const Thing thing : {Thing::block, Thing::ball}) {
            Scene scene = room(kGrey, surface, thing);
            add_panel(scene);
            const std::string what = std::string(surface.name) + " " + std::to_string(int(thing));
            EXPECT_LT(std::abs(distance(std::move(scene), what)), 6) << what;
        }
    for (const Surface& walls : {kBrushed, kPlastic, kLacquer}) {
        Scene scene = room(walls, kPlastic, Thing::block);
        add_panel(scene);
        EXPECT_LT(std::abs(distance(std::move(scene), walls.name)), 6) << walls.name;
    }
}

// Lights without extent, where nothing is smooth: by mirrors and panes `path` does not find them.
TEST(Bidirectional, AgreesWithPathAboutLampsAndSuns) {
    for (const Surface& surface : {kGrey, kBrushed, kPlastic, kGround})
        for (const Thing thing : {Thing::block, Thing::ball}) {
            Scene lamps = room(kGrey, surface, thing);
            lamps.lights.push_back(point_light({-1.5f, -1.5f, 2}, Rgb(5)));
            add_spot(lamps);
            EXPECT_LT(std::abs(distance(std::move(lamps), surface.name)), 6) << surface.name;
            Scene suns = room(kGrey, surface, thing);
            open_ceiling(suns);
            suns.lights = {sun({0.3f, 0.2f, -1}, Rgb(5)), sun({-0.3f, 0.4f, -1}, Rgb(2))};
            EXPECT_LT(std::abs(distance(std::move(suns), surface.name)), 6) << surface.name;
        }
}

TEST(Bidirectional, AgreesWithPathAboutTheSky) {
    for (const bool map : {false, true}) {
        Scene scene = room(kGrey, kPlastic, Thing::block);
        open_ceiling(scene);
        add_ball(scene, {0.6f, -0.9f, 1}, 0.6f, add(scene, kGlass));
        scene.environment.sky = Rgb(1, 2, 3);
        if (map) {
            scene.environment.map = Image(32, 16);
            for (Rgb& pixel : scene.environment.map.pixels) pixel = Rgb(0.5f);
            scene.environment.map.at(5, 3) = Rgb(60);
        }
        EXPECT_LT(std::abs(distance(std::move(scene), "sky", 1 << 17)), 6) << map;
    }
}

// A lamp in a box that is open at a gap of 5 cm all round; `path` needs many samples here.
TEST(Bidirectional, AgreesWithPathAboutALampInABox) {
    Scene scene = room(kGrey, kGrey, Thing::block);
    const MaterialId white = add_material(scene, Rgb(0.9f));
    add_box(scene, {-1, -1, 1.5f}, {1, 1, 1.55f}, white);
    Mesh cover = box_mesh({-1, -1, 1.6f}, {1, 1, 2.5f}, white, false);
    cover.primitives.erase(cover.primitives.begin());
    add_object(scene, std::move(cover));
    add_quad(scene, {-0.1f, -0.1f, 2.3f}, {0, 0.2f, 0}, {0.2f, 0, 0},
             add_material(scene, Rgb(0.3f), Rgb(1000)));
    EXPECT_LT(std::abs(distance(std::move(scene), "box", 1 << 18)), 6);
}

// Panels, lamps and a sun together, many of each; panels that shine both ways, and see-through.
TEST(Bidirectional, AgreesWithPathAboutManyLightsAndVeils) {
    Scene scene = room(kGrey, kPlastic, Thing::block);
    open_ceiling(scene);
    Rng rng(1);
    const auto random = [&rng] { return Vec3(rng.uniform(), rng.uniform(), rng.uniform()); };
    for (int i = 0; i < 30; ++i) {
        const Vec3 place = Vec3(-1.5f, -1.5f, 0.5f) + random() * Vec3(3, 3, 2);
        add_quad(scene, place, 0.2f * random(), 0.2f * random() * Vec3(1, 1, -1),
                 add_material(scene, Rgb(0.5f), 10.0f * random()));
        scene.materials.back().emits_backward = i % 2 == 0;
        if (i % 3 == 0) scene.materials.back().alpha_mode = AlphaMode::blend;
        scene.materials.back().alpha = 0.5f;
        scene.lights.push_back(point_light(place + Vec3(0.1f), 0.2f * random()));
    }
    scene.lights.push_back(sun({0.1f, 0.2f, -1}, Rgb(1)));
    add_quad(scene, {-1, -1, 2}, {3, 0, 0}, {0, 3, 0.2f}, add_material(scene, {0.8f, 0.4f, 0.4f}));
    scene.materials.back().alpha_mode = AlphaMode::blend;
    scene.materials.back().alpha = 0.4f;
    EXPECT_LT(std::abs(distance(std::move(scene), "many", 1 << 16)), 6);
}

// A lamp before a mirror lights the opposite wall by way of it, and that the floor: light that
// `path` cannot find, and that is more than noise.
TEST(Bidirectional, FindsLampsByWayOfMirrors) {
    Scene scene = room(kGrey, kMirror, Thing::block);
    add_spot(scene);
    EXPECT_GT(distance(std::move(scene), "mirror"), 8);
}

}  // namespace
}  // namespace chiaro::tiny
