#include "scene/hall_furniture.h"

#include "scene/shapes.h"

#include <cmath>

namespace chiaro {
namespace {

// Raised beads round `count` panels side by side, on a board in z = 0.
void add_panels(Mesh& mesh, Vec2 low, Vec2 high, int count, MaterialId material,
                const Mat4& placement) {
    constexpr float kStile = 0.1f;
    const Vec2 bead[] = {{0, 0}, {0.01f, 0.016f}, {0.03f, 0.014f}, {0.042f, 0}};
    const float pitch = (high.x - low.x) / static_cast<float>(count);
    const Vec2 size(pitch - kStile, high.y - low.y);
    for (int i = 0; i < count; ++i)
        add(mesh, moulding(size, bead), material,
            placement * moved({low.x + pitch * static_cast<float>(i) + 0.5f * kStile, low.y, 0}));
}

}  // namespace

Mesh pendant(const HallPalette& palette, float drop) {
    constexpr int kSides = 14;
    // The rim hides the bulb from above 17 degrees below the horizon, so that walls are in the
    // dark; through the open top some light goes to the ceiling.
    const Vec2 outside[] = {
        {0.23f, -0.07f}, {0.205f, 0}, {0.155f, 0.065f}, {0.1f, 0.108f}, {0.055f, 0.128f}};
    const Vec2 inside[] = {
        {0.055f, 0.128f}, {0.096f, 0.104f}, {0.15f, 0.062f}, {0.2f, -0.002f}, {0.23f, -0.07f}};
    const Vec2 neck[] = {{0.024f, 0.09f}, {0.024f, 0.15f}, {0.012f, 0.18f}, {0.004f, 0.24f}};
    const Vec2 rose[] = {{0.006f, drop - 0.04f}, {0.05f, drop - 0.02f}, {0.055f, drop}};
    Mesh mesh;
    add(mesh, lathe(outside, kSides), palette.enamel);
    add(mesh, lathe(inside, kSides), palette.enamel_inside);
    add(mesh, lathe(neck, 8), palette.metal);
    for (const float turn : {0.0f, 120.0f, 240.0f})
        add(mesh, bar({0.02f, 0.14f, 0}, {0.07f, 0.118f, 0}, {0, 0, 1}, Vec2(0.005f)),
            palette.metal, turned({0, 1, 0}, turn));
    add(mesh, lathe(rose, 8), palette.metal);
    add(mesh, bar({0, 0.23f, 0}, {0, drop - 0.03f, 0}, {1, 0, 0}, Vec2(0.007f)), palette.leather);
    return mesh;
}

Mesh bar_stool(const HallPalette& palette) {
    const Vec2 seat[] = {{0.16f, 0.70f},  {0.185f, 0.715f}, {0.19f, 0.745f},
                         {0.175f, 0.77f}, {0.1f, 0.78f},    {0, 0.78f}};
    const Vec2 under[] = {{0, 0.70f}, {0.16f, 0.70f}};
    const Vec2 band[] = {{0.163f, 0.69f}, {0.171f, 0.69f}, {0.171f, 0.69f}, {0.171f, 0.715f}};
    Mesh mesh;
    add(mesh, lathe(seat, 18), palette.seat);
    add(mesh, lathe(under, 18), palette.seat);
    add(mesh, lathe(band, 18), palette.metal);
    const Vec2 leg[] = {{0.014f, 0}, {0.018f, 0.3f}, {0.014f, 0.69f}};
    for (int i = 0; i < 4; ++i)
        add(mesh, lathe(leg, 8), palette.rail,
            turned({0, 1, 0}, 45 + 90 * static_cast<float>(i)) * moved({0.19f, 0.0013f, 0}) *
                turned({0, 0, 1}, 5));

    // A foot ring round the legs.
    constexpr int kSegments = 20;
    constexpr float kPipe = 0.009f, kRing = 0.17f, kHeight = 0.26f;
    std::vector<std::vector<Vec3>> rings;
    for (int i = 0; i < kSegments; ++i) {
        const float angle = -2 * kPi * static_cast<float>(i) / kSegments;
        const Vec3 out(std::cos(angle), 0, std::sin(angle));
        std::vector<Vec3> ring;
        for (const Vec2 p : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)})
            ring.push_back((kRing - kPipe * p.x) * out + Vec3(0, kHeight + kPipe * p.y, 0));
        rings.push_back(ring);
    }
    add(mesh, loft(rings, true), palette.metal);
    return mesh;
}

