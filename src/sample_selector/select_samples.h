// BOX Sample Selector: which pixels deserve computing, the paper's Figure 3 as one function.
#pragma once

#include "base/random.h"
#include "sample_selector/priority_map.h"

#include <vector>

namespace chiaro {

/// Why a pixel was selected; Figure 3 shows them red, green and yellow.
enum class SelectedBy : std::uint8_t { priority, chance, flood_fill };

struct SelectedPixel {
    std::uint32_t pixel;
    SelectedBy by;
};

struct SelectionSettings {
    std::size_t sample_count = 70;  // Table 1: 61 to 72 points an update on one client
    float epsilon = 0.03f;          // equation 1; "0.01 to 0.05 work well", in (0, 1]
    float flood_share = 0.5f;       // of the samples that flood fill may take, ours
};

/// Phase one (4.2, 4.3): random pixels, accepted with the probability of equation 1.
/// `count` samples at most; fewer if the view is mostly background.
std::vector<SelectedPixel> hit_and_test(const PriorityMap& map, std::size_t count, float epsilon,
                                        Rng& rng);

/// Phase two (4.4): neighbours of `selected` whose priority is greater than that of the sample that
/// they were reached from, and so on uphill; no pixel twice; at most `count`.
std::vector<SelectedPixel> flood_fill(const PriorityMap& map,
                                      const std::vector<SelectedPixel>& selected,
                                      std::size_t count);

/// A patch, and how many of the selected samples lie on it.
struct SelectedPatch {
    PatchId patch;
    int samples;
};
/// The patches of the selected pixels, each once, those with the most samples first (3.1).
std::vector<SelectedPatch> count_by_patch(const PriorityMap& map,
                                          const std::vector<SelectedPixel>& selection);

/// Both phases.
std::vector<SelectedPixel> select_samples(const PriorityMap& map, const SelectionSettings& settings,
                                          Rng& rng);

}  // namespace chiaro
