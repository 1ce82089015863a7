#include "scene/pool_table.h"

#include "scene/pool_pockets.h"
#include "scene/pool_rails.h"
#include "scene/rail_section.h"
#include "scene/shapes.h"

#include <cmath>

namespace chiaro {
namespace {

void add_leg(Mesh& mesh, const HallPalette& palette, Vec2 place) {
    const Vec2 turned_leg[] = {{0.075f, 0},    {0.08f, 0.03f},  {0.06f, 0.06f},   {0.05f, 0.08f},
                               {0.065f, 0.1f}, {0.05f, 0.12f},  {0.058f, 0.2f},   {0.082f, 0.32f},
                               {0.07f, 0.4f},  {0.055f, 0.42f}, {0.075f, 0.445f}, {0.075f, 0.46f}};
    add(mesh, lathe(turned_leg, 10), palette.rail, moved({place.x, 0, place.y}));
    add(mesh,
        box({place.x - 0.09f, 0.46f, place.y - 0.09f}, {place.x + 0.09f, 0.56f, place.y + 0.09f}),
        palette.rail);
}

// The frame under the rails: a board with mouldings above and below, all round.
void add_apron(Mesh& mesh, const HallPalette& palette) {
    constexpr float kInset = 0.045f;
    const Vec2 half = kHalfField + Vec2(kRailOutside - kInset);
    const Mat4 lying = moved({-half.x, kClothHeight, half.y}) * turned({1, 0, 0}, -90);
    const Vec2 profile[] = {{0.2f, -0.26f},     {0.002f, -0.26f},  {-0.006f, -0.25f},
                            {-0.006f, -0.235f}, {0.006f, -0.225f}, {0, -0.09f},
                            {-0.012f, -0.08f},  {-0.012f, -0.06f}, {0.12f, -0.06f}};
    add(mesh, moulding(2.0f * half, profile), palette.rail, lying);
}

// The cloth, in bands across: all but what the pockets' edges are made of.
void add_bed(Mesh& mesh, const HallPalette& palette) {
    const Vec2 cloth = kHalfField + Vec2(kClothUnder), inner = kHalfField - Vec2(kCornerCut);
    struct Band {
        float half_width, from, to;
    };
    const Band bands[] = {{inner.x, -cloth.y, -inner.y},
                          {cloth.x, -inner.y, -kSideCut.y},
                          {kHalfField.x - kSideCut.x, -kSideCut.y, kSideCut.y},
                          {cloth.x, kSideCut.y, inner.y},
                          {inner.x, inner.y, cloth.y}};
    for (const auto& [x, from, to] : bands)
        add(mesh,
            quad({-x, kClothHeight, to}, {x, kClothHeight, to}, {x, kClothHeight, from},
                 {-x, kClothHeight, from}),
            palette.cloth);
}

}  // namespace

Mesh pool_table(const HallPalette& palette) {
    Mesh mesh;
    add_bed(mesh, palette);
    add_rails(mesh, palette, kHalfField, moved({0, kClothHeight, 0}));
    add_apron(mesh, palette);
    for (const float x : {-0.6f, 0.6f})
        for (const float z : {-1.18f, 1.18f}) add_leg(mesh, palette, {x, z});
    return mesh;
}

Mesh cue(const HallPalette& palette) {
    const Vec2 butt[] = {{0, 0}, {0.0145f, 0.002f}, {0.0145f, 0.002f}, {0.0125f, 0.4f}};
    const Vec2 grip[] = {{0.0125f, 0.4f}, {0.0105f, 0.75f}};
    const Vec2 shaft[] = {{0.0105f, 0.75f}, {0.0065f, 1.45f}};
    const Vec2 tip[] = {{0.0065f, 1.45f}, {0.0065f, 1.466f}, {0, 1.47f}};
    Mesh mesh;
    add(mesh, lathe(butt, 8), palette.leather);
    add(mesh, lathe(grip, 8), palette.rail);
    add(mesh, lathe(shaft, 8), palette.cue_shaft);
    add(mesh, lathe(tip, 8), palette.chalk);
    return mesh;
}

Mesh ball_rack(const HallPalette& palette) {
    constexpr float kInner = 0.19f;  // from the middle to a corner
    constexpr float kWood = 0.014f;
    std::vector<std::vector<Vec3>> rings;
    for (int k = 0; k < 3; ++k) {
        const float angle = glm::radians(-120.0f * static_cast<float>(k));
        const Vec3 out(std::sin(angle), 0, std::cos(angle));
        const float inner = kInner, outer = kInner + 2 * kWood;
        rings.push_back({inner * out, outer * out, outer * out + Vec3(0, 0.05f, 0),
                         inner * out + Vec3(0, 0.05f, 0)});
    }
    Mesh mesh;
    add(mesh, loft(rings, true), palette.rail);
    return mesh;
}

Mesh chalk(const HallPalette& palette) {
    constexpr float kHalf = 0.011f, kHigh = 0.022f, kHollow = 0.007f;
    Mesh mesh;
    add(mesh, box({-kHalf, 0, -kHalf}, {kHalf, kHigh, kHalf}, kBottom | kTop), palette.label);
    const Vec2 worn[] = {{kHollow, kHigh}, {0.6f * kHollow, kHigh - 0.003f}, {0, kHigh - 0.004f}};
    add(mesh, lathe(worn, 8), palette.chalk);
    const auto rim = [](float u, float v) {
        const float angle = -2 * kPi * u;
        const Vec2 round(std::cos(angle), std::sin(angle));
        const float square = kHalf / std::max(std::abs(round.x), std::abs(round.y));
        const Vec2 p = glm::mix(kHollow, square, v) * round;
        return Vec3(p.x, kHigh, p.y);
    };
    add(mesh, sheet(8, 1, rim), palette.chalk);
    return mesh;
}

}  // namespace chiaro