Mesh bar_counter(const HallPalette& palette, float length) {
    constexpr float kDepth = 0.6f, kTopThickness = 0.05f;
    const float half = 0.5f * length;
    const float under = kBarHeight - kTopThickness;
    Mesh mesh;
    add(mesh, box({-half, under, -0.5f * kDepth}, {half, kBarHeight, 0.5f * kDepth}), palette.rail);
    add(mesh, box({-half + 0.04f, 0, -0.22f}, {half - 0.04f, under, 0.2f}, kBottom | kTop),
        palette.panel);
    add(mesh, box({-half + 0.02f, 0, 0.19f}, {half - 0.02f, 0.12f, 0.225f}, kBottom | kBack),
        palette.panel);
    add_panels(mesh, {-half + 0.08f, 0.2f}, {half - 0.08f, 0.98f}, 6, palette.panel,
               moved({0, 0, 0.2f}));

    const Vec2 pipe[] = {{0, -half}, {0.02f, -half + 0.01f}, {0.02f, half - 0.01f}, {0, half}};
    add(mesh, lathe(pipe, 10), palette.metal, moved({0, 0.2f, 0.33f}) * turned({0, 0, 1}, -90));
    for (int i = 0; i < 4; ++i) {
        const float x = (half - 0.2f) * (2 * static_cast<float>(i) / 3 - 1);
        add(mesh, bar({x, 0.2f, 0.2f}, {x, 0.2f, 0.32f}, {1, 0, 0}, Vec2(0.016f)), palette.metal);
    }
    return mesh;
}

float back_bar_shelf(int shelf) {
    return 1.1f + 0.42f * static_cast<float>(shelf);
}

Mesh back_bar(const HallPalette& palette, float length) {
    constexpr float kDepth = 0.26f, kBoard = 0.03f, kHeight = 2.4f;
    const float half = 0.5f * length;
    Mesh mesh;
    add(mesh, box({-half, 0, 0}, {half, back_bar_shelf(0), 0.45f}, kBack | kBottom), palette.panel);
    add_panels(mesh, {-half + 0.05f, 0.12f}, {half - 0.05f, 0.95f}, 5, palette.panel,
               moved({0, 0, 0.45f}));
    for (int shelf = 1; shelf < kBackBarShelves; ++shelf) {
        const float y = back_bar_shelf(shelf);
        add(mesh,
            box({-half + 0.05f, y - kBoard, 0}, {half - 0.05f, y, kDepth}, kBack | kLeft | kRight),
            palette.rail);
    }
    for (const float x : {-half, half - 0.05f})
        add(mesh,
            box({x, back_bar_shelf(0), 0}, {x + 0.05f, kHeight, kDepth + 0.02f},
                kBack | kBottom | kTop),
            palette.rail);
    add(mesh,
        box({-half - 0.04f, kHeight, 0}, {half + 0.04f, kHeight + 0.1f, kDepth + 0.06f}, kBack),
        palette.rail);
    return mesh;
}

Mesh bottle(MaterialId glass, MaterialId label, float height) {
    constexpr int kSides = 8;
    const float h = height, r = 0.037f;
    const Vec2 body[] = {{r - 0.004f, 0},       {r, 0.006f},         {r, 0.58f * h},
                         {0.7f * r, 0.68f * h}, {0.014f, 0.76f * h}, {0.013f, 0.95f * h}};
    const Vec2 cap[] = {{0.016f, 0.94f * h}, {0.016f, 0.995f * h}, {0, h}};
    const Vec2 paper[] = {{r + 0.0006f, 0.16f * h}, {r + 0.0006f, 0.46f * h}};
    Mesh mesh;
    add(mesh, lathe(body, kSides), glass);
    add(mesh, lathe(cap, kSides), label);
    add(mesh, lathe(paper, kSides), label);
    return mesh;
}

Mesh wainscot(const HallPalette& palette, float width) {
    constexpr float kBoard = 0.02f;
    Mesh mesh;
    add(mesh, quad({0, 0, kBoard}, {width, 0, kBoard}, {width, kDado, kBoard}, {0, kDado, kBoard}),
        palette.panel);
    add(mesh, box({0, 0, kBoard}, {width, 0.13f, 0.035f}, kBack | kBottom | kLeft | kRight),
        palette.panel);
    add(mesh, box({0, kDado, 0}, {width, kDado + 0.04f, 0.055f}, kBack | kLeft | kRight),
        palette.panel);
    add_panels(mesh, {0.08f, 0.22f}, {width - 0.08f, 0.95f},
               static_cast<int>(std::lround(width / 0.85f)), palette.panel, moved({0, 0, kBoard}));
    return mesh;
}

Mesh cue_rack(const HallPalette& palette, int count) {
    const float half = 0.5f * kCuePitch * static_cast<float>(count) + 0.04f;
    Mesh mesh;
    add(mesh, box({-half, 0, 0}, {half, 1.5f, 0.022f}, kBack), palette.rail);
    add(mesh, box({-half, kCueFoot - 0.04f, 0.022f}, {half, kCueFoot, 0.12f}, kBack), palette.rail);
    // A clip on each side of each cue.
    for (int i = 0; i < count; ++i) {
        const float x = kCuePitch * (static_cast<float>(i) - 0.5f * static_cast<float>(count - 1));
        for (const float side : {-0.02f, 0.013f})
            add(mesh, box({x + side, 1.2f, 0.022f}, {x + side + 0.007f, 1.23f, 0.09f}, kBack),
                palette.metal);
    }
    return mesh;
}

}  // namespace chiaro
