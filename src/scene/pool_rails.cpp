#include "scene/pool_rails.h"

#include "scene/pool_pockets.h"
#include "scene/rail_section.h"
#include "scene/shapes.h"

#include <cmath>
#include <vector>

namespace chiaro {
namespace {

constexpr float kNose = 0.0365f;  // above the cloth: 63.5 % of a ball

// One side of the field between two pockets: from z = `from` to `to` at the nose, in a frame whose
// x axis points outward from the noses at x = 0.
struct Side {
    float from, to;
    float jaw_from, jaw_to;
    Mat4 placement;
};

// Cushions are longer at their backs.
void add_cushion(Mesh& mesh, MaterialId cloth, const Side& side) {
    constexpr float kBehind = kCushionBack + 0.0005f;
    constexpr Vec2 kSection[] = {
        {0.022f, -0.002f},        {kBehind, -0.002f}, {kBehind, kRailTop - kRailBevel},
        {0.004f, kNose + 0.004f}, {0, kNose},         {0.004f, kNose - 0.006f}};
    std::vector<std::vector<Vec3>> rings(2);
    for (const Vec2 p : kSection) {
        const float back = p.x / kCushionBack;
        rings[0].push_back({p.x, p.y, side.from - back * side.jaw_from});
        rings[1].push_back({p.x, p.y, side.to + back * side.jaw_to});
    }
    add(mesh, loft(rings), cloth, side.placement);
    // The section is convex and of an even number of points: its ends are strips of quads.
    const std::size_t n = std::size(kSection);
    for (std::size_t a = 0; 2 * a + 2 < n; ++a) {
        const std::size_t b = a + 1, c = n - 2 - a, d = n - 1 - a;
        const auto &low = rings[0], &high = rings[1];
        add(mesh, quad(high[a], high[b], high[c], high[d]), cloth, side.placement);
        add(mesh, quad(low[d], low[c], low[b], low[a]), cloth, side.placement);
    }
}

// Sights divide the field's sides into lengths of `pitch`, counted from z = 0.
void add_sights(Mesh& mesh, MaterialId inlay, const Side& side, float pitch) {
    constexpr float kX = 0.5f * (kCushionBack + kRailOutside), kLong = 0.0145f, kWide = 0.0075f;
    constexpr float kY = kRailTop + 0.0003f;
    for (float z = pitch * std::ceil(side.from / pitch); z < side.to; z += pitch)
        add(mesh,
            quad({kX, kY, z + kWide}, {kX + kLong, kY, z}, {kX, kY, z - kWide},
                 {kX - kLong, kY, z}),
            inlay, side.placement);
}

void add_side(Mesh& mesh, const HallPalette& palette, const Side& side, float pitch) {
    add_cushion(mesh, palette.cloth, side);
    const float from = side.from - side.jaw_from + kPlate, to = side.to + side.jaw_to - kPlate;
    const RailStation stations[] = {{{kCushionBack, from}, {kRailOutside, from}},
                                    {{kCushionBack, to}, {kRailOutside, to}}};
    add_rail(mesh, stations, palette.rail, palette.rail, side.placement);
    add_sights(mesh, palette.inlay, side, pitch);
}

}  // namespace

void add_rails(Mesh& mesh, const HallPalette& palette, Vec2 half, const Mat4& placement) {
    const float pitch = half.y / 4;
    for (const float turn : {0.0f, 180.0f}) {
        const Mat4 turning = placement * turned({0, 1, 0}, turn);
        const Mat4 long_side = turning * moved({half.x, 0, 0});
        const float end = half.y - kCornerMouth;
        add_side(mesh, palette, {-end, -kSideMouth, kCornerJaw, kSideJaw, long_side}, pitch);
        add_side(mesh, palette, {kSideMouth, end, kSideJaw, kCornerJaw, long_side}, pitch);
        const float across = half.x - kCornerMouth;
        const Mat4 quarter = turned({0, 1, 0}, 90);
        const Mat4 short_side = turning * quarter * moved({half.y, 0, 0});
        add_side(mesh, palette, {-across, across, kCornerJaw, kCornerJaw, short_side}, pitch);

        add_side_pocket(mesh, palette, long_side);
        add_corner_pocket(mesh, palette, turning * moved({half.x, 0, half.y}));
        add_corner_pocket(mesh, palette, turning * moved({half.x, 0, -half.y}) * quarter);
    }
}

}  // namespace chiaro
