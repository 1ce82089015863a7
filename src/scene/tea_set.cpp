#include "scene/tea_set.h"

#include "scene/bicubic_mesh.h"
#include "scene/curved_shapes.h"
#include "scene/shapes.h"

#include <array>
#include <span>

namespace chiaro {
namespace {

// Half of a section through the teapot's handle or spout, which Newell gave as a cubic curve from
// one end of it in the plane of symmetry to the other, `width` out of that plane between.
struct Rib {
    Vec2 first, last;  // (x, height)
    float width;
};

constexpr Rib kHandle[] = {
    {{-1.5f, 2.25f}, {-1.6f, 2.025f}, 0.3f}, {{-2.5f, 2.25f}, {-2.3f, 2.025f}, 0.3f},
    {{-3, 2.25f}, {-2.7f, 2.025f}, 0.3f},    {{-3, 1.8f}, {-2.7f, 1.8f}, 0.3f},
    {{-3, 1.35f}, {-2.7f, 1.575f}, 0.3f},    {{-2.65f, 0.9375f}, {-2.5f, 1.125f}, 0.3f},
    {{-1.9f, 0.6f}, {-2, 0.9f}, 0.3f}};
constexpr Rib kSpout[] = {
    {{1.7f, 0.6f}, {1.7f, 1.425f}, 0.66f},       {{3.1f, 0.825f}, {2.6f, 1.425f}, 0.66f},
    {{2.4f, 2.025f}, {2.3f, 2.1f}, 0.25f},       {{3.3f, 2.4f}, {2.7f, 2.4f}, 0.25f},
    {{3.525f, 2.49375f}, {2.8f, 2.475f}, 0.25f}, {{3.45f, 2.5125f}, {2.9f, 2.475f}, 0.15f},
    {{3.2f, 2.4f}, {2.8f, 2.4f}, 0.15f}};

// Both halves, a patch for every three ribs onward.
void add_ribbed(Mesh& mesh, std::span<const Rib> ribs, MaterialId material, const Mat4& placement) {
    for (const float side : {1.0f, -1.0f}) {
        for (std::size_t first = 0; first + 3 < ribs.size(); first += 3) {
            BicubicPatch patch;
            for (int j = 0; j < 4; ++j) {
                const Rib& rib = ribs[first + static_cast<std::size_t>(j)];
                const float out = -side * rib.width;
                patch.at(0, j) = Vec4(rib.first, 0, 1);
                patch.at(1, j) = Vec4(rib.first, out, 1);
                patch.at(2, j) = Vec4(rib.last, out, 1);
                patch.at(3, j) = Vec4(rib.last, 0, 1);
            }
            patch = transformed(patch, placement);
            add_bicubic(mesh, side > 0 ? patch : flipped(patch), material);
        }
    }
}

// Where a bent rod of elliptic section passes, in the plane z = 0.
struct Bend {
    Vec2 place;
    Vec2 reach;  // from the place to the next control point of its curve
    Vec2 radii;  // in the plane, and across it
};

void add_rod(Mesh& mesh, std::span<const Bend> bends, MaterialId material) {
    const auto section = [](const Bend& bend, Vec2 centre, const Vec4& circle) {
        const Vec2 along = glm::normalize(bend.reach);
        const Vec2 in_plane = bend.radii.x * circle.x * Vec2(-along.y, along.x);
        return Vec4(circle.w * centre + in_plane, bend.radii.y * circle.y, circle.w);
    };
    for (std::size_t k = 0; k + 1 < bends.size(); ++k) {
        const Bend &a = bends[k], &b = bends[k + 1];
        for (int quarter = 0; quarter < 4; ++quarter) {
            const auto turn = 90 * static_cast<float>(quarter);
            const CubicCurve circle = arc_curve(Vec2(0), 1, turn, turn + 90);
            BicubicPatch patch;
            for (int i = 0; i < 4; ++i) {
                patch.at(i, 0) = section(a, a.place, circle[i]);
                patch.at(i, 1) = section(a, a.place + a.reach, circle[i]);
                patch.at(i, 2) = section(b, b.place - b.reach, circle[i]);
                patch.at(i, 3) = section(b, b.place, circle[i]);
            }
            add_bicubic(mesh, patch, material);
        }
    }
}

// A spoon's section: its edges stand at `height`, its upper side sinks by `hollow` between them
// and its lower side by `belly`.
struct SpoonRow {
    float x, height, half_width, hollow, belly;
};

BicubicPatch spoon_patch(std::span<const SpoonRow, 4> rows, float SpoonRow::*sinks) {
    BicubicPatch patch;
    for (int j = 0; j < 4; ++j) {
        const SpoonRow& row = rows[static_cast<std::size_t>(j)];
        // The middle of a cubic curve is 3/4 of the way to its inner control points.
        const float middle = row.height - row.*sinks / 0.75f;
        const float w = row.half_width;
        patch.at(0, j) = Vec4(row.x, row.height, -w, 1);
        patch.at(1, j) = Vec4(row.x, middle, -w / 3, 1);
        patch.at(2, j) = Vec4(row.x, middle, w / 3, 1);
        patch.at(3, j) = Vec4(row.x, row.height, w, 1);
    }
    return patch;
}

}  // namespace

Mesh teapot(MaterialId material) {
    constexpr float kUnit = 0.04f;  // metres to Newell's unit
    // Newell's profile, and between rim and lid the ledge that he left open.
    const CubicCurve profile[] = {
        bezier_curve({0, 0}, {1.425f, 0}, {1.5f, 0.075f}, {1.5f, 0.15f}),
        bezier_curve({1.5f, 0.15f}, {1.5f, 0.225f}, {2, 0.45f}, {2, 0.9f}),
        bezier_curve({2, 0.9f}, {2, 1.35f}, {1.75f, 1.875f}, {1.5f, 2.4f}),
        bezier_curve({1.5f, 2.4f}, {1.4375f, 2.53125f}, {1.3375f, 2.53125f}, {1.4f, 2.4f}),
        line_curve({1.4f, 2.4f}, {1.3f, 2.4f}),
        bezier_curve({1.3f, 2.4f}, {1.3f, 2.55f}, {0.4f, 2.55f}, {0.2f, 2.7f}),
        bezier_curve({0.2f, 2.7f}, {0, 2.85f}, {0.8f, 3.15f}, {0, 3.15f})};
    const auto placement = Mat4(Mat3(kUnit));
    Mesh mesh;
    add(mesh, revolve(profile), material, placement);
    add_ribbed(mesh, kHandle, material, placement);
    add_ribbed(mesh, kSpout, material, placement);
    order_primitives(mesh);
    return mesh;
}

Mesh teacup(MaterialId material) {
    const Vec2 profile[] = {
        {0.022f, 0},      {0.0215f, 0.004f}, {0.0215f, 0.004f},  {0.034f, 0.02f}, {0.041f, 0.045f},
        {0.043f, 0.066f}, {0.043f, 0.066f},  {0.0415f, 0.0672f}, {0.04f, 0.066f}, {0.04f, 0.066f},
        {0.038f, 0.045f}, {0.031f, 0.022f},  {0.018f, 0.009f},   {0, 0.007f}};
    // The handle starts and ends within the wall.
    const Bend handle[] = {{{0.0403f, 0.053f}, {0.009f, 0.003f}, {0.0025f, 0.004f}},
                           {{0.062f, 0.043f}, {0.001f, -0.009f}, {0.0022f, 0.0035f}},
                           {{0.0325f, 0.0205f}, {-0.012f, -0.003f}, {0.0025f, 0.004f}}};
    Mesh mesh;
    add(mesh, revolve(smooth_profile(profile)), material);
    add_rod(mesh, handle, material);
    order_primitives(mesh);
    return mesh;
}

Mesh saucer(MaterialId material) {
    const Vec2 profile[] = {{0.026f, 0},       {0.0255f, 0.003f},  {0.0255f, 0.003f},
                            {0.05f, 0.008f},   {0.072f, 0.017f},   {0.072f, 0.017f},
                            {0.0726f, 0.018f}, {0.0715f, 0.0185f}, {0.0715f, 0.0185f},
                            {0.05f, 0.0105f},  {0.027f, 0.0055f},  {0.027f, 0.0055f},
                            {0, 0.0055f}};
    Mesh mesh;
    add(mesh, revolve(smooth_profile(profile)), material);
    return mesh;
}

Mesh teaspoon(MaterialId material) {
    // Control rows of four patches in a line; the ends are collapsed into points.
    constexpr std::array<SpoonRow, 13> kRows = {{{-0.07f, 0.006f, 0, 0, 0},
                                                 {-0.07f, 0.006f, 0.008f, -0.0003f, 0.0015f},
                                                 {-0.06f, 0.006f, 0.0045f, -0.0005f, 0.0015f},
                                                 {-0.045f, 0.0075f, 0.0035f, -0.0005f, 0.0015f},
                                                 {-0.03f, 0.009f, 0.0025f, -0.0005f, 0.0015f},
                                                 {0, 0.013f, 0.0022f, -0.0007f, 0.002f},
                                                 {0.008f, 0.011f, 0.004f, 0.0005f, 0.0022f},
                                                 {0.016f, 0.009f, 0.0058f, 0.002f, 0.0035f},
                                                 {0.024f, 0.0085f, 0.0165f, 0.007f, 0.008f},
                                                 {0.036f, 0.0085f, 0.0165f, 0.0075f, 0.0085f},
                                                 {0.048f, 0.0085f, 0.0165f, 0.007f, 0.008f},
                                                 {0.062f, 0.0085f, 0.012f, 0.003f, 0.0045f},
                                                 {0.062f, 0.0085f, 0, 0, 0}}};
    Mesh mesh;
    for (std::size_t first = 0; first + 3 < kRows.size(); first += 3) {
        const std::span<const SpoonRow, 4> rows(&kRows[first], 4);
        add_bicubic(mesh, spoon_patch(rows, &SpoonRow::hollow), material);
        add_bicubic(mesh, flipped(spoon_patch(rows, &SpoonRow::belly)), material);
    }
    order_primitives(mesh);
    return mesh;
}

}  // namespace chiaro
