// Walks from lights start with the chances and densities that they state. By chi^2, each false
// alarm below 1e-6 (scene/chi_squared.h).
#include "sample_renderer/emitters.h"

#include "sample_renderer/meter.h"
#include "scene/chi_squared.h"

#include <gtest/gtest.h>

#include <map>

namespace chiaro {
namespace {

using tiny::Meter;

// Emissions by independent numbers.
struct Starts {
    const LitScene& lit;
    Emitters emitters;
    Rng rng;

    explicit Starts(const Meter& meter) : lit(meter.lit), emitters(lit), rng(1) {}
    std::optional<Emission> next() {
        float u[5];
        for (float& number : u) number = rng.uniform();
        return emitters.sample(lit, u[0], {u[1], u[2]}, {u[3], u[4]});
    }
};

PunctualLight spot() {
    PunctualLight light = tiny::point_light({0.5f, 0, 1}, {40, 30, 20});
    light.kind = LightKind::spot;
    light.direction = glm::normalize(Vec3(1, 2, -2));
    light.inner_cone = 0.2f;
    light.outer_cone = 0.6f;
    return light;
}

// The normal of the one panel is (0, 0.6, -0.8).
Scene panel(bool both_ways) {
    Scene scene;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(3, 2, 1));
    scene.materials[0].emits_backward = both_ways;
    tiny::add_quad(scene, {0, 0, 1}, {0, 0.8f, 0.6f}, {1, 0, 0}, lamp);
    return scene;
}

// Panels, lamps, suns and a sky together: which of them a walk starts at, against what it says of
// itself: a chance, a chance over the light's area, or a chance times the density of a direction.
TEST(Emitters, LightsAreChosenWithTheChancesStated) {
    Scene scene = panel(true);
    tiny::add_quad(scene, {3, 0, 0}, {2, 0, 0}, {0, 2, 0},
                   tiny::add_material(scene, Rgb(0), Rgb(0.5f)));
    scene.lights = {tiny::point_light({1, 1, 1}, Rgb(2)), spot(), tiny::sun({0, 0, -1}, Rgb(0.3f)),
                    tiny::sun({1, 0, -1}, Rgb(1, 0, 0))};
    scene.environment.sky = Rgb(0.1f, 0.2f, 0.3f);
    const Meter meter(scene);
    Starts starts(meter);

    constexpr int kSamples = 100'000;
    std::map<std::pair<int, std::uint32_t>, std::pair<double, double>> lights;  // count, chance
    for (int i = 0; i < kSamples; ++i) {
        const auto e = starts.next();
        ASSERT_TRUE(e);
        const bool area = e->from == LightSource::area, sky = e->from == LightSource::sky;
        double chance = e->start;
        if (area) chance *= primitive_area(scene, e->object, e->index);
        if (sky) chance /= meter.lit.environment.pdf_anywhere(-e->ray.direction);
        auto& [count, stated] = lights[{int(e->from), area ? std::uint32_t(e->object) : e->index}];
        EXPECT_TRUE(count == 0 || std::abs(chance / stated - 1) < 1e-5);
        count += 1;
        stated = chance;
    }
    EXPECT_EQ(lights.size(), 7u);
    double sum = 0;
    std::vector<double> counts, expected;
    for (const auto& [light, found] : lights) {
        counts.push_back(found.first);
        expected.push_back(kSamples * found.second);
        sum += found.second;
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    expect_counts(counts, expected, "lights");
}

// Directions of the one light of a scene against `density`, which emissions state alike.
void expect_directions(const Scene& scene, const std::function<float(Vec3)>& density,
                       const std::string& name) {
    const Meter meter(scene);
    Starts starts(meter);
    const auto draw = [&] {
        const auto e = starts.next();
        EXPECT_TRUE(e) << name;
        const Vec3 w = e->ray.direction;
        const float stated = e->from == LightSource::sky ? e->start : e->direction;
        EXPECT_NEAR(stated / density(w), 1, 5e-3f) << name;
        return std::optional(w);
    };
    expect_density(density, draw, name, 64);
}

TEST(Emitters, DirectionsFollowTheirDensity) {
    const Vec3 normal(0, 0.6f, -0.8f);
    expect_directions(
        panel(false), [&](Vec3 w) { return pdf_cosine_hemisphere(glm::dot(w, normal)); }, "panel");
    expect_directions(
        panel(true),
        [&](Vec3 w) { return 0.5f * pdf_cosine_hemisphere(std::abs(glm::dot(w, normal))); },
        "both sides of a panel");
    Scene lamp;
    lamp.lights = {tiny::point_light({1, 2, 3}, Rgb(5))};
    expect_directions(
        lamp, [](Vec3) { return 1 / (4 * kPi); }, "point");
    lamp.lights = {spot()};
    const float rim = std::cos(0.6f);
    expect_directions(
        lamp, [&](Vec3 w) { return glm::dot(w, spot().direction) > rim ? pdf_cone(rim) : 0.0f; },
        "spot");
}

TEST(Emitters, LightOfTheSkyComesFromWhereItIsBright) {
    Scene scene;
    tiny::add_box(scene, Vec3(0), Vec3(1, 2, 3), tiny::add_material(scene, Rgb(0.5f)));
    scene.environment.sky = Rgb(1, 2, 3);
    expect_directions(
        scene, [](Vec3) { return 1 / (4 * kPi); }, "even sky");
    scene.environment.map = Image(12, 6);
    Rng rng(5);
    for (Rgb& pixel : scene.environment.map.pixels)
        pixel = Rgb(rng.uniform(), rng.uniform(), rng.below(9) == 0 ? 30.0f : 0.0f);
    const EnvironmentLight light(scene);
    expect_directions(
        scene, [&](Vec3 w) { return light.pdf_anywhere(-w); }, "map");
}

// Parallel light falls evenly on a disk about the scene's ball, and all that is in the scene is
// behind it.
TEST(Emitters, ParallelLightIsEvenAcross) {
    for (const bool sky : {false, true}) {
        Scene scene;
        const Vec3 high(1, 2, 4);
        tiny::add_box(scene, Vec3(0), high, tiny::add_material(scene, Rgb(0.5f)));
        if (sky)
            scene.environment.sky = Rgb(1);
        else
            scene.lights = {tiny::sun({1, 2, -3}, Rgb(1))};
        const Meter meter(scene);
        Starts starts(meter);
        const float radius = 0.5f * glm::length(high);
        constexpr int kSamples = 50'000;
        std::vector<double> counts(160, 0.0);
        for (int i = 0; i < kSamples; ++i) {
            const auto e = starts.next();
            ASSERT_TRUE(e && e->parallel());
            const Vec3 from = e->ray.origin - 0.5f * high;
            const float along = glm::dot(from, e->ray.direction);
            EXPECT_LE(along, -radius);
            EXPECT_NEAR(e->direction * (kPi * radius * radius), 1, 1e-3f);
            const Vec3 across = Frame(e->ray.direction).to_local(from);
            const float ring = (across.x * across.x + across.y * across.y) / (radius * radius);
            const float azimuth = std::atan2(across.y, across.x) / (2 * kPi) + 0.5f;
            counts[16 * std::min(9, int(ring * 9.99f)) + std::min(15, int(16 * azimuth))] += 1;
        }
        expect_counts(counts, std::vector<double>(160, kSamples / 160.0), sky ? "sky" : "sun");
    }
}

// What a walk stands for is the light's intensity, or radiance times the cosine, over all its
// densities.
TEST(Emitters, FluxIsTheLightOverItsDensities) {
    Scene scene = panel(false);
    scene.lights = {spot(), tiny::sun({0, 0, -1}, Rgb(2, 1, 1))};
    const Meter meter(scene);
    Starts starts(meter);
    for (int i = 0; i < 1000; ++i) {
        const auto e = starts.next();
        ASSERT_TRUE(e);
        const Vec3 w = e->ray.direction;
        const Rgb light = e->from == LightSource::lamp  ? intensity_toward(scene.lights[0], w)
                          : e->from == LightSource::sun ? scene.lights[1].intensity
                                                        : Rgb(3, 2, 1) * glm::dot(w, e->normal);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(e->flux[c] * e->start * e->direction, light[c], 1e-4f * light[c]);
    }
}

}  // namespace
}  // namespace chiaro
