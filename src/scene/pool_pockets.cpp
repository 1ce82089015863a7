#include "scene/pool_pockets.h"

#include "scene/rail_section.h"
#include "scene/shapes.h"

#include <cmath>
#include <vector>

namespace chiaro {
namespace {

constexpr float kCorner = 0.07f;  // radius of the castings' outer corners, seen from above

// Its edge runs through the backs of
// the two cushions' ends.
struct Hole {
    Vec2 centre;
    Vec2 jaw;  // the end towards -z
    bool corner;

    float radius() const { return glm::distance(centre, jaw); }
    float first() const { return std::atan2(jaw.y - centre.y, jaw.x - centre.x); }
    float last() const { return corner ? 0.5f * kPi - first() : -first(); }
    Vec2 edge(float angle, float more = 0) const {
        return centre + (radius() + more) * Vec2(std::cos(angle), std::sin(angle));
    }
    Vec2 other_end(Vec2 p) const { return corner ? Vec2(p.y, p.x) : Vec2(p.x, -p.y); }
};

constexpr Hole kCornerHole = {{0.033f, 0.033f}, {kCushionBack, kCornerJaw - kCornerMouth}, true};
constexpr Hole kSideHole = {{0.063f, 0}, {kCushionBack, kSideJaw - kSideMouth}, false};

Vec3 lifted(Vec2 p, float height) {
    return {p.x, height, p.y};
}

// A casting's stations round its hole, and where they end outside.
constexpr int kRound = 8;

Vec2 casting_outside(const Hole& hole, int station) {
    if (2 * station > kRound) return hole.other_end(casting_outside(hole, kRound - station));
    if (!hole.corner) {
        const float middle = 2 * static_cast<float>(station) / kRound;
        return {kRailOutside, glm::mix(hole.jaw.y, 0.0f, middle)};
    }
    constexpr int kStraight = 2;
    const float centre = kRailOutside - kCorner;
    const auto along = static_cast<float>(station) / kStraight;
    if (station < kStraight) return {kRailOutside, glm::mix(hole.jaw.y, centre, along)};
    const float angle = 0.5f * kPi * static_cast<float>(station - kStraight) /
                        static_cast<float>(kRound - 2 * kStraight);
    return Vec2(centre) + kCorner * Vec2(std::cos(angle), std::sin(angle));
}

// The casting is flush with the wood, and goes on along it on both sides of its hole.
std::vector<RailStation> casting_stations(const Hole& hole) {
    const float start = hole.jaw.y - kPlate;
    const RailStation first = {{kCushionBack, start}, {kRailOutside, start}};
    std::vector<RailStation> stations = {first};
    for (int k = 0; k <= kRound; ++k) {
        const float angle = glm::mix(hole.first(), hole.last(), static_cast<float>(k) / kRound);
        stations.push_back({hole.edge(angle), casting_outside(hole, k)});
    }
    stations.push_back({hole.other_end(first.inner), hole.other_end(first.outer)});
    return stations;
}

// What the bed leaves out around a hole, its rounded edge, and the bag below.
void add_drop(Mesh& mesh, const HallPalette& palette, const Hole& hole, const Mat4& placement) {
    constexpr int kColumns = 8;
    const float from = hole.first() + 2 * kPi, to = hole.last();
    const auto angle = [&](float u) { return glm::mix(from, to, u); };
    const Vec2 cut = hole.corner ? Vec2(kCornerCut) : kSideCut;
    const Vec2 ends[] = {{kClothUnder, -cut.y},
                         {-cut.x, -cut.y},
                         hole.other_end({-cut.x, -cut.y}),
                         hole.other_end({kClothUnder, -cut.y})};
    // At a corner the two in the middle are one.
    const auto border = [&](float u) {
        if (hole.corner)
            return u < 0.5f ? glm::mix(ends[0], ends[1], 2 * u)
                            : glm::mix(ends[2], ends[3], 2 * u - 1);
        if (u < 0.25f) return glm::mix(ends[0], ends[1], 4 * u);
        if (u > 0.75f) return glm::mix(ends[2], ends[3], 4 * u - 3);
        return glm::mix(ends[1], ends[2], 2 * u - 0.5f);
    };
    Mesh shelf = sheet(kColumns, 1, [&](float u, float v) {
        return lifted(glm::mix(border(u), hole.edge(angle(u)), v), 0);
    });
    for (std::size_t i = 0; i < shelf.positions.size(); ++i)
        shelf.uvs[0][i] = {shelf.positions[i].x, shelf.positions[i].z};
    add(mesh, shelf, palette.cloth, placement);
    const Mesh lip = sheet(kColumns, 1, [&](float u, float v) {
        return lifted(hole.edge(angle(u), -0.003f * v), -0.012f * v);
    });
    add(mesh, lip, palette.cloth, placement);

    const float r = hole.radius();
    const Vec2 bag[] = {
        {r + 0.002f, -0.004f}, {r - 0.009f, -0.12f}, {r - 0.009f, -0.12f}, {0, -0.13f}};
    add(mesh, lathe(bag, 8), palette.leather, placement * moved(lifted(hole.centre, 0)));
}

void add_pocket(Mesh& mesh, const HallPalette& palette, const Hole& hole, const Mat4& placement) {
    add_drop(mesh, palette, hole, placement);
    add_rail(mesh, casting_stations(hole), palette.leather, palette.casting, placement);
}

}  // namespace

void add_corner_pocket(Mesh& mesh, const HallPalette& palette, const Mat4& placement) {
    add_pocket(mesh, palette, kCornerHole, placement);
}

void add_side_pocket(Mesh& mesh, const HallPalette& palette, const Mat4& placement) {
    add_pocket(mesh, palette, kSideHole, placement);
}

}  // namespace chiaro
