// Laws that light keeps whatever the scene: light adds up, paths can be reversed, size and
// orientation do not matter.
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

using tiny::Meter;

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

// Sum of single lamps = all lamps. 1e5 samples each: 0.3 % standard error at most; bound 1.5 %.
TEST(Laws, LampsAddUp) {
    const Vec3 p(3, 2, 0);
    for (const Light light : {Light::direct, Light::indirect}) {
        Rgb sum(0);
        for (const int lamp : {1, 2, 4})
            sum += Meter(room(lamp)).at(p, {0, 0, 1}, light, 100'000, lamp).mean;
        const Rgb all = Meter(room(7)).at(p, {0, 0, 1}, light, 100'000).mean;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(all[c] / sum[c], 1, 0.015) << int(light);
    }
}

// Reciprocity: two patches of one size, one shines and the other receives; swapped, the same flux
// arrives, by all the bounces of the room. Standard error 0.4 %; bound 2 %.
TEST(Laws, SourceAndReceiverSwap) {
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
        Meter meter(scene);
        std::vector<ShadeRequest> requests;
        for (int x = 0; x < 4; ++x)
            for (int y = 0; y < 4; ++y)
                requests.push_back({.where = {ObjectId(source == 0 ? 4 : 3), 0,
                                              (float(x) + 0.5f) / 4, (float(y) + 0.5f) / 4},
                                    .light = Light::total,
                                    .seed = std::uint32_t(requests.size()),
                                    .samples = 1024,
                                    .indirect_samples = 32'768});
        received[source] = 0;
        for (const ShadeResult& result : meter.shade(requests)) received[source] += result.mean.r;
    }
    EXPECT_GT(received[0], 0);
    EXPECT_NEAR(received[0] / received[1], 1, 0.02);
}

Rgb total_in(const Mat4& transform, float intensity_scale) {
    Scene scene = room(7);
    for (Object& object : scene.objects) object.to_world = transform;
    for (PunctualLight& light : scene.lights) {
        light.position = Vec3(transform * Vec4(light.position, 1));
        light.direction = glm::normalize(Vec3(transform * Vec4(light.direction, 0)));
        light.intensity *= intensity_scale;
    }
    const Vec3 p(transform * Vec4(3, 2, 0, 1));
    const Vec3 n = glm::normalize(Vec3(transform * Vec4(0, 0, 1, 0)));
    return Meter(scene).at(p, n, Light::total, 65'536).mean;
}

// Turned and moved, everything is the same; k times as large, area lights give the same and point
// sources need k^2 times the intensity. The random numbers are alike but the frames about normals
// turn differently: standard error 0.3 %, bound 1.5 %.
TEST(Laws, SizeAndOrientationDoNotMatter) {
    const Rgb expected = total_in(Mat4(1), 1);
    const Mat4 turn = glm::translate(Mat4(1), Vec3(3, -8, 5)) *
                      glm::rotate(Mat4(1), 2.1f, glm::normalize(Vec3(3, 1, -2)));
    const Rgb turned = total_in(turn, 1);
    const Rgb large = total_in(glm::scale(Mat4(1), Vec3(100)), 10'000);
    const Rgb small = total_in(glm::scale(Mat4(1), Vec3(0.1f)), 0.01f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(turned[c] / expected[c], 1, 0.015);
        EXPECT_NEAR(large[c] / expected[c], 1, 0.015);
        EXPECT_NEAR(small[c] / expected[c], 1, 0.015);
    }
}

// Panes of alpha 0.25 in the way of a sun leave 0.75 of it; of the light of a lamp and of what
// walls reflect too. 4096 places: standard deviation of the mean 0.7 %; bound 5 of them.
TEST(Laws, BlendedPaneTransmitsWhatItsAlphaLeaves) {
    Scene scene;
    const MaterialId glass = tiny::add_material(scene, Rgb(0));
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].alpha = 0.25f;
    tiny::add_quad(scene, {-5, -5, 1}, {10, 0, 0}, {0, 10, 0}, glass);
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1));
    tiny::add_quad(scene, {-5, -5, 2}, {0, 10, 0}, {10, 0, 0}, lamp);
    Scene open;
    tiny::add_quad(open, {-5, -5, 2}, {0, 10, 0}, {10, 0, 0},
                   tiny::add_material(open, Rgb(0), Rgb(1)));
    const float through = Meter(scene).lux(Vec3(0), {0, 0, 1}, Light::direct, 1 << 16);
    const float clear = Meter(open).lux(Vec3(0), {0, 0, 1}, Light::direct, 1 << 16);
    EXPECT_NEAR(through / clear, 0.75, 0.01);

    scene.materials[1].emission = Rgb(0);
    scene.objects.pop_back();
    scene.lights.push_back(tiny::sun({0.1f, 0.2f, -1}, Rgb(1)));
    const Meter meter(scene);
    double sum = 0;
    for (int x = 0; x < 64; ++x)
        for (int y = 0; y < 64; ++y)
            sum += meter.lux({float(x) / 64, float(y) / 64, 0}, {0, 0, 1}, Light::direct, 4);
    const double unblocked = glm::normalize(Vec3(0.1f, 0.2f, 1)).z;
    EXPECT_NEAR(sum / 4096 / unblocked, 0.75, 0.034);
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
