// Laws that light keeps whatever the scene: light adds up, paths can be reversed, size and
// orientation do not matter. Standard errors over seeds are given as they were measured; bounds are
// at least 5 of them, false alarm 6e-7 a number.
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

using tiny::Meter;
using tiny::Truth;

// Direct light is the same of all (reproducible_test.cpp).
constexpr std::pair<Light, Truth> kLightsAndTruths[] = {{Light::direct, Truth::path},
                                                        {Light::indirect, Truth::path},
                                                        {Light::indirect, Truth::bidirectional},
                                                        {Light::indirect, Truth::caustic},
                                                        {Light::indirect, Truth::gather}};

// A room with a block, a lamp in the ceiling and two sources; `lit` says which of the three shine.
Scene room(int lit) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, {0.8f, 0.6f, 0.4f});
    const MaterialId lamp =
        tiny::add_material(scene, Rgb(0.2f), lit & 1 ? Rgb(30, 40, 50) : Rgb(0));
    tiny::add_room(scene, Vec3(0), {4, 3, 3}, white);
    tiny::add_box(scene, {1, 0.5f, 0}, {2, 1.5f, 1.2f}, white);
    tiny::add_quad(scene, {2.5f, 1, 2.9f}, {0, 1, 0}, {1, 0, 0}, lamp);
    if (lit & 2) scene.lights.push_back(tiny::point_light({0.5f, 2.5f, 2}, Rgb(20, 10, 15)));
    if (lit & 4) {
        PunctualLight spot = tiny::point_light({3, 0.5f, 2.5f}, Rgb(200, 100, 50));
        spot.kind = LightKind::spot;
        spot.direction = glm::normalize(Vec3(-1, 0.5f, -1));
        spot.inner_cone = 0.3f;
        spot.outer_cone = 0.5f;
        scene.lights.push_back(spot);
    }
    return scene;
}

// Sum of single lamps = all lamps. Standard error 0.3 % in red, less in the others.
TEST(Laws, LampsAddUp) {
    const Vec3 p(3, 2, 0);
    for (const Light light : {Light::direct, Light::indirect}) {
        Rgb sum(0);
        for (const int lamp : {1, 2, 4})
            sum += Meter(room(lamp)).at(p, {0, 0, 1}, light, 1 << 18, lamp).mean;
        const Rgb all = Meter(room(7)).at(p, {0, 0, 1}, light, 1 << 18).mean;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(all[c] / sum[c], 1, 0.018) << int(light);
    }
}

