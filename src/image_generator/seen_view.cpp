#include "image_generator/seen_view.h"

#include "base/parallel.h"
#include "image_generator/view_on_roots.h"

#include <algorithm>

namespace chiaro {
namespace {

// What is hit on a box's surface may be found just outside of it: parts of the scene's diagonal.
constexpr float kMargin = 1e-4f;

bool goes_through(const SightLine& line, const Box& box) {
    const Vec3 inverse = 1.0f / (line.to - line.from);
    float in = 0, out = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = (box.low[axis] - line.from[axis]) * inverse[axis];
        const float b = (box.high[axis] - line.from[axis]) * inverse[axis];
        // Where a line runs along a side, one of them is no number, and says nothing.
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
    }
    return in <= out;
}

std::vector<Box> widened(std::span<const Box> boxes, float by) {
    std::vector<Box> wider(boxes.begin(), boxes.end());
    for (Box& box : wider) {
        box.low -= by;
        box.high += by;
    }
    return wider;
}

// Marks, by x, the pixels of a row with such a line. Returns how many there are.
std::size_t find_changed(std::span<const SightLine> lines, std::span<const Box> boxes,
                         std::vector<char>& changed) {
    for (const SightLine& line : lines)
        if (!changed[line.x])
            changed[line.x] =
                std::ranges::any_of(boxes, [&](const Box& box) { return goes_through(line, box); });
    return static_cast<std::size_t>(std::ranges::count(changed, 1));
}

}  // namespace

SeenView see_view(ShadingCache& cache, const RayCaster& rays, const View& view,
                  const RayViewSettings& settings, OpenSides* open_sides) {
    const Viewing viewing = make_viewing(rays, view, settings);
    std::vector<SeenRow> rows(view.height());
    SeenView seen;
    seen.lines.resize(rows.size());
    parallel_for(settings.threads, rows.size(), [&](std::size_t y) {
        rows[y] = see_row(viewing, static_cast<int>(y), {.lines = &seen.lines[y]});
    });
    if (open_sides) mark_open_sides(*open_sides, rows);
    seen.map = put_on_roots(cache, rows, viewing, nullptr, settings.threads);
    return seen;
}

std::size_t see_changes(SeenView& seen, ShadingCache& cache, const RayCaster& rays,
                        const View& view, const RayViewSettings& settings, OpenSides* open_sides,
                        std::span<const Box> boxes) {
    const Viewing viewing = make_viewing(rays, view, settings);
    const std::vector<Box> wider = widened(boxes, kMargin * bounds(rays.scene()).diagonal());
    std::vector<SeenRow> rows(view.height());
    std::vector<std::size_t> counts(rows.size());
    parallel_for(settings.threads, rows.size(), [&](std::size_t y) {
        std::vector<SightLine>& lines = seen.lines[y];
        std::vector<char> changed(view.width(), 0);
        counts[y] = find_changed(lines, wider, changed);
        std::erase_if(lines, [&](const SightLine& line) { return changed[line.x] != 0; });
        rows[y] = see_part_of_row(viewing, static_cast<int>(y), std::move(changed), lines);
    });
    if (open_sides) mark_open_sides(*open_sides, rows);
    seen.map = put_on_roots(cache, rows, viewing, &seen.map, settings.threads);
    std::size_t total = 0;
    for (const std::size_t count : counts) total += count;
    return total;
}

}  // namespace chiaro
