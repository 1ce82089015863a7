#include "scene/light.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

TEST(PunctualLights, PointFallsOffWithTheSquare) {
    PunctualLight light;
    light.intensity = {100, 200, 300};
    light.position = {0, 0, 2};
    const auto found = arrival(light, {0, 0, 0});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->to_light, Vec3(0, 0, 1));
    EXPECT_FLOAT_EQ(found->distance, 2);
    EXPECT_FLOAT_EQ(found->irradiance.g, 50);
    EXPECT_FALSE(arrival(light, light.position));
}

TEST(PunctualLights, DirectionalIsTheSameEverywhere) {
    PunctualLight light;
    light.kind = LightKind::directional;
    light.direction = {0, -1, 0};
    light.intensity = Rgb(1000);
    const auto found = arrival(light, {5, 6, 7});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->to_light, Vec3(0, 1, 0));
    EXPECT_EQ(found->distance, kInfinity);
    EXPECT_EQ(found->irradiance.r, 1000);
}

// Full within the inner cone, nothing outside the outer, and between them the square of a ramp in
// the cosine (KHR_lights_punctual).
TEST(PunctualLights, SpotFallsOffBetweenItsCones) {
    PunctualLight light;
    light.kind = LightKind::spot;
    light.direction = {0, 0, -1};
    light.intensity = Rgb(1);
    light.inner_cone = 0.3f;
    light.outer_cone = 0.6f;
    const auto at = [&](float angle) {
        const auto found = arrival(light, {std::sin(angle), 0, -std::cos(angle)});
        return found ? found->irradiance.r : 0.0f;
    };
    EXPECT_NEAR(at(0), 1, 1e-6);
    EXPECT_NEAR(at(0.29f), 1, 1e-5);
    EXPECT_EQ(at(0.61f), 0);
    EXPECT_EQ(at(3), 0);
    const float ramp = (std::cos(0.45f) - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
    EXPECT_NEAR(at(0.45f), ramp * ramp, 1e-4);
}

}  // namespace
}  // namespace chiaro
