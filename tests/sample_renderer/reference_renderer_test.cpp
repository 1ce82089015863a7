#include "sample_renderer/reference_renderer.h"

#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using tiny::Meter;

Camera cornell_camera() {
    Camera camera;
    camera.eye = {2.78f, 2.73f, -8};
    camera.target = {2.78f, 2.73f, 0};
    camera.vertical_fov = 39.30764811610662f;
    return camera;
}

// Sizes that are no multiples of a tile.
Image picture(const Meter& meter, int threads, std::vector<std::uint32_t> passes) {
    ReferenceRenderer renderer(meter.lit, View(cornell_camera(), 45, 35),
                               {.seed = 3, .threads = threads});
    for (const std::uint32_t pass : passes) renderer.add_pass(pass);
    return renderer.image();
}

TEST(ReferenceRenderer, SameBitsOnAnyThreadsAndAnyPasses) {
    const Meter meter(tiny::cornell_box());
    const Image one = picture(meter, 1, {8});
    EXPECT_EQ(one.pixels, picture(meter, 2, {8}).pixels);
    EXPECT_EQ(one.pixels, picture(meter, 3, {1, 4, 3}).pixels);
}

// A pixel's radiance is albedo / pi times the irradiance of what it shows: the picture and the
// meter agree on the floor, in all channels. Standard error over seeds 0.45 %, and the middle of a
// pixel has 0.15 % more than its mean; bound 5 of them, false alarm 6e-7 a channel.
TEST(ReferenceRenderer, AgreesWithIrradiance) {
    const Meter meter(tiny::cornell_box());
    const View view(cornell_camera(), 45, 35);
    ReferenceRenderer renderer(meter.lit, view, {.seed = 5, .threads = 2});
    renderer.add_pass(2048);
    const Image image = renderer.image();
    Rgb seen(0), expected(0);
    for (int y = 31; y < 34; ++y) {
        for (int x = 18; x < 21; ++x) {
            seen += image.at(x, y);
            const Ray ray = view.ray(float(x) + 0.5f, float(y) + 0.5f);
            Hit hit;
            meter.caster.intersect({&ray, 1}, {&hit, 1});
            ASSERT_EQ(hit.point.object, ObjectId(0));
            const Vec3 p = ray.origin + hit.t * ray.direction;
            const Rgb e = meter.at(p + Vec3(0, 1e-4f, 0), {0, 1, 0}, Light::total, 1 << 14).mean;
            expected += e * Rgb(base_color(meter.scene, hit.point)) / kPi;
        }
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / expected[c], 1, 0.025);
}

// The lamp is seen with its radiance, the empty background black.
TEST(ReferenceRenderer, SeesEmissionAndNothing) {
    Scene scene;
    tiny::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0},
                   tiny::add_material(scene, Rgb(0), {1, 2, 3}));
    const Meter meter(scene);
    Camera camera;
    camera.eye = {0, 0, 3};
    camera.vertical_fov = 90;
    ReferenceRenderer renderer(meter.lit, View(camera, 32, 32), {});
    EXPECT_EQ(renderer.image().at(16, 16), Rgb(0));
    renderer.add_pass(4);
    EXPECT_EQ(renderer.samples(), 4u);
    EXPECT_EQ(renderer.image().at(16, 16), Rgb(1, 2, 3));
    EXPECT_EQ(renderer.image().at(1, 1), Rgb(0));
}

}  // namespace
}  // namespace chiaro
