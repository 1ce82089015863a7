#include "base/random.h"
#include "scene/curved_shapes.h"
#include "scene/furniture.h"
#include "scene/shapes.h"

#include <cmath>

namespace chiaro {
namespace {

// A closed book on its lower edge, spine towards +z, its left side in x = 0. Without a lower side
// if it stands upright on something.
void add_book(Mesh& mesh, Vec3 size, bool upright, MaterialId cloth, MaterialId pages,
              const Mat4& placement) {
    const Vec3 low(0, 0, -size.z);
    const Vec3 high(size.x, size.y, 0);
    const unsigned page_sides = upright ? kTop : kTop | kBottom;
    add(mesh, box(low, high, kTop | kBottom), cloth, placement);
    add(mesh, box(low, high, kAllFaces & ~page_sides), pages, placement);
}

// An arching blade from the origin towards +z, folded along its middle.
Mesh leaf(float length, float width, float rise, float droop) {
    return sheet(2, 8, [=](float u, float v) {
        const float across = 2 * u - 1;
        const float half = 0.5f * width * std::sin(kPi * (0.08f + 0.9f * v)) + 0.002f;
        const float height = rise * v - droop * v * v + 0.25f * half * std::abs(across);
        return Vec3(-half * across, height, length * v);
    });
}

}  // namespace

Mesh book_row(const Palette& palette, int count, std::uint32_t seed) {
    Mesh mesh;
    Rng rng(seed);
    const auto between = [&](float low, float high) { return low + (high - low) * rng.uniform(); };
    float x = 0.004f;
    Vec3 size(0);
    for (int i = 0; i < count; ++i) {
        // Neighbours are often of one series: same height and colour.
        const bool new_series = i == 0 || rng.uniform() < 0.7f;
        if (new_series) size = {0, between(0.19f, 0.31f), between(0.15f, 0.22f)};
        size.x = between(0.02f, 0.058f);
        const MaterialId cloth = palette.books[rng.below(10)];
        add_book(mesh, size, true, cloth, palette.pages, moved({x, 0, between(-0.012f, 0)}));
        x += size.x + between(0.0008f, 0.003f);
    }
    // The last one leans on the others: its lower left edge is off the shelf by the lean.
    const Vec3 last(0.026f, 0.23f, 0.17f);
    add_book(
        mesh, last, false, palette.books[rng.below(10)], palette.pages,
        moved({x + last.y * std::sin(glm::radians(14.0f)), 0.0005f, 0}) * turned({0, 0, 1}, 14));
    return mesh;
}

Mesh book_stack(const Palette& palette) {
    Mesh mesh;
    const Vec3 sizes[] = {{0.03f, 0.24f, 0.31f}, {0.022f, 0.21f, 0.28f}, {0.028f, 0.17f, 0.23f}};
    const int cloths[] = {4, 1, 6};
    const float turns[] = {4, -8, 15};
    float height = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3 s = sizes[i];
        const Mat4 placement = moved({0, height, 0}) * turned({0, 1, 0}, turns[i]);
        const Vec3 low(-0.5f * s.z, 0, -0.5f * s.y);
        const Vec3 high(0.5f * s.z, s.x, 0.5f * s.y);
        add(mesh, box(low, high, kBottom | kRight | kBack), palette.books[cloths[i]], placement);
        add(mesh, box(low, high, kAllFaces & ~(kRight | kBack)), palette.pages, placement);
        height += s.x;
    }
    return mesh;
}

Mesh rug(const Palette& palette) {
    constexpr Vec2 kSize(2.6f, 1.8f);
    constexpr float kThickness = 0.012f;
    constexpr float kBorder = 0.09f;
    // Lying down: the moulding's z axis is up, its y axis towards -z.
    const Mat4 lying = moved({-0.5f * kSize.x, 0, 0.5f * kSize.y}) * turned({1, 0, 0}, -90);
    const Vec2 profile[] = {{0, 0}, {0, kThickness}, {kBorder, kThickness}};
    Mesh mesh;
    add(mesh, moulding(kSize, profile), palette.rug_border, lying);
    const Vec2 h = 0.5f * kSize - Vec2(kBorder);
    add(mesh,
        quad({-h.x, kThickness, h.y}, {h.x, kThickness, h.y}, {h.x, kThickness, -h.y},
             {-h.x, kThickness, -h.y}),
        palette.rug);

    // A fringe on the short sides, its tassels a little unlike each other.
    constexpr int kTassels = 60;
    Rng rng(31);
    for (const float side : {-1.0f, 1.0f})
        for (int i = 0; i < kTassels; ++i) {
            const float z = kSize.y * ((static_cast<float>(i) + 0.5f) / kTassels - 0.5f);
            const float sway = 0.012f * (rng.uniform() - 0.5f);
            const Mesh tassel = sheet(1, 2, [&](float u, float v) {
                return Vec3(0.5f * kSize.x - 0.002f + 0.05f * v,
                            0.5f * kThickness * (1 - v) + 0.002f,
                            0.01f * (0.5f - u) * (1 + 0.5f * v) + sway * v);
            });
            add(mesh, tassel, palette.rug_border,
                moved({0, 0, z}) * turned({0, 1, 0}, side > 0 ? 0 : 180));
        }
    return mesh;
}

