// The built-in gallery is lit as it says: from behind a wall.
#include "sample_renderer/meter.h"
#include "scene/built_in.h"
#include "scene/surface.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// Light that leaves what each camera sees, diffusely: direct light is less than 5 % of all.
TEST(IndirectScene, HardlyAnyLightInViewIsDirect) {
    constexpr int kWidth = 32, kHeight = 24;
    constexpr std::uint32_t kSamples = 64;
    const tiny::Meter meter(*built_in_scene("indirect"));
    for (const Camera& camera : meter.scene.cameras) {
        const View view(camera, kWidth, kHeight);
        double direct = 0, total = 0;
        for (int k = 0; k < kWidth * kHeight; ++k) {
            const Ray ray = view.ray(static_cast<float>(k % kWidth) + 0.5f,
                                     static_cast<float>(k / kWidth) + 0.5f);
            const Hit hit = meter.look(ray.origin, ray.direction);
            ASSERT_TRUE(hit) << camera.name;
            const Vec3 normal = hit.front ? hit.normal : -hit.normal;
            const Vec3 place = ray.origin + hit.t * ray.direction + 1e-4f * normal;
            const auto leaving = [&](Light light) {
                const Rgb irradiance = meter.at(place, normal, light, kSamples).mean;
                return luminance(Rgb(base_color(meter.scene, hit.point)) * irradiance);
            };
            direct += leaving(Light::direct);
            total += leaving(Light::total);
        }
        EXPECT_GT(total, 0) << camera.name;
        EXPECT_LT(direct, 0.05 * total) << camera.name << ": " << direct / total;
        RecordProperty(camera.name, std::to_string(direct / total));
    }
}

}  // namespace
}  // namespace chiaro