// Reciprocity: two patches of one size, one shines and the other receives; swapped, the same flux
// arrives, by all the bounces of the room. Standard error 0.48 %.
void expect_swap(Truth by) {
    const Vec3 corners[2] = {{0.4f, 0.5f, 0.8f}, {3, 1.8f, 2.0f}};
    const float size = 0.2f;
    double received[2];
    for (int source = 0; source < 2; ++source) {
        Scene scene = room(0);
        const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(100));
        const MaterialId black = tiny::add_material(scene, Rgb(0));
        for (int i = 0; i < 2; ++i)  // the first faces up, the second down
            tiny::add_quad(scene, corners[i], i == 0 ? Vec3(size, 0, 0) : Vec3(0, size, 0),
                           i == 0 ? Vec3(0, size, 0) : Vec3(size, 0, 0),
                           i == source ? lamp : black);
        Meter meter(scene, by);
        std::vector<ShadeRequest> requests;
        for (int x = 0; x < 4; ++x)
            for (int y = 0; y < 4; ++y)
                requests.push_back({.where = {ObjectId(source == 0 ? 4 : 3), 0,
                                              (float(x) + 0.5f) / 4, (float(y) + 0.5f) / 4},
                                    .light = Light::total,
                                    .seed = std::uint32_t(requests.size()),
                                    .samples = 1024,
                                    .indirect_samples = meter.worth(16'384)});
        received[source] = 0;
        for (const ShadeResult& result : meter.shade(requests)) received[source] += result.mean.r;
    }
    EXPECT_NEAR(received[0] / received[1], 1, within(by, 0.025)) << int(by);
}

TEST(Laws, SourceAndReceiverSwap) {
    for (const Truth by : tiny::kTruths) expect_swap(by);
}

Rgb total_in(const Mat4& transform, float intensity_scale, Truth by) {
    Scene scene = room(7);
    for (Object& object : scene.objects) object.to_world = transform;
    for (PunctualLight& light : scene.lights) {
        light.position = Vec3(transform * Vec4(light.position, 1));
        light.direction = glm::normalize(Vec3(transform * Vec4(light.direction, 0)));
        light.intensity *= intensity_scale;
    }
    const Vec3 p(transform * Vec4(3, 2, 0, 1));
    const Vec3 n = glm::normalize(Vec3(transform * Vec4(0, 0, 1, 0)));
    const Meter meter(scene, by);
    return meter.at(p, n, Light::total, meter.worth(65'536)).mean;
}

// Turned and moved, everything is the same; k times as large, area lights give the same and point
// sources need k^2 times the intensity. The random numbers are alike but the frames about normals
// turn differently: standard error 0.26 %; of size alone 0.007 %, and 0.2 % of `gather`, where
// roundings choose other cells.
TEST(Laws, SizeAndOrientationDoNotMatter) {
    for (const Truth by : tiny::kTruths) {
        const Rgb expected = total_in(Mat4(1), 1, by);
        const Mat4 turn = glm::translate(Mat4(1), Vec3(3, -8, 5)) *
                          glm::rotate(Mat4(1), 2.1f, glm::normalize(Vec3(3, 1, -2)));
        const Rgb turned = total_in(turn, 1, by);
        const Rgb large = total_in(glm::scale(Mat4(1), Vec3(100)), 10'000, by);
        const Rgb small = total_in(glm::scale(Mat4(1), Vec3(0.1f)), 0.01f, by);
        for (int c = 0; c < 3; ++c) {
            const double alike = by == Truth::gather ? 0.01 : 0.001;
            EXPECT_NEAR(turned[c] / expected[c], 1, within(by, 0.015)) << int(by);
            EXPECT_NEAR(large[c] / expected[c], 1, alike) << int(by);
            EXPECT_NEAR(small[c] / expected[c], 1, alike) << int(by);
        }
    }
}

// A court, open to the sky: a glowing panel, a lamp, a spot and a sun together; `lit` says which
// shine.
Scene court(int lit) {
    Scene scene = room(lit & 7);
    scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin() + 1);  // no ceiling
    --scene.meshes[0].quad_count;
    if (lit & 8) scene.lights.push_back(tiny::sun({0.3f, 0.2f, -1}, Rgb(5, 4, 3)));
    return scene;
}

// Area lights, lamps and suns together = the sum of each kind alone, in direct light and after
// reflections. Standard error 0.3 % in red.
TEST(Laws, KindsOfLightAddUp) {
    const Vec3 p(3, 2, 0);
    for (const auto& [light, by] : kLightsAndTruths) {
        const auto lit_by = [&, light = light, by = by](int lamps) {
            const Meter meter(court(lamps), by);
            return meter.at(p, {0, 0, 1}, light, meter.worth(1 << 18), lamps).mean;
        };
        const Rgb sum = lit_by(1) + lit_by(2) + lit_by(4) + lit_by(8), all = lit_by(15);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(all[c] / sum[c], 1, within(by, 0.018)) << int(light) << int(by);
    }
}

// Two panes of the alphas given, in the way of what shines down from z = 3.
Scene behind_panes(float lower, float upper) {
    Scene scene;
    for (const float alpha : {lower, upper}) {
        const MaterialId pane = tiny::add_material(scene, Rgb(0));
        scene.materials[index_of(pane)].alpha_mode = AlphaMode::blend;
        scene.materials[index_of(pane)].alpha = alpha;
        const float z = alpha == lower ? 1.0f : 1.5f;
        tiny::add_quad(scene, {-5, -5, z}, {10, 0, 0}, {0, 10, 0}, pane);
    }
    return scene;
}

// A lamp and a sun behind panes of alpha 0.25 and 0.4 bring 0.75 x 0.6 of their light to every
// single point, with no noise: what a point keeps for ever is the truth, also straight below the
// panes' middle, where their halves meet.
TEST(Laws, LampsShineThroughPanesWithoutNoise) {
    Scene scene = behind_panes(0.25f, 0.4f);
    scene.lights.push_back(tiny::point_light({0, 0, 3}, Rgb(90)));
    scene.lights.push_back(tiny::sun({0, 0.6f, -0.8f}, Rgb(10)));
    const Meter meter(scene);
    for (const float x : {0.0f, 0.1f, 0.7f, 1.3f}) {
        const ShadeResult found = meter.at({x, x, 0}, {0, 0, 1}, Light::direct, 4);
        const double lamp = 90 * 3 / std::pow(9 + 2 * double(x) * x, 1.5);
        EXPECT_NEAR(found.mean.g / (0.45 * (lamp + 8)), 1, 1e-5);
        EXPECT_EQ(found.variance, Rgb(0));
    }
}

// The light of a glowing panel is weakened alike, though rays that meet it by chance play a part.
// Standard error 0.0014.
TEST(Laws, PanelsShineThroughPanes) {
    Scene open, scene = behind_panes(0.25f, 0.4f);
    for (Scene* s : {&open, &scene})
        tiny::add_quad(*s, {-5, -5, 2}, {0, 10, 0}, {10, 0, 0},
                       tiny::add_material(*s, Rgb(0), Rgb(1)));
    const float through = Meter(scene).lux(Vec3(0), {0, 0, 1}, Light::direct, 1 << 16);
    const float clear = Meter(open).lux(Vec3(0), {0, 0, 1}, Light::direct, 1 << 16);
    EXPECT_NEAR(through / clear, 0.45, 0.01);
}

// A room lit by a panel that is see-through: blended at alpha 0.25, or masked with holes over half
// of it. Only what stops rays shines: a quarter of the opaque panel's light, and that of half a
// panel. By light samples and rays met by chance together, straight and after reflections. Standard
// error 0.2 % at most.
TEST(Laws, SeeThroughPanelsShineWhereTheyStopRays) {
    const auto lit_room = [](float width) {
        Scene scene;
        tiny::add_room(scene, Vec3(-1), Vec3(1), tiny::add_material(scene, Rgb(0.5f)));
        const MaterialId panel = tiny::add_material(scene, Rgb(0), Rgb(1));
        Mesh mesh;
        mesh.positions = {
            {-0.8f, -0.8f, 0.5f}, {-0.8f, 0.8f, 0.5f}, {width, 0.8f, 0.5f}, {width, -0.8f, 0.5f}};
        mesh.uvs[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
        mesh.primitives = {tiny::quad(0, 1, 2, 3, panel)};
        tiny::add_object(scene, mesh);
        return scene;
    };
    Scene blended = lit_room(0.8f), masked = lit_room(0.8f);
    blended.materials[1].alpha_mode = AlphaMode::blend;
    blended.materials[1].alpha = 0.25f;
    masked.materials[1].alpha_mode = AlphaMode::mask;
    masked.materials[1].base_color_texture.texture = TextureId(0);
    Texture holes;
    holes.width = 2;
    holes.height = 1;
    holes.nearest = true;
    holes.texels = {{0, 0, 0, 255}, {0, 0, 0, 0}};
    masked.textures.push_back(holes);

    for (const auto& [light, by] : kLightsAndTruths) {
        const auto lux = [&, light = light, by = by](const Scene& scene) {
            const Meter meter(scene, by);
            return meter.lux({0.1f, 0.2f, -1}, {0, 0, 1}, light, meter.worth(1 << 17));
        };
        EXPECT_NEAR(lux(masked) / lux(lit_room(0)), 1, within(by, 0.011)) << int(light);
        if (light == Light::direct) {
            EXPECT_NEAR(lux(blended) / lux(lit_room(0.8f)), 0.25, 0.01);
        }
    }
}

// Two single-sided sheets back to back, one red and one green, are seen red from above and green
// from below, and light meets them as one: rho E / pi of the sun on it, and none of it below.
TEST(Laws, CoincidentFacesAreSeenFromTheirFronts) {
    Scene scene;
    const MaterialId red = tiny::add_material(scene, {0.5f, 0, 0});
    const MaterialId green = tiny::add_material(scene, {0, 0.5f, 0});
    for (Material& material : scene.materials) material.double_sided = false;
    tiny::add_quad(scene, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, red);    // front faces up
    tiny::add_quad(scene, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0}, green);  // down
    scene.lights.push_back(tiny::sun({0, 0, -1}, Rgb(kPi)));
    scene.lights.push_back(tiny::sun({0, 0, 1}, Rgb(2 * kPi)));
    const Meter meter(scene);
    std::vector<Ray> rays;
    for (int i = 0; i < 100; ++i) {
        const Vec3 at(0.018f * float(i) - 0.9f, 0.3f, 1);
        rays.push_back({at + Vec3(0, 0, 2), {0, 0, -1}});
        rays.push_back({at - Vec3(0, 0, 2), {0, 0, 1}});
    }
    std::vector<Rgb> seen(rays.size());
    radiance(meter.lit, rays, {}, seen);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Rgb expected = i % 2 == 0 ? Rgb(0.5f, 0, 0) : Rgb(0, 1, 0);
        EXPECT_LT(glm::length(seen[i] - expected), 1e-5f) << i;
    }
    EXPECT_EQ(meter.at({0, 0, 0.5f}, {0, 0, 1}, Light::direct, 4).mean, Rgb(0));
}

// A box of 0.2 under a sun is as bright from 300 away as from near: rho E cos / pi along every ray
// that meets its top, none of which starts again from below the surface.
TEST(Laws, DistanceDoesNotDarken) {
    Scene scene;
    const Mat4 turn = glm::rotate(Mat4(1), 0.7f, glm::normalize(Vec3(1, 2, 3)));
    tiny::add_object(
        scene, tiny::box_mesh(Vec3(-0.1f), Vec3(0.1f), tiny::add_material(scene, Rgb(0.5f)), false),
        turn);
    const Vec3 up(turn[2]);
    scene.lights.push_back(tiny::sun(-up - 0.3f * Vec3(turn[0]), Rgb(1)));
    const Meter meter(scene);
    for (const float distance : {1.0f, 100.0f, 300.0f}) {
        std::vector<Ray> rays;
        Rng rng(8);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 place(
                turn * Vec4(0.16f * Vec2(rng.uniform() - 0.5f, rng.uniform() - 0.5f), 0.1f, 1));
            const Vec3 away = glm::normalize(up + Vec3(rng.uniform(), rng.uniform(), 0.2f));
            rays.push_back({place + distance * away, -away});
        }
        std::vector<Rgb> seen(rays.size());
        radiance(meter.lit, rays, {}, seen);
        const float expected = 0.5f / kPi / std::sqrt(1.09f);
        for (const Rgb& radiance : seen) EXPECT_NEAR(radiance.g / expected, 1, 1e-4) << distance;
    }
}

// Single-sided faces let rays of the eye through from behind, and nothing else.
TEST(Laws, SingleSidedBacksAreInvisibleToTheEyeOnly) {
    Scene scene;
    const MaterialId sheet = tiny::add_material(scene, Rgb(0.5f));
    scene.materials[0].double_sided = false;
    tiny::add_quad(scene, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0}, sheet);  // front faces down
    tiny::add_quad(scene, {-1, -1, 1.1f}, {0, 2, 0}, {2, 0, 0}, sheet);
    const MaterialId glow = tiny::add_material(scene, Rgb(0), Rgb(7));
    tiny::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, glow);
    scene.lights.push_back(tiny::sun({0, 0, -1}, Rgb(1)));
    const Meter meter(scene);
    const Ray from_above = {{0.1f, 0.2f, 3}, {0, 0, -1}};
    Rgb seen;
    radiance(meter.lit, {&from_above, 1}, {}, {&seen, 1});
    EXPECT_EQ(seen, Rgb(7));
    EXPECT_EQ(meter.at({0, 0, 0.5f}, {0, 0, 1}, Light::direct, 4).mean, Rgb(0));
}

}  // namespace
}  // namespace chiaro
