// The Cornell box against an independent program: Radiance 6.1a, rtrace -I, mean of 200 converged
// runs.
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

#include <array>

namespace chiaro {
namespace {

// Their standard errors are 0.04 to 0.4 %, that of the first point, where we find 0.5 to 0.9 %
// more; ours 0.05 to 0.2 %. Bounds of 2 % there and 1 % elsewhere are at least 5 of ours from what
// we find: false alarm 6e-7 a number.
TEST(CornellBox, FivePointsAgreeWithRadiance) {
    const Vec3 points[5] = {{2.78f, 1e-4f, 0.6f},
                            {4.2f, 1e-4f, 1.5f},
                            {0.4f, 1e-4f, 3.0f},
                            {3.2f, 1e-4f, 4.9f},
                            {2.78f, 1e-4f, 2.0f}};
    const Rgb expected[5] = {{0.20387f, 0.09896f, 0.02872f},
                             {0.83502f, 0.49900f, 0.15955f},
                             {0.76103f, 0.61675f, 0.16395f},
                             {0.53719f, 0.35864f, 0.09638f},
                             {1.03982f, 0.66359f, 0.21275f}};
    for (const tiny::Truth by : tiny::kTruths)
        for (int i = 0; i < 5; ++i) {
            const tiny::Meter meter(tiny::cornell_box(), by);
            const std::uint32_t samples = meter.worth(i == 0 ? 1 << 19 : 1 << 18);
            const Rgb e = meter.at(points[i], {0, 1, 0}, Light::total, samples).mean;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e[c] / expected[i][c], 1, within(by, i == 0 ? 0.02 : 0.01))
                    << "point " << i << " channel " << c << " by " << int(by);
        }
}

// Lambert's formula: irradiance at `place` from an evenly glowing polygon that is wholly above its
// horizon, as a sum over the edges.
double lambert(std::span<const glm::dvec3> corners, glm::dvec3 place, glm::dvec3 normal) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - place);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - place);
        const glm::dvec3 across = glm::cross(a, b);
        sum += std::atan2(glm::length(across), glm::dot(a, b)) *
               glm::dot(glm::normalize(across), normal);
    }
    return std::abs(sum) / 2;
}

// High on the back wall, where light leaves the lamp at grazing angles, direct light is what
// Lambert's formula says, within 1 % at every point and 0.1 % on average: standard errors over
// seeds 0.03 % and 0.002 %, false alarm below 1e-9.
TEST(CornellBox, BackWallAgreesWithLambertsFormula) {
    const tiny::Meter meter(tiny::cornell_box());
    const std::array<glm::dvec3, 4> lamp = {glm::dvec3{3.43, 5.483, 2.27},
                                            {3.43, 5.483, 3.32},
                                            {2.13, 5.483, 3.32},
                                            {2.13, 5.483, 2.27}};
    double mean = 0;
    int count = 0;
    for (double y = 3.7; y < 5.33; y += 0.2)
        for (double x = 0.2; x < 5.4; x += 0.4) {
            const double expected = 17 * lambert(lamp, {x, y, 5.592}, {0, 0, -1});
            const auto seed = static_cast<std::uint32_t>(count++);
            const Rgb found =
                meter.at({x, y, 5.592f}, {0, 0, -1}, Light::direct, 1 << 14, seed).mean;
            EXPECT_NEAR(found.r / expected, 1, 0.01) << x << " " << y;
            EXPECT_NEAR(found.g / found.r, 12.0 / 17, 1e-5);
            mean += found.r / expected;
        }
    EXPECT_NEAR(mean / count, 1, 0.001);
}

}  // namespace
}  // namespace chiaro