Mesh floor_lamp(const Palette& palette) {
    const Vec2 stand[] = {{0.14f, 0},      {0.14f, 0.018f}, {0.14f, 0.018f}, {0.012f, 0.03f},
                          {0.012f, 0.03f}, {0.012f, 1.44f}, {0.012f, 1.44f}, {0, 1.44f}};
    const Vec2 shade[] = {{0.24f, 1.33f},  {0.16f, 1.65f},  {0.16f, 1.65f},  {0.157f, 1.65f},
                          {0.157f, 1.65f}, {0.237f, 1.33f}, {0.237f, 1.33f}, {0.24f, 1.33f}};
    Mesh mesh;
    add(mesh, revolve(smooth_profile(stand)), palette.brass);
    add(mesh, revolve(smooth_profile(shade)), palette.shade);
    add(mesh, curved_sphere(0.035f), palette.ceramic, moved({0, 1.4755f, 0}));
    // Three thin spokes hold the shade.
    for (const float turn : {0.0f, 120.0f, 240.0f})
        add(mesh, bar({0.011f, 1.43f, 0}, {0.213f, 1.43f, 0}, {0, 0, 1}, {0.004f, 0.004f}),
            palette.brass, turned({0, 1, 0}, turn));
    return mesh;
}

Mesh plant(const Palette& palette) {
    const Vec2 pot[] = {{0.12f, 0},     {0.155f, 0.27f}, {0.155f, 0.27f}, {0.17f, 0.27f},
                        {0.17f, 0.27f}, {0.17f, 0.31f},  {0.17f, 0.31f},  {0.15f, 0.31f},
                        {0.15f, 0.31f}, {0.147f, 0.26f}};
    const Vec2 soil[] = {{0.1485f, 0.285f}, {0, 0.295f}};
    Mesh mesh;
    add(mesh, lathe(pot, 14), palette.terracotta);
    add(mesh, lathe(soil, 14), palette.soil);

    // Leaves in the golden angle round the stem, the inner ones steeper.
    constexpr int kLeaves = 15;
    for (int i = 0; i < kLeaves; ++i) {
        const float t = static_cast<float>(i) / (kLeaves - 1);  // 0 outside, 1 inside
        const float length = glm::mix(0.46f, 0.2f, t);
        const Mesh blade = leaf(length, 0.11f, glm::mix(0.55f, 1.0f, t), glm::mix(0.42f, 0.12f, t));
        const auto turn = 137.5f * static_cast<float>(i);
        add(mesh, blade, palette.leaf,
            turned({0, 1, 0}, turn) * moved({0, 0.292f, glm::mix(0.05f, 0.015f, t)}));
    }
    return mesh;
}

Mesh picture(const Palette& palette, int which) {
    constexpr Vec2 kSize(0.56f, 0.72f);
    constexpr float kFrame = 0.022f;
    constexpr float kMat = 0.075f;
    constexpr float kDepth = 0.028f;
    constexpr float kFace = 0.012f;  // of passe-partout and picture, in front of the wall
    const Mat4 centred = moved({-0.5f * kSize.x, -0.5f * kSize.y, 0});
    const Vec2 frame[] = {{0, 0}, {0, kDepth}, {kFrame, kDepth}, {kFrame, kFace}};
    const Vec2 mat[] = {{kFrame, kFace}, {kFrame + kMat, kFace}};
    Mesh mesh;
    add(mesh, moulding(kSize, frame), which == 1 ? palette.walnut : palette.metal, centred);
    add(mesh, moulding(kSize, mat), palette.passe_partout, centred);

    const Vec2 h = 0.5f * kSize - Vec2(kFrame + kMat);
    Mesh image =
        quad({-h.x, -h.y, kFace}, {h.x, -h.y, kFace}, {h.x, h.y, kFace}, {-h.x, h.y, kFace});
    image.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    add(mesh, image, palette.pictures[which]);
    return mesh;
}

Mesh vase(const Palette& palette) {
    const Vec2 profile[] = {{0.045f, 0},     {0.085f, 0.07f}, {0.09f, 0.13f},  {0.06f, 0.2f},
                            {0.032f, 0.24f}, {0.045f, 0.28f}, {0.045f, 0.28f}, {0.04f, 0.28f},
                            {0.04f, 0.28f},  {0.027f, 0.24f}, {0, 0.2f}};
    Mesh mesh;
    add(mesh, revolve(smooth_profile(profile)), palette.glaze);
    return mesh;
}

Mesh fruit_bowl(const Palette& palette) {
    const Vec2 profile[] = {{0.06f, 0},      {0.065f, 0.015f}, {0.12f, 0.045f},  {0.15f, 0.085f},
                            {0.15f, 0.085f}, {0.144f, 0.085f}, {0.144f, 0.085f}, {0.115f, 0.051f},
                            {0.06f, 0.024f}, {0, 0.02f}};
    Mesh mesh;
    add(mesh, revolve(smooth_profile(profile)), palette.ceramic);
    const Mesh orange = curved_sphere(0.042f);
    add(mesh, orange, palette.fruit, moved({-0.047f, 0.073f, 0.012f}));
    add(mesh, orange, palette.fruit, moved({0.045f, 0.074f, 0.028f}));
    add(mesh, orange, palette.fruit, moved({0.004f, 0.075f, -0.058f}));
    return mesh;
}

}  // namespace chiaro
