#include "scene/room_shell.h"

#include "scene/shapes.h"

#include <cmath>

namespace chiaro {
namespace {

// From the plane in which a moulding is made (z up from it) to the floor.
Mat4 lying_on_floor() {
    return moved({0, 0, kRoomDepth}) * turned({1, 0, 0}, -90);
}

// A rectangle of the x-y plane at height z, facing +z.
Mesh panel(Vec2 low, Vec2 high, float z) {
    return quad({low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z});
}

}  // namespace

Mat4 back_wall_frame() {
    return Mat4(1);
}
Mat4 right_wall_frame() {
    return moved({kRoomWidth, 0, 0}) * turned({0, 1, 0}, -90);
}
Mat4 front_wall_frame() {
    return moved({kRoomWidth, 0, kRoomDepth}) * turned({0, 1, 0}, 180);
}
Mat4 left_wall_frame() {
    return moved({0, 0, kRoomDepth}) * turned({0, 1, 0}, 90);
}

Mesh floor_mesh(const Palette& palette) {
    Mesh mesh;
    add(mesh, quad({0, 0, kRoomDepth}, {kRoomWidth, 0, kRoomDepth}, {kRoomWidth, 0, 0}, {0, 0, 0}),
        palette.floor);
    return mesh;
}

Mesh ceiling_mesh(const Palette& palette) {
    Mesh mesh;
    constexpr float y = kRoomHeight;
    add(mesh, quad({0, y, 0}, {kRoomWidth, y, 0}, {kRoomWidth, y, kRoomDepth}, {0, y, kRoomDepth}),
        palette.ceiling);
    return mesh;
}

Mesh plain_wall(MaterialId material, float width) {
    Mesh mesh;
    add(mesh, panel({0, 0}, {width, kRoomHeight}, 0), material);
    return mesh;
}

Mesh window_wall(MaterialId material, float width, Vec2 window_low, Vec2 window_high) {
    const float xs[] = {0, window_low.x, window_high.x, width};
    const float ys[] = {0, window_low.y, window_high.y, kRoomHeight};
    Mesh mesh;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            if (i != 1 || j != 1)
                add(mesh, panel({xs[i], ys[j]}, {xs[i + 1], ys[j + 1]}, 0), material);
    return mesh;
}

Mesh window_mesh(const Palette& palette, Vec2 size) {
    constexpr float kRecess = 0.16f;
    constexpr float kFrame = 0.06f;
    constexpr float kFrameDepth = 0.05f;
    constexpr float kBar = 0.02f;  // half the width of a glazing bar
    const Mat4 recessed = moved({0, 0, -kRecess});
    Mesh mesh;

    // The opening's sides, down to the frame, then the frame and the pane.
    const Vec2 reveal[] = {{0, kRecess}, {0, kFrameDepth}};
    const Vec2 frame[] = {{0, kFrameDepth}, {kFrame, kFrameDepth}, {kFrame, 0.01f}};
    add(mesh, moulding(size, reveal), palette.wall, recessed);
    add(mesh, moulding(size, frame), palette.woodwork, recessed);
    add(mesh, panel(Vec2(kFrame), size - Vec2(kFrame), 0.01f), palette.glass, recessed);

    // A mullion, and a transom in two halves; their ends and backs touch what holds them.
    const float middle = 0.5f * size.x;
    const float transom = 0.68f * size.y;
    const unsigned upright = kTop | kBottom | kBack;
    const unsigned level = kLeft | kRight | kBack;
    const auto add_bar = [&](Vec2 low, Vec2 high, unsigned left_out) {
        add(mesh, box(Vec3(low, 0.01f), Vec3(high, 0.04f), left_out), palette.woodwork, recessed);
    };
    add_bar({middle - kBar, kFrame}, {middle + kBar, size.y - kFrame}, upright);
    add_bar({kFrame, transom - kBar}, {middle - kBar, transom + kBar}, level);
    add_bar({middle + kBar, transom - kBar}, {size.x - kFrame, transom + kBar}, level);

    // The sill's nose, level with the opening's lower side.
    add(mesh, box({-0.05f, -0.03f, 0}, {size.x + 0.05f, 0, 0.05f}, kBack), palette.woodwork);
    return mesh;
}

Mesh curtain_mesh(const Palette& palette) {
    constexpr float kWidth = 0.5f;
    constexpr float kFolds = 5.5f;
    // Folds are tight and even at the rail, wider and a little uneven at the hem.
    const auto point = [&](float u, float v) {
        const float phase = 2 * kPi * kFolds * u + 0.5f * (1 - v) * std::sin(9 * u);
        const float depth = glm::mix(0.045f, 0.028f, v);
        return Vec3(kWidth * u, glm::mix(0.015f, kCurtainRail - 0.03f, v), depth * std::sin(phase));
    };
    Mesh mesh;
    add(mesh, sheet(66, 2, point), palette.curtain);
    return mesh;
}

Mesh curtain_rod_mesh(const Palette& palette, float length) {
    const float half = 0.5f * length;
    const Vec2 profile[] = {{0, -half - 0.06f}, {0.024f, -half - 0.04f}, {0.024f, -half - 0.02f},
                            {0.011f, -half},    {0.011f, -half},         {0.011f, half},
                            {0.011f, half},     {0.024f, half + 0.02f},  {0.024f, half + 0.04f},
                            {0, half + 0.06f}};
    Mesh mesh;
    add(mesh, lathe(profile, 8), palette.brass, turned({0, 0, 1}, -90));
    for (const float x : {0.04f - half, half - 0.04f})
        add(mesh,
            box({x - 0.008f, -0.008f, -kCurtainDistance}, {x + 0.008f, 0.008f, -0.009f}, kBack),
            palette.brass);
    return mesh;
}

Mesh door_mesh(const Palette& palette) {
    constexpr float kHeight = 2.03f;
    constexpr float kLeaf = 0.025f;  // the leaf's front, from the wall
    constexpr float kCase = 0.045f;  // the casing's
    constexpr float kCaseWidth = 0.07f;
    Mesh mesh;
    add(mesh, panel({0, 0}, {kDoorWidth, kHeight}, kLeaf), palette.woodwork);
    add(mesh, box({-kCaseWidth, 0, 0}, {0, kHeight, kCase}, kBack | kBottom | kTop),
        palette.woodwork);
    add(mesh,
        box({kDoorWidth, 0, 0}, {kDoorWidth + kCaseWidth, kHeight, kCase}, kBack | kBottom | kTop),
        palette.woodwork);
    add(mesh,
        box({-kCaseWidth, kHeight, 0}, {kDoorWidth + kCaseWidth, kHeight + kCaseWidth, kCase},
            kBack),
        palette.woodwork);

    // Two panels with raised edges.
    const Vec2 bead[] = {{0, 0}, {0.008f, 0.012f}, {0.028f, 0.012f}, {0.036f, 0}};
    const float width = kDoorWidth - 0.26f;
    add(mesh, moulding({width, 0.62f}, bead), palette.woodwork, moved({0.13f, 0.18f, kLeaf}));
    add(mesh, moulding({width, 0.96f}, bead), palette.woodwork, moved({0.13f, 0.93f, kLeaf}));

    const Vec2 rose[] = {{0.026f, 0},     {0.026f, 0.008f}, {0.026f, 0.008f},
                         {0.009f, 0.01f}, {0.009f, 0.01f},  {0.009f, 0.05f}};
    const Mat4 at_lock = moved({0.065f, 1.02f, kLeaf});
    add(mesh, lathe(rose, 10), palette.brass, at_lock * turned({1, 0, 0}, 90));
    add(mesh, box({-0.012f, -0.009f, 0.05f}, {0.11f, 0.009f, 0.064f}), palette.brass, at_lock);
    return mesh;
}

Mesh radiator_mesh(const Palette& palette) {
    constexpr int kSections = 12;
    constexpr int kSides = 7;
    constexpr float kPitch = 0.075f;
    const float half = 0.5f * kPitch * (kSections - 1);
    const Vec2 column[] = {{0.016f, 0.105f}, {0.026f, 0.115f}, {0.026f, 0.16f},  {0.017f, 0.19f},
                           {0.017f, 0.61f},  {0.026f, 0.64f},  {0.026f, 0.685f}, {0, 0.7f}};
    // Their ends stand out, as taps do: light is known at corners that are seen.
    const float end = half + 0.05f;
    const Vec2 hub[] = {{0, -end},     {0.016f, -end}, {0.016f, -end},
                        {0.016f, end}, {0.016f, end},  {0, end}};
    const Mesh tube = lathe(column, kSides);
    const Mesh pipe = lathe(hub, kSides);
    Mesh mesh;
    for (const float z : {0.065f, 0.125f}) {
        for (int i = 0; i < kSections; ++i)
            add(mesh, tube, palette.woodwork, moved({kPitch * static_cast<float>(i) - half, 0, z}));
        for (const float y : {0.14f, 0.66f})
            add(mesh, pipe, palette.woodwork, moved({0, y, z}) * turned({0, 0, 1}, -90));
    }
    return mesh;
}

Mesh skirting_mesh(const Palette& palette) {
    const Vec2 profile[] = {{0, 0.09f}, {0.008f, 0.09f}, {0.014f, 0.078f}, {0.014f, 0}};
    Mesh mesh;
    add(mesh, moulding({kRoomWidth, kRoomDepth}, profile), palette.woodwork, lying_on_floor());
    return mesh;
}

Mesh cornice_mesh(const Palette& palette) {
    constexpr float y = kRoomHeight;
    const Vec2 profile[] = {{0.09f, y},           {0.09f, y - 0.012f}, {0.045f, y - 0.03f},
                            {0.018f, y - 0.065f}, {0.012f, y - 0.1f},  {0, y - 0.1f}};
    Mesh mesh;
    add(mesh, moulding({kRoomWidth, kRoomDepth}, profile), palette.ceiling, lying_on_floor());
    return mesh;
}

Mesh lamp_mesh(const Palette& palette) {
    constexpr Vec2 kSize(1.25f, 0.65f);
    constexpr float kRim = 0.025f;
    const Vec2 rim[] = {{0, 0}, {0, 0.05f}, {kRim, 0.05f}, {kRim, 0.042f}};
    const Mat4 hanging = turned({1, 0, 0}, 90) * moved({-0.5f * kSize.x, -0.5f * kSize.y, 0});
    Mesh mesh;
    add(mesh, moulding(kSize, rim), palette.woodwork, hanging);
    add(mesh, panel(Vec2(kRim), kSize - Vec2(kRim), 0.042f), palette.lamp, hanging);
    return mesh;
}

}  // namespace chiaro
