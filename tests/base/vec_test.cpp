#include "base/vec.h"

#include <gtest/gtest.h>

#include "base/random.h"

#include <cmath>

namespace chiaro {
namespace {

void expect_orthonormal(Vec3 n) {
    const Frame frame(n);
    EXPECT_NEAR(glm::length(frame.s), 1, 1e-6f);
    EXPECT_NEAR(glm::length(frame.t), 1, 1e-6f);
    EXPECT_NEAR(glm::dot(frame.s, frame.t), 0, 1e-6f);
    EXPECT_NEAR(glm::dot(frame.s, frame.n), 0, 1e-6f);
    EXPECT_NEAR(glm::length(glm::cross(frame.s, frame.t) - frame.n), 0, 2e-6f);  // right-handed
    EXPECT_EQ(frame.to_world({0, 0, 1}), n);
}

TEST(Frame, IsOrthonormalAndRightHandedForEveryNormal) {
    for (const float sign : {-1.0f, 1.0f})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 n(0);
            n[axis] = sign;
            expect_orthonormal(n);
        }
    expect_orthonormal({0, 0, -1});
    expect_orthonormal(glm::normalize(Vec3(1e-4f, 1e-4f, -1)));  // where older methods break
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) {
        const float z = 2 * rng.uniform() - 1;
        const float angle = 2 * kPi * rng.uniform();
        const float r = std::sqrt(1 - z * z);
        expect_orthonormal(glm::normalize(Vec3(r * std::cos(angle), r * std::sin(angle), z)));
    }
}

TEST(Box, IsEmptyUntilSomethingIsAdded) {
    Box box;
    EXPECT_TRUE(box.empty());
    EXPECT_EQ(box.diagonal(), 0);
    box.add(Vec3(1, 2, 3));
    EXPECT_FALSE(box.empty());
    box.add(Vec3(3, 2, 1));
    EXPECT_EQ(box.centre(), Vec3(2, 2, 2));
    EXPECT_FLOAT_EQ(box.diagonal(), std::sqrt(8.0f));
    Box all;
    all.add(box);
    all.add(Box());  // nothing
    EXPECT_EQ(all.low, box.low);
    EXPECT_EQ(all.high, box.high);
}

TEST(IsFinite, FindsEachBadComponent) {
    EXPECT_TRUE(is_finite({1, -2, 3e30f}));
    for (int axis = 0; axis < 3; ++axis)
        for (const float bad : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
            Vec3 v(1);
            v[axis] = bad;
            EXPECT_FALSE(is_finite(v));
        }
    EXPECT_FALSE(is_finite({kInfinity, -kInfinity, 0}));
}

}  // namespace
}  // namespace chiaro
