// The Cornell box against an independent program: Radiance 6.1a, rtrace -I, mean of 200 converged
// runs.
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// Their standard errors are 0.04 to 0.4 %; ours about 0.15 %. Tolerance 1 %: false alarms below
// 1e-4 over all fifteen numbers, since the seed is fixed and the margin is 3 to 6 errors.
TEST(CornellBox, FivePointsAgreeWithRadiance) {
    const tiny::Meter meter(tiny::cornell_box());
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
    for (int i = 0; i < 5; ++i) {
        const Rgb e = meter.at(points[i], {0, 1, 0}, Light::total, 1 << 18).mean;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(e[c] / expected[i][c], 1, 0.01) << "point " << i << " channel " << c;
    }
}

}  // namespace
}  // namespace chiaro
