#include "scene/pool_table.h"

#include "scene/shapes.h"

#include <cmath>

namespace chiaro {
namespace {

constexpr float kBack = 0.05f;      // from a cushion's nose to its back
constexpr float kOutside = 0.165f;  // from the noses to the outer edge of the rails
constexpr float kNose = 0.0365f;    // above the cloth: 63.5 % of a ball
constexpr float kRailTop = kRailHeight - kClothHeight;

// One side of the field between two pockets: from z = `from` to `to` in a frame whose x axis points
// outward from the noses at x = 0 and whose y = 0 is the cloth. Cushions are longer at their backs.
struct Side {
    float from, to;
    float jaw_from, jaw_to;  // how much longer
    Mat4 placement;
};

// Sweeps a section, counter-clockwise as seen from +z, along a side, with caps.
void add_swept(Mesh& mesh, const std::vector<Vec2>& section, const Side& side, float jaw_scale,
               MaterialId material) {
    std::vector<std::vector<Vec3>> rings(2);
    for (const Vec2 p : section) {
        const float jaw = jaw_scale * std::max(0.0f, p.x);
        rings[0].push_back({p.x, p.y, side.from - jaw * side.jaw_from});
        rings[1].push_back({p.x, p.y, side.to + jaw * side.jaw_to});
    }
    add(mesh, loft(rings), material, side.placement);
    // Sections are convex and of an even number of points: caps are strips of quads.
    const std::size_t n = section.size();
    for (std::size_t i = 0; 2 * i + 2 < n; ++i) {
        const std::size_t a = i, b = i + 1, c = n - 2 - i, d = n - 1 - i;
        add(mesh, quad(rings[1][a], rings[1][b], rings[1][c], rings[1][d]), material,
            side.placement);
        add(mesh, quad(rings[0][d], rings[0][c], rings[0][b], rings[0][a]), material,
            side.placement);
    }
}

void add_sights(Mesh& mesh, const Side& side, int count, MaterialId material) {
    constexpr float kX = 0.108f, kLong = 0.016f, kWide = 0.008f;
    constexpr float kY = kRailTop + 0.0004f;
    for (int i = 1; i <= count; ++i) {
        const float z =
            glm::mix(side.from, side.to, static_cast<float>(i) / static_cast<float>(count + 1));
        add(mesh,
            quad({kX, kY, z + kWide}, {kX + kLong, kY, z}, {kX, kY, z - kWide},
                 {kX - kLong, kY, z}),
            material, side.placement);
    }
}

void add_side(Mesh& mesh, const HallPalette& palette, const Side& side) {
    const std::vector<Vec2> cushion = {{0.022f, -0.002f},
                                       {kBack + 0.002f, -0.002f},
                                       {kBack + 0.002f, kRailTop - 0.003f},
                                       {0.004f, kNose + 0.004f},
                                       {0, kNose},
                                       {0.004f, kNose - 0.006f}};
    const std::vector<Vec2> rail = {{kBack, -0.07f},
                                    {kOutside - 0.01f, -0.07f},
                                    {kOutside, -0.05f},
                                    {kOutside, kRailTop - 0.02f},
                                    {kOutside - 0.004f, kRailTop - 0.007f},
                                    {kOutside - 0.014f, kRailTop},
                                    {kBack + 0.003f, kRailTop},
                                    {kBack, kRailTop - 0.003f}};
    add_swept(mesh, cushion, side, 1 / kBack, palette.cloth);
    add_swept(mesh, rail, side, 0, palette.rail);
    add_sights(mesh, side, 3, palette.inlay);
    // The cloth goes on under the cushion.
    add(mesh, quad({0, 0, side.from}, {0, 0, side.to}, {0.03f, 0, side.to}, {0.03f, 0, side.from}),
        palette.cloth, side.placement);
}

// A leather pocket about the y axis and the casting round it, which is open over `gap` degrees
// towards -x; y = 0 is the cloth.
void add_pocket(Mesh& mesh, const HallPalette& palette, float radius, float gap,
                const Mat4& placement) {
    constexpr int kSides = 12;
    constexpr float kRim = 0.045f;
    const Vec2 bag[] = {{radius + kRim, -0.003f},  {radius, -0.003f},         {radius, -0.003f},
                        {radius - 0.008f, -0.12f}, {radius - 0.008f, -0.12f}, {0, -0.13f}};
    add(mesh, lathe(bag, kSides), palette.leather, placement);

    const Vec2 section[] = {{radius, -0.003f},
                            {radius, kRailTop - 0.004f},
                            {radius + 0.012f, kRailTop + 0.003f},
                            {radius + kRim - 0.006f, kRailTop + 0.003f},
                            {radius + kRim, kRailTop - 0.006f},
                            {radius + kRim, -0.075f}};
    const float first = glm::radians(0.5f * gap), last = 2 * kPi - first;
    for (int j = 0; j + 1 < 6; ++j) {
        const auto point = [&](float u, float v) {
            const float angle = kPi + glm::mix(first, last, u);
            const Vec2 p = glm::mix(section[j], section[j + 1], v);
            return Vec3(p.x * std::cos(angle), p.y, p.x * std::sin(angle));
        };
        add(mesh, sheet(kSides, 1, point), j == 0 ? palette.leather : palette.casting, placement);
    }
}

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
    constexpr float kInset = 0.03f;
    const Vec2 half = kHalfField + Vec2(kOutside - kInset);
    const Mat4 lying = moved({-half.x, kClothHeight, half.y}) * turned({1, 0, 0}, -90);
    const Vec2 profile[] = {{0.2f, -0.26f},     {0.002f, -0.26f},  {-0.006f, -0.25f},
                            {-0.006f, -0.235f}, {0.006f, -0.225f}, {0, -0.09f},
                            {-0.012f, -0.08f},  {-0.012f, -0.06f}, {0.12f, -0.06f}};
    add(mesh, moulding(2.0f * half, profile), palette.rail, lying);
}

void add_bed(Mesh& mesh, const HallPalette& palette) {
    constexpr float kCut = 0.05f;  // at the corner pockets
    const float x = kHalfField.x, z = kHalfField.y, y = kClothHeight;
    const auto flat = [&](Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
        add(mesh, quad({a.x, y, a.y}, {b.x, y, b.y}, {c.x, y, c.y}, {d.x, y, d.y}), palette.cloth);
    };
    flat({-x, z - kCut}, {x, z - kCut}, {x, kCut - z}, {-x, kCut - z});
    flat({kCut - x, z}, {x - kCut, z}, {x, z - kCut}, {-x, z - kCut});
    flat({-x, kCut - z}, {x, kCut - z}, {x - kCut, -z}, {kCut - x, -z});
}

}  // namespace

