// Eight numbers side by side are eight numbers.
#include "base/random.h"
#include "base/vec8.h"

#include <gtest/gtest.h>

#include <array>

namespace chiaro {
namespace {

std::array<float, kLanes> lanes_of(Float8 a) {
    std::array<float, kLanes> lanes;
    a.store(lanes.data());
    return lanes;
}

// Random numbers are the same whichever way they are drawn.
TEST(Wide, HashesAreThoseOfSingleWords) {
    Rng rng(1);
    for (int trial = 0; trial < 100; ++trial) {
        const std::uint32_t a = rng.next(), b = rng.next();
        const Word8 wide = mixed_bits(Word8(a), Word8(b));
        for (const float number : lanes_of(to_float(wide >> 8) * Float8(0x1p-24f)))
            EXPECT_EQ(number, to_unit_float(hash32(a, b)));
    }
}

TEST(Wide, WordsGoIntoLanesAndBack) {
    struct Ten {
        float words[10];
    };
    std::array<Ten, 5> structs;
    for (int s = 0; s < 5; ++s)
        for (int w = 0; w < 10; ++w) structs[s].words[w] = static_cast<float>(10 * s + w);
    Float8 words[kLanes];
    load_words(std::span<const Ten>(structs), 2, words);
    for (int w = 0; w < kLanes; ++w)
        for (int lane = 0; lane < kLanes; ++lane)  // the last one stands for those beyond
            EXPECT_EQ(lanes_of(words[w])[lane], structs[std::min(lane, 4)].words[2 + w]);

    struct Eight {
        float words[8];
    };
    std::array<Eight, kLanes> back;
    store_words(words, back.data());
    for (int lane = 0; lane < kLanes; ++lane)
        for (int w = 0; w < 8; ++w)
            EXPECT_EQ(back[lane].words[w], structs[std::min(lane, 4)].words[2 + w]);
}

TEST(Wide, MasksChooseLaneByLane) {
    alignas(32) const float numbers[kLanes] = {3, -1, 4, -1, 5, -9, 2, -6};
    const Mask8 negative = load8(numbers) < Float8(0);
    EXPECT_EQ(negative.lanes(), 0b1010'1010U);
    EXPECT_EQ((negative & first_lanes(4)).lanes(), 0b1010U);
    EXPECT_EQ(first_lanes(100).lanes(), 0xffU);
    const auto chosen = lanes_of(select(negative, Float8(7), load8(numbers)));
    for (int i = 0; i < kLanes; ++i) EXPECT_EQ(chosen[i], numbers[i] < 0 ? 7 : numbers[i]);
    std::vector<int> visited;
    for_each_lane(negative.lanes(), [&](int lane) { visited.push_back(lane); });
    EXPECT_EQ(visited, (std::vector{1, 3, 5, 7}));
}

// Axes that are orthogonal to each other and right-handed, whichever way the third one points.
TEST(Wide, FramesOfEightAreThoseOfOne) {
    Rng rng(2);
    for (int trial = 0; trial < 100; ++trial) {
        const Vec3 n = glm::normalize(Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5f);
        const Vec3 v(rng.uniform(), rng.uniform(), rng.uniform());
        const Vec3 one = from_frame(n, v);
        const Lanes3 eight(from_frame(everywhere(n), everywhere(v)));
        for (int lane = 0; lane < kLanes; ++lane)
            EXPECT_LT(glm::distance(eight.lane(lane), one), 1e-6f);
        EXPECT_NEAR(glm::length(one), glm::length(v), 1e-6f);
    }
}

}  // namespace
}  // namespace chiaro
