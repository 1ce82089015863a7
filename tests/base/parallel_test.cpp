#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace chiaro {
namespace {

// A denormal, hidden from the compiler, divided by 2: zero where denormals are flushed.
float half_of_a_denormal() {
    volatile float tiny = std::numeric_limits<float>::min();
    return tiny * 0.5f;
}

class ParallelFor : public testing::TestWithParam<int> {};

TEST_P(ParallelFor, VisitsEachIndexOnce) {
    std::vector<int> visits(100'000, 0);
    parallel_for(GetParam(), visits.size(), [&](std::size_t i) { ++visits[i]; });
    EXPECT_TRUE(std::ranges::all_of(visits, [](int v) { return v == 1; }));
}

TEST_P(ParallelFor, SeesWhatWasWrittenBeforeAndShowsWhatItWrote) {
    std::vector<int> in(10'000), out(10'000);
    for (int round = 0; round < 20; ++round) {
        std::iota(in.begin(), in.end(), round);
        parallel_for(GetParam(), in.size(), [&](std::size_t i) { out[i] = 2 * in[i]; });
        for (std::size_t i = 0; i < out.size(); ++i)
            ASSERT_EQ(out[i], 2 * (static_cast<int>(i) + round));
    }
}

TEST_P(ParallelFor, MakesNoCallForNothing) {
    parallel_for(GetParam(), 0, [](std::size_t) { FAIL(); });
}

TEST_P(ParallelFor, FlushesDenormalsInTheBodyOnly) {
    std::vector<float> inside(1000, 1.0f);
    const float before = half_of_a_denormal();
    parallel_for(GetParam(), inside.size(),
                 [&](std::size_t i) { inside[i] = half_of_a_denormal(); });
    EXPECT_TRUE(std::ranges::all_of(inside, [](float f) { return f == 0.0f; }));
    EXPECT_EQ(half_of_a_denormal(), before);
}

TEST_P(ParallelFor, HandsAnExceptionToTheCaller) {
    const auto fails = [](std::size_t i) {
        if (i == 700) throw std::runtime_error("700");
    };
    EXPECT_THROW(parallel_for(GetParam(), 1000, fails), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 4));

TEST(Parallel, TheMachineHasAThread) {
    EXPECT_GE(hardware_threads(), 1);
}

}  // namespace
}  // namespace chiaro
