#include "shading_cache/representatives.h"

#include "base/parallel.h"
#include "scene/surface.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr std::size_t kRange = 4096;  // what one body of a parallel loop does at once

// Sheets in one cell that are told apart; the vertices of further ones, such as leaves of a tree,
// stand for themselves.
constexpr int kMostSheets = 32;

// Sorts vertices of a cell by which way they face and what they are made of.
struct GroupedVertex {
    std::uint64_t group;
    std::uint32_t index;
    bool operator<(const GroupedVertex& other) const {
        return group != other.group ? group < other.group : index < other.index;
    }
};

// Which of the six directions along an axis the normal is nearest to.
std::uint32_t direction_of(Vec3 n) {
    const Vec3 a = glm::abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return static_cast<std::uint32_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

GroupedVertex grouped(const LevelVertex& v, std::size_t index) {
    const auto material = static_cast<std::uint64_t>(v.material);
    return {material << 3 | direction_of(v.normal), static_cast<std::uint32_t>(index)};
}

// The one nearest the middle of what all stand for; the first of several. The middle of their own
// places would let regular meshes choose the same corner of each cell again and again.
std::uint32_t most_central(std::span<const LevelVertex> vertices,
                           std::span<const GroupedVertex> group) {
    const Vec3 origin = vertices[group[0].index].position;
    Vec3 mean(0);
    for (const GroupedVertex& g : group) mean += vertices[g.index].centre - origin;
    mean /= static_cast<float>(group.size());
    std::uint32_t best = group[0].index;
    float least = kInfinity;
    for (const GroupedVertex& g : group) {
        const Vec3 d = vertices[g.index].position - origin - mean;
        if (glm::dot(d, d) >= least) continue;
        least = glm::dot(d, d);
        best = g.index;
    }
    return best;
}

// Takes from the front of `group` until none is left: each representative stands for those whose
// surface goes on to it. What is on another sheet is left for the next.
void choose_in_group(std::span<LevelVertex> vertices, std::span<GroupedVertex> group, float cell,
                     std::span<std::uint32_t> representatives) {
    for (int sheet = 0; sheet < kMostSheets && !group.empty(); ++sheet) {
        const std::uint32_t chosen = most_central(vertices, group);
        LevelVertex& representative = vertices[chosen];
        Vec3 normal(0), centre(0);
        std::size_t left = 0;
        for (const GroupedVertex& g : group) {
            const LevelVertex& v = vertices[g.index];
            if (g.index == chosen || continues(v, representative, cell)) {
                representatives[g.index] = chosen;
                normal += v.normal;
                centre += v.centre - representative.position;
            } else {
                group[left++] = g;
            }
        }
        representative.normal = safe_normalize(normal, representative.normal);
        representative.centre =
            representative.position + centre / static_cast<float>(group.size() - left);
        group = group.first(left);
    }
    for (const GroupedVertex& g : group) representatives[g.index] = g.index;
}

}  // namespace

std::vector<std::uint32_t> choose_representatives(std::span<LevelVertex> vertices,
                                                  const LevelGrid& grid, int threads) {
    std::vector<std::uint32_t> representatives(vertices.size());
    parallel_for_ranges(threads, vertices.size(), kRange, [&](IndexRange r) {
        std::vector<GroupedVertex> in_cell;
        for_cells(vertices, grid, r.begin, r.end, [&](std::size_t first, std::size_t end) {
            if (end == first + 1) {
                representatives[first] = static_cast<std::uint32_t>(first);
                return;
            }
            in_cell.clear();
            for (std::size_t i = first; i < end; ++i) in_cell.push_back(grouped(vertices[i], i));
            std::sort(in_cell.begin(), in_cell.end());
            for (std::size_t i = 0; i < in_cell.size();) {
                std::size_t next = i + 1;
                while (next < in_cell.size() && in_cell[next].group == in_cell[i].group) ++next;
                choose_in_group(vertices, std::span(in_cell).subspan(i, next - i), grid.cell,
                                representatives);
                i = next;
            }
        });
    });
    return representatives;
}

}  // namespace chiaro
