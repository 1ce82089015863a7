#include "sample_selector/select_samples.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <map>

namespace chiaro {

std::vector<SelectedPixel> hit_and_test(const PriorityMap& map, std::size_t count, float epsilon,
                                        Rng& rng) {
    check(0 < epsilon && epsilon <= 1, "hit_and_test: epsilon must be in (0, 1]");
    if (map.patch_priorities.empty()) return {};  // only background in view

    const PriorityRange range = four_sigma_range(map.patch_priorities);
    const auto pixels = static_cast<std::uint32_t>(map.patches.size());
    std::vector<SelectedPixel> selected;
    selected.reserve(count);

    // The bound ends a cycle whose view is mostly background; else the count does.
    const std::size_t max_tests = 64 * count + 1024;
    for (std::size_t test = 0; test < max_tests && selected.size() < count; ++test) {
        // Hit: a uniform pixel, so a patch is hit in proportion to its projected area.
        const std::uint32_t pixel = rng.below(pixels);
        const std::optional<float> priority = map.at(pixel);
        if (!priority) continue;

        // Test: equation 1, p_total = epsilon + (1 - epsilon) p_normalized. One random number
        // serves both terms, and tells which one accepted.
        const float p_total = epsilon + (1 - epsilon) * range.normalize(*priority);
        const float u = rng.uniform();
        if (u < epsilon)
            selected.push_back({pixel, SelectedBy::chance});
        else if (u < p_total)
            selected.push_back({pixel, SelectedBy::priority});
    }
    return selected;
}

std::vector<SelectedPixel> flood_fill(const PriorityMap& map,
                                      const std::vector<SelectedPixel>& selected,
                                      std::size_t count) {
    std::vector<char> visited(map.patches.size(), 0);
    std::vector<std::uint32_t> reached;
    for (const SelectedPixel& s : selected) {
        visited[s.pixel] = 1;
        reached.push_back(s.pixel);
    }

    std::vector<SelectedPixel> filled;
    for (std::size_t next = 0; next < reached.size() && filled.size() < count; ++next) {
        const auto x = static_cast<int>(reached[next] % static_cast<unsigned>(map.width));
        const auto y = static_cast<int>(reached[next] / static_cast<unsigned>(map.width));
        constexpr std::array<std::array<int, 2>, 4> kNeighbours = {
            {{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
        for (const auto& [dx, dy] : kNeighbours) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= map.width || ny >= map.height) continue;
            const auto neighbour = static_cast<std::uint32_t>(ny * map.width + nx);
            if (visited[neighbour] || filled.size() == count) continue;
            const std::optional<float> priority = map.at(neighbour);
            if (!priority || *priority <= map.pixel_priorities[reached[next]]) continue;
            visited[neighbour] = 1;
            reached.push_back(neighbour);
            filled.push_back({neighbour, SelectedBy::flood_fill});
        }
    }
    return filled;
}

std::vector<SelectedPatch> count_by_patch(const PriorityMap& map,
                                          const std::vector<SelectedPixel>& selection) {
    std::map<PatchId, int> counts;
    for (const SelectedPixel& s : selection) ++counts[map.patches[s.pixel]];
    std::vector<SelectedPatch> patches;
    for (const auto& [patch, samples] : counts) patches.push_back({patch, samples});
    std::stable_sort(patches.begin(), patches.end(),
                     [](const auto& a, const auto& b) { return a.samples > b.samples; });
    return patches;
}

std::vector<SelectedPixel> select_samples(const PriorityMap& map, const SelectionSettings& settings,
                                          Rng& rng) {
    const auto flooded =
        static_cast<std::size_t>(static_cast<float>(settings.sample_count) * settings.flood_share);
    auto selected = hit_and_test(map, settings.sample_count - flooded, settings.epsilon, rng);
    const auto filled = flood_fill(map, selected, settings.sample_count - selected.size());
    selected.insert(selected.end(), filled.begin(), filled.end());
    return selected;
}

}  // namespace chiaro
