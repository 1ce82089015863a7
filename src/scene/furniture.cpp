#include "scene/furniture.h"

#include "scene/shapes.h"

namespace chiaro {
namespace {

// A board with a chamfered upper edge and an open bottom: seats and table tops.
Mesh padded(Vec3 low, Vec3 high, float chamfer) {
    const auto ring = [&](float y, float inset) {
        const Vec2 a(low.x + inset, low.z + inset);
        const Vec2 b(high.x - inset, high.z - inset);
        // Counter-clockwise seen from above.
        return std::vector<Vec3>{{a.x, y, b.y}, {b.x, y, b.y}, {b.x, y, a.y}, {a.x, y, a.y}};
    };
    const std::vector<Vec3> rings[] = {ring(low.y, 0), ring(high.y - chamfer, 0),
                                       ring(high.y, chamfer)};
    Mesh mesh = loft(rings);
    const std::vector<Vec3>& top = rings[2];
    add(mesh, quad(top[0], top[1], top[2], top[3]), MaterialId{0});
    return mesh;
}

// Four round legs that lean outward, from the floor to `height`, under the corners of a top.
void add_round_legs(Mesh& mesh, MaterialId material, Vec2 half_size, float height, Vec2 radii,
                    int sides) {
    // Points in the middle, as both ends are covered: by the floor and by the top.
    const Vec2 profile[] = {
        {radii.x, 0}, {glm::mix(radii.x, radii.y, 0.6f), 0.5f * height}, {radii.y, height}};
    const Mesh leg = lathe(profile, sides);
    for (const float x : {-half_size.x, half_size.x})
        for (const float z : {-half_size.y, half_size.y})
            add(mesh, leg, material, moved({x, 0, z}));
}

// The curved board between a chair's back posts, bent backward in the middle.
Mesh back_slat(float low, float high) {
    constexpr float kHalfWidth = 0.168f;
    constexpr float kThickness = 0.012f;
    constexpr int kSegments = 3;
    std::vector<std::vector<Vec3>> rings;
    for (int i = 0; i <= kSegments; ++i) {
        const float t = 2 * static_cast<float>(i) / kSegments - 1;
        const auto at = [&](float y, float forward) {
            const float post = -0.185f - 0.148f * (y - 0.44f);
            return Vec3(kHalfWidth * t, y, post - 0.025f * (1 - t * t) + forward);
        };
        rings.push_back({at(low, -0.5f * kThickness), at(high, -0.5f * kThickness),
                         at(high, 0.5f * kThickness), at(low, 0.5f * kThickness)});
    }
    return loft(rings);
}

// From the floor to the top of the back, bent at the seat.
Mesh back_post(float x) {
    const auto ring = [&](float y, float z, float half) {
        return std::vector<Vec3>{{x - half, y, z + half},
                                 {x + half, y, z + half},
                                 {x + half, y, z - half},
                                 {x - half, y, z - half}};
    };
    const std::vector<Vec3> rings[] = {ring(0, -0.215f, 0.014f), ring(0.44f, -0.185f, 0.017f),
                                       ring(0.88f, -0.25f, 0.013f)};
    Mesh mesh = loft(rings);
    add(mesh, quad(rings[2][0], rings[2][1], rings[2][2], rings[2][3]), MaterialId{0});
    return mesh;
}

}  // namespace

Mesh sofa(const Palette& palette) {
    Mesh mesh;
    for (const float x : {-0.95f, 0.95f})
        for (const float z : {-0.34f, 0.34f})
            add(mesh, bar({x, 0, z}, {x, 0.13f, z}, {1, 0, 0}, {0.04f, 0.04f}, 1.4f),
                palette.walnut);

    // The frame reaches a little into the arms, whose round edges would leave a gap beside it.
    add(mesh, box({-0.89f, 0.13f, -0.36f}, {0.89f, 0.28f, 0.40f}, kLeft | kRight), palette.sofa);
    for (const float side : {-1.0f, 1.0f}) {
        const float inner = side * 0.87f;
        const float outer = side * 1.05f;
        add(mesh,
            rounded_box({std::min(inner, outer), 0.125f, -0.43f},
                        {std::max(inner, outer), 0.62f, 0.44f}, 0.06f),
            palette.sofa);
    }
    add(mesh, rounded_box({-0.866f, 0.14f, -0.45f}, {0.866f, 0.82f, -0.24f}, 0.06f), palette.sofa);

    for (const float x : {-0.865f, 0.004f}) {
        add(mesh, rounded_box({x, 0.284f, -0.235f}, {x + 0.861f, 0.45f, 0.435f}, 0.05f),
            palette.sofa);
        add(mesh, rounded_box({x, 0.454f, -0.236f}, {x + 0.861f, 0.87f, -0.04f}, 0.075f),
            palette.sofa);
    }

    // Two loose cushions, leaning in the corners.
    const Mesh loose = rounded_box({-0.21f, -0.21f, -0.07f}, {0.21f, 0.21f, 0.07f}, 0.066f);
    add(mesh, loose, palette.pillow,
        moved({-0.57f, 0.675f, 0.125f}) * turned({0, 1, 0}, 14) * turned({1, 0, 0}, -18));
    add(mesh, loose, palette.throw_pillow,
        moved({0.58f, 0.675f, 0.125f}) * turned({0, 1, 0}, -12) * turned({1, 0, 0}, -18));
    return mesh;
}

Mesh chair(const Palette& palette) {
    Mesh mesh;
    for (const float x : {-0.18f, 0.18f})
        add(mesh, bar({x, 0, 0.172f}, {x, 0.40f, 0.172f}, {1, 0, 0}, {0.026f, 0.026f}, 1.4f),
            palette.oak);
    for (const float x : {-0.185f, 0.185f}) add(mesh, back_post(x), palette.oak);
    add(mesh, box({-0.2f, 0.40f, -0.168f}, {0.2f, 0.44f, 0.2f}, kTop), palette.oak);
    add(mesh, padded({-0.205f, 0.44f, -0.166f}, {0.205f, 0.472f, 0.208f}, 0.014f),
        palette.chair_seat);
    add(mesh, back_slat(0.58f, 0.64f), palette.oak);
    add(mesh, back_slat(0.74f, 0.84f), palette.oak);
    return mesh;
}

Mesh dining_table(const Palette& palette) {
    Mesh mesh;
    add(mesh, padded({-0.8f, 0.71f, -0.45f}, {0.8f, 0.74f, 0.45f}, 0.006f), palette.walnut);
    add(mesh,
        quad({-0.8f, 0.71f, -0.45f}, {0.8f, 0.71f, -0.45f}, {0.8f, 0.71f, 0.45f},
             {-0.8f, 0.71f, 0.45f}),
        palette.walnut);
    // Aprons between the legs, set in from the edge.
    for (const float z : {-0.38f, 0.38f})
        add(mesh, box({-0.70f, 0.63f, z - 0.01f}, {0.70f, 0.71f, z + 0.01f}, kTop), palette.walnut);
    for (const float x : {-0.73f, 0.73f})
        add(mesh, box({x - 0.01f, 0.63f, -0.35f}, {x + 0.01f, 0.71f, 0.35f}, kTop), palette.walnut);
    add_round_legs(mesh, palette.walnut, {0.73f, 0.38f}, 0.71f, {0.018f, 0.032f}, 10);
    return mesh;
}

Mesh coffee_table(const Palette& palette) {
    Mesh mesh;
    add(mesh, padded({-0.55f, 0.375f, -0.3f}, {0.55f, 0.4f, 0.3f}, 0.006f), palette.oak);
    add(mesh,
        quad({-0.55f, 0.375f, -0.3f}, {0.55f, 0.375f, -0.3f}, {0.55f, 0.375f, 0.3f},
             {-0.55f, 0.375f, 0.3f}),
        palette.oak);
    add(mesh, box({-0.44f, 0.14f, -0.21f}, {0.44f, 0.155f, 0.21f}), palette.oak);
    add_round_legs(mesh, palette.oak, {0.46f, 0.23f}, 0.375f, {0.015f, 0.024f}, 8);
    return mesh;
}

float shelf_height(int shelf) {
    return 0.09f + 0.38f * static_cast<float>(shelf);
}

Mesh bookshelf(const Palette& palette) {
    constexpr float kHalf = 0.5f * kShelfWidth;
    constexpr float kOuter = kHalf + 0.025f;
    constexpr float kBoard = 0.022f;
    Mesh mesh;
    add(mesh, box({-kOuter, 0, -0.15f}, {-kHalf, 2, 0.15f}, kBottom), palette.oak);
    add(mesh, box({kHalf, 0, -0.15f}, {kOuter, 2, 0.15f}, kBottom), palette.oak);
    add(mesh, box({-kHalf, 0, -0.15f}, {kHalf, 2, -0.142f}, kLeft | kRight | kBottom), palette.oak);

    const unsigned inside = kLeft | kRight | kBack;
    for (int i = 0; i < kShelfCount; ++i) {
        const float top = shelf_height(i);
        add(mesh, box({-kHalf, top - kBoard, -0.142f}, {kHalf, top, 0.145f}, inside), palette.oak);
    }
    add(mesh, box({-kHalf, 2 - kBoard, -0.142f}, {kHalf, 2, 0.15f}, inside), palette.oak);
    add(mesh,
        box({-kHalf, 0, 0.115f}, {kHalf, 0.09f - kBoard, 0.13f}, kLeft | kRight | kTop | kBottom),
        palette.oak);
    return mesh;
}

}  // namespace chiaro
