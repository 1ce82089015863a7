// Light from all around. Bounds are at least 6 standard errors as they were measured over seeds,
// unless there is no chance in a number.
#include "sample_renderer/caustic_renderer.h"
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

#include <functional>

namespace chiaro::tiny {
namespace {

constexpr float kTurn = 2 * kPi;

// A map of `radiance` by the angle from the zenith.
Image map_of(int width, int height, const std::function<double(double)>& radiance) {
    Image map(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            map.at(x, y) = Rgb(float(radiance(double(kPi) * (y + 0.5) / height)));
    return map;
}

Scene under(const Environment& environment, Vec3 up = {0, 1, 0}) {
    Scene scene;
    scene.environment = environment;
    scene.up = up;
    return scene;
}

// The CIE's overcast sky (Moon and Spencer 1942), three times as bright at the zenith as at the
// horizon, with 1 cd/m2 at the zenith; the ground is black.
double overcast(double zenith_angle) {
    return std::max(0.0, (1 + 2 * std::cos(zenith_angle)) / 3 * (zenith_angle < 0.5 * kPi));
}

// No chance in it: samples follow the cosine. 128 samples hold whole eights in each replicate.
TEST(Environment, AnEvenSkyBringsPiTimesItsRadianceOnAnyPlane) {
    const Meter meter(under({.sky = {1, 2, 3}}));
    for (const Vec3 n :
         {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0.6f, 0, 0.8f), Vec3(-0.48f, 0.6f, -0.64f)}) {
        const Rgb lux = meter.at({7, 8, 9}, n, Light::direct, 128).mean;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(lux[c] / (kPi * float(1 + c)), 1, 1e-5);
    }
}

// On a level plane: of L = cos, the integral of cos^2 over the hemisphere, 2 pi / 3; of the
// overcast sky 7 pi / 9, and pi / 6 + 4 / 9 on a wall.
TEST(Environment, AMapBringsTheIntegralOfItsRadianceTimesTheCosine) {
    const Vec3 up(0, 0, 1);
    const Meter cosine(under(
        {.map = map_of(256, 128, [](double angle) { return std::max(0.0, std::cos(angle)); })},
        up));
    EXPECT_NEAR(cosine.lux(Vec3(0), up, Light::direct, 1 << 14) / (2 * kPi / 3), 1, 0.003);
    EXPECT_LT(cosine.lux(Vec3(0), -up, Light::direct, 1 << 10), 1e-4f);  // half a pixel at the rim
    const Meter sky(under({.map = map_of(256, 128, overcast)}, up));
    EXPECT_NEAR(sky.lux(Vec3(0), up, Light::direct, 1 << 14) / (7 * kPi / 9), 1, 0.003);
    EXPECT_NEAR(sky.lux(Vec3(0), {0.6f, -0.8f, 0}, Light::direct, 1 << 14) / (kPi / 6 + 4 / 9.0f),
                1, 0.006);
}

// E = L x solid angle x cosine of a sun of one pixel, whose 16 samples are all as good: the cosine
// alone varies over it. It stands where the map says: in y-up its pixel's column, three quarters
// across, is +z.
TEST(Environment, ASunOfOnePixelBringsItsSolidAngleTimesTheCosine) {
    constexpr int kWidth = 1024, kHeight = 512, kColumn = 768, kRow = 128;
    Environment environment = {.map = Image(kWidth, kHeight)};
    environment.map.at(kColumn, kRow) = Rgb(1e9f);
    const Meter meter(under(environment));
    const float zenith_angle = kPi * (kRow + 0.5f) / kHeight;
    const double lux = 1e9 * (kTurn / kWidth) * (kPi / kHeight) * std::sin(zenith_angle);
    const auto on = [&](Vec3 normal) {
        return meter.lux(Vec3(0), normal, Light::direct, 128) / lux;
    };
    // The rays of chance find nothing of the size, and their weight is all that is lost.
    EXPECT_NEAR(on({0, 1, 0}) / std::cos(zenith_angle), 1, 0.002);
    EXPECT_NEAR(on({0, 0, 1}) / std::sin(zenith_angle), 1, 0.002);
    EXPECT_LT(on({1, 0, 0}), 0.01);  // it is half a pixel to the left
    EXPECT_GT(on({-1, 0, 0}) + on({1, 0, 0}), 0);
    EXPECT_EQ(on({0, 0, -1}), 0);
    EXPECT_EQ(on({0, -1, 0}), 0);
}

// Halves of the sky of different colours: each colour is on the side where the map has it, about
// any vertical.
TEST(Environment, ColoursComeFromWhereTheMapHasThem) {
    for (const Vec3 up : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(2, -1, 0.5f)}) {
        Environment environment = {.map = Image(64, 32)};
        for (int x = 0; x < 64; ++x)
            for (int y = 0; y < 32; ++y)
                environment.map.at(x, y) = {x >= 16 && x < 48 ? 1 : 0, x >= 32 ? 1 : 0,
                                            y < 16 ? 1 : 0};
        const Meter meter(under(environment, up));
        const EnvironmentFrame frame(up);
        const auto lux = [&](Vec3 normal) {
            return meter.at(Vec3(0), normal, Light::direct, 1 << 12).mean / kPi;
        };
        EXPECT_NEAR(lux(frame.middle).r, 1, 0.02);
        EXPECT_NEAR(lux(frame.right).g, 1, 0.02);
        EXPECT_NEAR(lux(frame.up).b, 1, 0.02);
        EXPECT_LT(lux(-frame.middle).r, 0.03);  // a pixel of the other half shows at the rim
        EXPECT_LT(lux(-frame.right).g, 0.03);
        EXPECT_LT(lux(-frame.up).b, 0.03);
    }
}

Rgb seen(const Meter& meter, Vec3 from, Vec3 toward, std::uint32_t samples) {
    const Ray ray = {from, glm::normalize(toward - from)};
    Rgb result;
    radiance(meter.lit, {&ray, 1}, {.seed = 3, .samples = samples}, {&result, 1});
    return result;
}

Gloss gloss(float metallic, float roughness, float transmission = 0, bool thin = false) {
    return {.model = GlossModel::metallic_roughness,
            .metallic = metallic,
            .roughness = roughness,
            .transmission = transmission,
            .thin = thin};
}

// Two boxes beside each other, of one material that absorbs nothing, in the open.
Scene white_things(const Gloss& gloss, const Environment& environment) {
    Scene scene = under(environment);
    const MaterialId white = add_material(scene, Rgb(1));
    scene.materials[0].gloss = gloss;
    add_box(scene, Vec3(-1), Vec3(1), white);
    add_box(scene, {-1, 1.5f, -1}, {0, 2, 1}, white);
    return scene;
}

// What absorbs nothing cannot be told from an even sky; nor from a map that is as even, whose
// samples are others. The tables of gloss are exact to 0.005.
TEST(Environment, WhiteThingsVanishInAnEvenSky) {
    const std::pair<const char*, Gloss> all[] = {{"chalk", Gloss()},
                                                 {"mirror", gloss(1, 0)},
                                                 {"metal", gloss(1, 0.4f)},
                                                 {"plastic", gloss(0, 0.5f)},
                                                 {"glass", gloss(0, 0, 1)},
                                                 {"ground glass", gloss(0, 0.4f, 1)},
                                                 {"pane", gloss(0, 0, 1, true)},
                                                 {"ground pane", gloss(0, 0.4f, 1, true)}};
    for (const auto& [name, material] : all) {
        const Meter sky(white_things(material, {.sky = Rgb(1)}));
        const Meter map(white_things(material, {.map = map_of(16, 8, [](double) { return 1; })}));
        for (const Meter* meter : {&sky, &map})
            for (const Vec3 from : {Vec3(5, 3, 1), Vec3(3, 6, -2)})
                for (const Vec3 at : {Vec3(0.5f, 1, 0), Vec3(0, 1.7f, 0.1f)})
                    EXPECT_NEAR(seen(*meter, from, at, 8000).g, 1, 0.03) << name;
    }
}

// The same of irradiance, direct and indirect light together pi, by all renderers; channels do not
// mix. Standard errors are up to 1.3 % a place and 0.13 % in the mean.
void expect_irradiance_of_pi(Truth by) {
    Meter meter(white_things(Gloss(), {.sky = {1, 2, 0}}), by);
    std::vector<ShadeRequest> requests;
    Rng rng(5);
    while (requests.size() < 200) {
        const Vec3 from =
            8.0f * glm::normalize(Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5f);
        const Hit hit =
            meter.look(from, Vec3(rng.uniform(), 2 * rng.uniform(), rng.uniform()) - 0.5f - from);
        if (!hit || !hit.front) continue;
        for (const Light light : {Light::direct, Light::indirect})
            requests.push_back(
                {.where = hit.point, .light = light, .seed = rng.next(), .samples = 512});
    }
    const auto results = meter.shade(requests);
    Rgb mean(0);
    for (std::size_t i = 0; i < results.size(); i += 2) {
        const Rgb lux = results[i].mean + results[i + 1].mean;
        EXPECT_NEAR(lux.r / kPi, 1, 0.08) << int(by);
        mean += 2.0f * lux / float(results.size());
    }
    EXPECT_NEAR(mean.r / kPi, 1, 0.008) << int(by);
    EXPECT_NEAR(mean.g / kPi, 2, 0.016) << int(by);
    EXPECT_EQ(mean.b, 0);
}

TEST(Environment, IrradianceOnWhiteThingsIsPi) {
    for (const Truth by : kTruths) expect_irradiance_of_pi(by);
}

// Under an even sky a white body of glass or metal on a white floor changes nothing for the floor's
// irradiance: it would be pi without it, and what it takes of the sky it gives back. The renderer
// that aims rays at it must not count the sky in it twice.
TEST(Environment, CausticsOfTheSkyAreCountedOnce) {
    for (const Gloss& material : {gloss(1, 0.2f), gloss(0, 0, 1)}) {
        Scene scene = under({.sky = Rgb(1)});
        add_quad(scene, {-50, -1.5f, 50}, {100, 0, 0}, {0, 0, -100}, add_material(scene, Rgb(1)));
        const MaterialId focusing = add_material(scene, Rgb(1));
        scene.materials[index_of(focusing)].gloss = material;
        add_box(scene, Vec3(-1), Vec3(1), focusing);
        const Meter meter(std::move(scene));
        CausticRenderer caustic(meter.scene, meter.caster, meter.area_lights, nullptr, 2);
        PathRenderer path(meter.scene, meter.caster, meter.area_lights, nullptr, 2);
        ShadeRequest request = {
            .light = Light::total, .seed = 4, .samples = 1 << 12, .indirect_samples = 1 << 15};
        request.place = MeterPlace{{1.2f, -1.49f, 0.3f}, {0, 1, 0}};
        for (SampleRenderer* renderer : std::initializer_list<SampleRenderer*>{&path, &caustic}) {
            ShadeResult result;
            renderer->shade({&request, 1}, {&result, 1});
            EXPECT_NEAR(result.mean.g / kPi, 1, 0.03);
        }
    }
}

// A house of clear panes in an even sky is as bright inside as outside, though a part of the light
// is reflected back and forth.
TEST(Environment, AHouseOfPanesIsAsBrightAsTheSky) {
    Scene scene = under({.sky = Rgb(1)});
    const MaterialId pane = add_material(scene, Rgb(1));
    scene.materials[0].gloss = gloss(0, 0, 1, true);
    add_box(scene, Vec3(-1), Vec3(1), pane);
    const Meter meter(std::move(scene));
    const Rgb direct = meter.at(Vec3(0), {0.6f, 0.8f, 0}, Light::direct, 1 << 12).mean;
    const Rgb total = meter.at(Vec3(0), {0.6f, 0.8f, 0}, Light::total, 1 << 14).mean;
    EXPECT_LT(direct.g / kPi, 0.95f);
    EXPECT_NEAR(total.g / kPi, 1, 0.01);
}

// In a shadow of the sun the sky alone is left: a wall hides the sun, of which nearly all samples
// come, and the left half of the sky.
TEST(Environment, BehindAWallHalfOfTheSkyIsLeft) {
    Environment environment = {.map = map_of(64, 32, [](double) { return 1; })};
    environment.map.at(63, 12) = Rgb(1e5f);  // to the left, that is along -x
    Scene scene = under(environment);
    add_quad(scene, {-1e-3f, -100, -100}, {0, 0, 200}, {0, 200, 0}, add_material(scene, Rgb(0)));
    const Meter meter(std::move(scene));
    EXPECT_NEAR(meter.lux(Vec3(0), {0, 1, 0}, Light::direct, 1 << 17) / (kPi / 2), 1, 0.05);
}

TEST(Environment, RaysThatMeetNothingShowIt) {
    Environment environment = {.map = Image(8, 4)};
    environment.map.at(4, 1) = {1, 2, 3};
    const Meter meter(under(environment));
    const EnvironmentFrame frame(meter.scene.up);
    EXPECT_LT(glm::length(seen(meter, Vec3(0), frame.direction_of({4.5f / 8, 1.5f / 4}), 4) -
                          Rgb(1, 2, 3)),
              1e-4f);
    EXPECT_EQ(seen(meter, Vec3(0), frame.direction_of({2.5f / 8, 1.5f / 4}), 4), Rgb(0));
    EXPECT_FALSE(meter.lit.dark());
    EXPECT_TRUE(Meter(under({.map = Image(8, 4)})).lit.dark());
}

}  // namespace
}  // namespace chiaro::tiny
