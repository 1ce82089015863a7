// Light that specular surfaces focus on a point.
#include "sample_renderer/caustic_renderer.h"
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

namespace chiaro::tiny {
namespace {

struct Renderers {
    const Meter& meter;
    CausticRenderer caustic;
    PathRenderer path;

    explicit Renderers(const Meter& m)
        : meter(m),
          caustic(m.scene, m.caster, m.area_lights, nullptr, 1),
          path(m.scene, m.caster, m.area_lights, nullptr, 1) {}

    // Mean and deviation of the mean by 16 runs of their own seeds, green.
    struct Measured {
        double mean, deviation;
    };
    Measured measure(SampleRenderer& renderer, Vec3 position, Vec3 normal, std::uint32_t samples) {
        constexpr int kRuns = 16;
        double sum = 0, squares = 0;
        for (std::uint32_t run = 0; run < kRuns; ++run) {
            const double e =
                Meter::at(renderer, position, normal, Light::indirect, samples, 100 + run).mean.g;
            sum += e;
            squares += e * e;
        }
        const double mean = sum / kRuns;
        return {mean, std::sqrt(std::max(squares / kRuns - mean * mean, 0.0) / (kRuns - 1))};
    }
};

// A mirror of 0.9 in the plane x = 1.5, at all angles.
Scene beside_a_mirror() {
    Scene scene;
    add_quad(scene, {1.5f, -20, -20}, {0, 40, 0}, {0, 0, 40},
             add_glossy(scene, Rgb(0), mirror(Rgb(0.9f))));
    return scene;
}

// 100 cd at (0, 0, 1): the floor gets its direct light and that of the image at (3, 0, 1). This
// light of a point by way of a mirror is what all renderers lack but `caustic`.
TEST(Caustic, APerfectMirrorAddsItsImageOfALamp) {
    Scene scene = beside_a_mirror();
    scene.lights = {point_light({0, 0, 1}, Rgb(100))};
    const std::pair<float, float> expected[] = {{-1, 36.639f}, {0, 102.846f}, {1, 43.405f}};
    for (const Truth by : kTruths) {
        const Meter meter(scene, by);
        for (const auto& [x, lux] : expected) {
            const float direct = 100 / std::pow(1 + x * x, 1.5f);
            const float found = meter.at({x, 0, 0}, {0, 0, 1}, Light::total, 64).mean.g;
            EXPECT_NEAR(found / (by == Truth::caustic ? lux : direct), 1, 1e-4) << x << int(by);
        }
    }
}

// A lamp with extent is shown to the floor by all of them: 0.9 of what a lamp in its image's place
// brings straight. Standard errors 0.26 % of
// `path`, 0.6 % of the others.
TEST(Caustic, APerfectMirrorAddsItsImageOfAPanel) {
    Scene scene = beside_a_mirror(), image;
    add_quad(scene, {-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, add_material(scene, Rgb(0), Rgb(100)));
    add_quad(image, {2, -1, 2}, {0, 2, 0}, {2, 0, 0}, add_material(image, Rgb(0), Rgb(90)));
    const Vec3 place(0.5f, 0.3f, 0), up(0, 0, 1);
    const float lux = Meter(image).lux(place, up, Light::direct, 1 << 14);
    for (const Truth by : kTruths) {
        const Meter meter(scene, by);
        const float found = meter.lux(place, up, Light::indirect, meter.worth(1 << 16));
        EXPECT_NEAR(found / lux, 1, within(by, 0.02)) << int(by);
    }
}

TEST(Caustic, AMirrorAddsItsImageOfTheSunWhereTheSunReachesIt) {
    Scene scene;
    add_quad(scene, {1, -1, 0}, {0, 2, 0}, {0, 0, 2}, add_glossy(scene, Rgb(0), mirror(Rgb(0.5f))));
    scene.lights = {sun({1, 0, -1}, Rgb(1000))};
    const Meter meter(std::move(scene));
    Renderers both(meter);
    const float reflected = 500 * std::sqrt(0.5f);
    const auto indirect = [&](float x) {
        return Meter::at(both.caustic, {x, 0, 0}, {0, 0, 1}, Light::indirect, 64).mean.g;
    };
    EXPECT_NEAR(indirect(0.5f) / reflected, 1, 1e-4);
    EXPECT_NEAR(indirect(-0.9f) / reflected, 1, 1e-4);
    EXPECT_EQ(indirect(-1.1f), 0);  // light of the upper edge lands at x = -1
}

// What stands in either part of the way stops the light.
TEST(Caustic, AnImageIsHiddenByWhatStandsInTheWay) {
    for (const Vec3 screen : {Vec3(0.5f, 0, 1), Vec3(0.75f, 0, 0.3f)}) {
        Scene scene;
        add_quad(scene, {1.5f, -20, -20}, {0, 40, 0}, {0, 0, 40},
                 add_glossy(scene, Rgb(0), mirror(Rgb(0.9f))));
        add_quad(scene, screen - Vec3(0, 0.5f, 0.2f), {0, 1, 0}, {0, 0, 0.4f},
                 add_material(scene, Rgb(0)));
        scene.lights = {point_light({0, 0, 1}, Rgb(100))};
        const Meter meter(std::move(scene));
        Renderers both(meter);
        const Rgb e = Meter::at(both.caustic, {0, 0, 0}, {0, 0, 1}, Light::indirect, 64).mean;
        EXPECT_EQ(max_component(e), 0) << screen.x;
    }
}

// A metal ring of radius 1 and height 0.5 on the floor, lit by a lamp above and beside it: the
// light inside focuses to the cusp of a cardioid.
Scene ring(float roughness, bool lamp_is_point) {
    Scene scene;
    const MaterialId gold = add_glossy(scene, Rgb(0.95f), metal(roughness));
    constexpr std::uint32_t kSides = 64;
    Mesh mesh;
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const float a = 2 * kPi * static_cast<float>(i) / kSides;
        for (const float z : {0.0f, 0.5f}) {
            mesh.positions.push_back({std::cos(a), std::sin(a), z});
            mesh.normals.push_back({std::cos(a), std::sin(a), 0});
        }
        const std::uint32_t j = (i + 1) % kSides;
        mesh.primitives.push_back(quad(2 * i, 2 * j, 2 * j + 1, 2 * i + 1, gold));
    }
    add_object(scene, std::move(mesh));
    add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, add_material(scene, Rgb(0.5f)));
    if (lamp_is_point) {
        scene.lights = {point_light({-3, 0, 3}, Rgb(1000))};
    } else {
        // 20 cm across, facing the ring.
        const Vec3 to_ring = glm::normalize(Vec3(1, 0, -1)), across(0, 1, 0);
        const Vec3 up = glm::cross(to_ring, across);
        add_quad(scene, Vec3(-3, 0, 3) - 0.1f * (across + up), 0.2f * across, 0.2f * up,
                 add_material(scene, Rgb(0), Rgb(25'000)));
    }
    return scene;
}

// Two places in the ring's bright curve, and one that sees the ring from afar: there few rays of a
// cosine distribution meet it. Both renderers are unbiased: their means differ by less than 5
// standard errors of the difference (false alarm below 1e-5 for near normal means).
TEST(Caustic, TheRingIsAsBrightAsPathsSay) {
    const Meter meter(ring(0.0f, false));
    Renderers both(meter);
    for (const Vec3 place : {Vec3(0.9f, 0.2f, 0), Vec3(0.5f, 0, 0), Vec3(-1.2f, 0.1f, 0)}) {
        const auto a = both.measure(both.caustic, place, {0, 0, 1}, 4096);
        const auto b = both.measure(both.path, place, {0, 0, 1}, 16'384);
        EXPECT_LT(std::abs(a.mean - b.mean), 5 * std::hypot(a.deviation, b.deviation))
            << place.x << ": " << a.mean << " " << b.mean;
    }
}

// A metal plate of 20 cm that shows a lamp to a point 3.5 m away. Variances at as many samples: of
// 16 runs, exact to a factor of 3 or so (false alarm below 1e-4).
TEST(Caustic, AimedRaysAreLessNoisyWhereThePlateIsFar) {
    for (const float roughness : {0.0f, 0.25f}) {
        Scene scene;
        const Vec3 place(-1, 0, 0), plate(2, 0, 1.8f), lamp(-3, 0, 3);
        const Vec3 normal =
            glm::normalize(glm::normalize(place - plate) + glm::normalize(lamp - plate));
        const Vec3 across(0, 1, 0), up = glm::cross(normal, across);
        add_quad(scene, plate - 0.1f * (across + up), 0.2f * across, 0.2f * up,
                 add_glossy(scene, Rgb(0.95f), metal(roughness)));
        add_quad(scene, lamp - Vec3(0, 0.5f, 0.5f), {0, 1, 0}, {0, 0, 1},
                 add_material(scene, Rgb(0), Rgb(1000)));
        const Meter meter(std::move(scene));
        Renderers both(meter);
        const auto a = both.measure(both.caustic, place, {0, 0, 1}, 512);
        const auto b = both.measure(both.path, place, {0, 0, 1}, 512);
        EXPECT_GT(a.mean, 0) << roughness;
        EXPECT_LT(20 * a.deviation * a.deviation, b.deviation * b.deviation) << roughness;
    }
}

TEST(Caustic, ARoughRingUnderAPointIsAsBrightAsPathsSay) {
    const Meter meter(ring(0.25f, true));
    Renderers both(meter);
    for (const Vec3 place : {Vec3(0.5f, 0, 0), Vec3(0.1f, 0.3f, 0)}) {
        const auto a = both.measure(both.caustic, place, {0, 0, 1}, 4096);
        const auto b = both.measure(both.path, place, {0, 0, 1}, 16'384);
        EXPECT_LT(std::abs(a.mean - b.mean), 5 * std::hypot(a.deviation, b.deviation))
            << place.x << ": " << a.mean << " " << b.mean;
    }
}

// Two plates, of which one shows one of two lamps that are alike to both: each plate is lit by each
// lamp as often as by the other, whichever was aimed at.
TEST(Caustic, EveryPlateIsLitByEveryLamp) {
    Scene scene;
    const Vec3 place(0), first(2, 0, 1), second(-2, 0, 1), lamp(0, 1.5f, 3);
    const MaterialId plate = add_glossy(scene, Rgb(0.95f), metal(0.3f));
    const auto add_plate = [&](Vec3 at, Vec3 toward) {
        const Vec3 normal =
            glm::normalize(glm::normalize(place - at) + glm::normalize(toward - at));
        const Vec3 across = glm::normalize(glm::cross(Vec3(0, 0, 1), normal));
        const Vec3 up = glm::cross(normal, across);
        add_quad(scene, at - 0.2f * (across + up), 0.4f * across, 0.4f * up, plate);
    };
    add_plate(first, lamp);
    add_plate(second, {-1, 0, -5});
    scene.lights = {point_light(lamp, Rgb(100)), point_light({0, -1.5f, 3}, Rgb(100))};
    const Meter meter(std::move(scene));
    Renderers both(meter);
    const auto a = both.measure(both.caustic, place, {0, 0, 1}, 4096);
    const auto b = both.measure(both.path, place, {0, 0, 1}, 65'536);
    EXPECT_LT(std::hypot(a.deviation, b.deviation), 0.02 * b.mean);
    EXPECT_LT(std::abs(a.mean - b.mean), 5 * std::hypot(a.deviation, b.deviation))
        << a.mean << " " << b.mean;
}

// In a box without anything that focuses, it is `path` to the last bit.
TEST(Caustic, WithoutSpecularSurfacesItIsPath) {
    const Meter meter(cornell_box());
    Renderers both(meter);
    const auto at = [&](SampleRenderer& renderer) {
        return Meter::at(renderer, {2, 0.001f, 4}, {0, 1, 0}, Light::total, 256).mean;
    };
    EXPECT_EQ(at(both.caustic), at(both.path));
}

}  // namespace
}  // namespace chiaro::tiny