Mesh pool_table(const HallPalette& palette) {
    constexpr float kCornerMouth = 0.08f;  // from the corner of the field to a nose's end
    constexpr float kSideMouth = 0.066f;   // from the middle of the side pocket
    constexpr float kJaw = 0.022f;
    Mesh mesh;
    add_bed(mesh, palette);
    for (const float turn : {0.0f, 180.0f}) {
        const Mat4 half = moved({0, kClothHeight, 0}) * turned({0, 1, 0}, turn);
        const float end = kHalfField.y - kCornerMouth;
        const Mat4 long_side = half * moved({kHalfField.x, 0, 0});
        add_side(mesh, palette, {-end, -kSideMouth, kJaw, 0.008f, long_side});
        add_side(mesh, palette, {kSideMouth, end, 0.008f, kJaw, long_side});
        const float across = kHalfField.x - kCornerMouth;
        add_side(mesh, palette,
                 {-across, across, kJaw, kJaw,
                  half * turned({0, 1, 0}, -90) * moved({kHalfField.y, 0, 0})});

        add_pocket(mesh, palette, 0.062f, 140, half * moved({kHalfField.x + 0.057f, 0, 0}));
        for (const float side : {-1.0f, 1.0f}) {
            const Vec2 corner = kHalfField + Vec2(0.02f);
            add_pocket(
                mesh, palette, 0.062f, 130,
                half * moved({corner.x, 0, side * corner.y}) * turned({0, 1, 0}, -45 * side));
        }
    }
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

}  // namespace chiaro
