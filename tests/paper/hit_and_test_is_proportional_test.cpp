// 4.2: "the total probability of selecting a patch is proportional to its priority and its
// projected area in pixels".
#include "sample_selector/priorities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

// Four patches with areas as 1 : 2 : 4 : 8 and normalised priorities that equation 1 leaves as they
// are but for epsilon, here 1e-6. Of n selected, a share p has the deviation sqrt(p (1 - p) / n);
// bound 6 of these, false alarm 2e-9.
TEST(PaperHitAndTest, SelectsInProportionToPriorityAndArea) {
    const std::vector<Strip> patches = {{100, 0.9f}, {200, 0.1f}, {400, 0.6f}, {800, 0.3f}};
    const PriorityMap map = strips(patches, 100);
    const PriorityRange range = four_sigma_range(map.patch_priorities);
    constexpr std::size_t kCount = 200'000;
    Rng rng(1);
    std::array<double, 4> counts = {};
    for (const SelectedPixel& s : hit_and_test(map, kCount, 1e-6f, rng))
        counts[index_of(map.patches[s.pixel])] += 1;

    double sum = 0;
    for (const Strip& s : patches) sum += double(s.pixels) * range.normalize(s.priority);
    for (int i = 0; i < 4; ++i) {
        const double p = double(patches[i].pixels) * range.normalize(patches[i].priority) / sum;
        EXPECT_NEAR(counts[i] / kCount, p, 6 * std::sqrt(p * (1 - p) / kCount));
    }
}

// Within a patch all pixels are alike: chi^2 of 100,000 selected over 400 pixels. 399 degrees:
// deviation 28; bound 399 + 6 x 28, false alarm below 1e-7.
TEST(PaperHitAndTest, SpreadsEvenlyOverAPatch) {
    const PriorityMap map = strips({{400, 0.5f}}, 20);
    Rng rng(2);
    std::vector<double> counts(400, 0);
    for (const SelectedPixel& s : hit_and_test(map, 100'000, 0.03f, rng)) counts[s.pixel] += 1;
    double chi2 = 0;
    for (const double n : counts) chi2 += (n - 250) * (n - 250) / 250;
    EXPECT_LT(chi2, 399 + 6 * 28);
}

// "guaranteed to eventually select all pixels in the image plane": the chance that one of 400
// pixels is missed by 40,000 selections is below 400 e^-80.
TEST(PaperHitAndTest, SelectsAllPixelsInTheEnd) {
    const PriorityMap map = strips({{300, 0.1f}, {100, 0.2f}}, 20);
    Rng rng(3);
    std::vector<char> found(400, 0);
    for (const SelectedPixel& s : hit_and_test(map, 40'000, 0.03f, rng)) found[s.pixel] = 1;
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), 400);
}

}  // namespace
}  // namespace chiaro
