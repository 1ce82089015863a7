// The built-in gallery that is lit from behind a wall: hardly any light in view is direct.

#include "scene/built_in.h"
#include "scene/curved_shapes.h"
#include "scene/decorator.h"
#include "scene/furniture.h"
#include "scene/make_material.h"

#include <array>
#include <string>

namespace chiaro {
namespace {

// Inside the walls; a partition divides a passage off on the left, open at its far end.
constexpr float kWidth = 6.6f;
constexpr float kHeight = 3.0f;
constexpr float kDepth = 5.0f;
constexpr float kPartition = 1.5f;  // its face to the passage
constexpr float kThickness = 0.12f;
constexpr float kLintel = 2.3f;   // height of the opening
constexpr float kOpening = 1.5f;  // from the back wall to where it begins

// cd/m2 of the panel on the partition's back: about 150 lux of reflected light in the gallery.
constexpr float kPanelLuminance = 12000;

struct GalleryPalette {
    Palette room;
    MaterialId plaster, stone, plinth, bronze;
};

Mesh rectangle(Vec3 a, Vec3 b, Vec3 c, Vec3 d, MaterialId material) {
    Mesh mesh;
    add(mesh, quad(a, b, c, d), material);
    return mesh;
}

void add_shell(Decorator& gallery, const GalleryPalette& palette) {
    const float x = kWidth, y = kHeight, z = kDepth;
    const MaterialId wall = palette.plaster;
    // Surfaces end at the partition, behind which they are lit quite unlike.
    constexpr float kFace = kPartition + kThickness;
    Mesh floor, ceiling, back, front;
    const auto add_strip = [&](float from, float to) {
        add(floor, quad({from, 0, z}, {to, 0, z}, {to, 0, 0}, {from, 0, 0}), palette.room.floor);
        add(ceiling, quad({from, y, 0}, {to, y, 0}, {to, y, z}, {from, y, z}),
            palette.room.ceiling);
        add(back, quad({from, 0, 0}, {to, 0, 0}, {to, y, 0}, {from, y, 0}), wall);
        add(front, quad({to, 0, z}, {from, 0, z}, {from, y, z}, {to, y, z}), wall);
    };
    add_strip(0, kPartition);
    add_strip(kFace, x);
    add(floor,
        quad({kPartition, 0, kOpening}, {kFace, 0, kOpening}, {kFace, 0, 0}, {kPartition, 0, 0}),
        palette.room.floor);
    add(back,
        quad({kPartition, 0, 0}, {kFace, 0, 0}, {kFace, kLintel, 0}, {kPartition, kLintel, 0}),
        wall);
    gallery.place("Floor", floor);
    gallery.place("Ceiling", ceiling);
    gallery.place("Back wall", back);
    gallery.place("Front wall", front);
    gallery.place("Right wall",
                  rectangle({x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}, palette.room.accent_wall));
    gallery.place("Left wall", rectangle({0, 0, z}, {0, 0, 0}, {0, y, 0}, {0, y, z}, wall));

    // The partition, over the opening a lintel, and the lamp on the side away from the gallery. A
    // fin keeps its light off what is seen through the opening.
    Mesh partition;
    add(partition, box({kPartition, 0, kOpening}, {kFace, y, z}, kTop | kBottom | kFront), wall);
    add(partition, box({kPartition, kLintel, 0}, {kFace, y, kOpening}, kTop | kBack | kFront),
        wall);
    add(partition,
        box({kPartition - 0.6f, 0, 2.56f}, {kPartition, y, 2.64f}, kTop | kBottom | kRight), wall);
    gallery.place("Partition", partition);
    gallery.place("Lamp",
                  rectangle({kPartition - 0.02f, 0.7f, 3.2f}, {kPartition - 0.02f, 0.7f, 4.8f},
                            {kPartition - 0.02f, 2.1f, 4.8f}, {kPartition - 0.02f, 2.1f, 3.2f},
                            palette.room.lamp));

    const auto skirting = [&](float length) {
        Mesh mesh;
        add(mesh, box({0, 0, 0}, {length, 0.1f, 0.014f}, kBack | kBottom), palette.room.woodwork);
        return mesh;
    };
    gallery.place("Back skirting", skirting(x - kFace - 0.015f), moved({kFace, 0, 0}));
    gallery.place("Right skirting", skirting(z), moved({x, 0, 0}) * turned({0, 1, 0}, -90));
    gallery.place("Partition skirting", skirting(z - kOpening),
                  moved({kFace, 0, z}) * turned({0, 1, 0}, 90));
}

// A long slatted bench, 0.44 high.
Mesh bench(const GalleryPalette& palette) {
    constexpr float kLong = 1.6f, kDeep = 0.42f, kHigh = 0.44f;
    constexpr int kSlats = 5;
    const float pitch = kDeep / kSlats;
    Mesh mesh;
    for (int i = 0; i < kSlats; ++i) {
        const float z = pitch * static_cast<float>(i) - 0.5f * kDeep;
        add(mesh,
            box({-0.5f * kLong, kHigh - 0.035f, z + 0.006f},
                {0.5f * kLong, kHigh, z + pitch - 0.006f}),
            palette.room.oak);
    }
    for (const float x : {-0.6f, 0.6f}) {
        add(mesh,
            box({x - 0.03f, kHigh - 0.085f, -0.19f}, {x + 0.03f, kHigh - 0.035f, 0.19f}, kTop),
            palette.room.walnut);
        for (const float z : {-0.17f, 0.17f})
            add(mesh, bar({x, 0, z}, {x, kHigh - 0.085f, z}, {1, 0, 0}, Vec2(0.036f), 1.3f),
                palette.room.walnut);
    }
    return mesh;
}

// A slender bird's body in bronze, on a stone foot.
Mesh sculpture(const GalleryPalette& palette) {
    const Vec2 foot[] = {{0.075f, 0}, {0.075f, 0.05f}, {0.075f, 0.05f}, {0, 0.05f}};
    const Vec2 body[] = {{0.034f, 0.05f}, {0.02f, 0.13f},  {0.045f, 0.34f}, {0.06f, 0.52f},
                         {0.047f, 0.72f}, {0.018f, 0.91f}, {0, 0.955f}};
    Mesh mesh;
    add(mesh, lathe(foot, 10), palette.stone);
    add(mesh, revolve(smooth_profile(body)), palette.bronze);
    return mesh;
}

Mesh plinth(const GalleryPalette& palette) {
    Mesh mesh;
    add(mesh, box({-0.16f, 0, -0.16f}, {0.16f, 0.04f, 0.16f}, kBottom | kTop), palette.stone);
    add(mesh, box({-0.18f, 0.04f, -0.18f}, {0.18f, 0.95f, 0.18f}), palette.plinth);
    return mesh;
}

void furnish(Decorator& gallery, const GalleryPalette& palette) {
    gallery.place(
        "Rug",
        [&] {
            // The room's rug without a fringe would float: a plain one, with a border.
            Mesh mesh;
            add(mesh, box({-1.1f, 0, -0.75f}, {1.1f, 0.012f, 0.75f}, kBottom), palette.room.rug);
            return mesh;
        }(),
        standing(4.3f, 2.35f, 0, 0.0005f));
    gallery.place("Chair", chair(palette.room), standing(5.55f, 1.0f, -32));
    gallery.place("Bench", bench(palette), standing(3.2f, 2.6f, 90, 0.013f));
    gallery.place("Plinth", plinth(palette), standing(3.05f, 0.75f, 20));
    gallery.place("Sculpture", sculpture(palette), standing(3.05f, 0.75f, 0, 0.9505f));
    const Mat4 on_right = moved({kWidth, 1.6f, 0}) * turned({0, 1, 0}, -90);
    const Mat4 hangings[] = {moved({4.25f, 1.6f, 0}), moved({5.15f, 1.6f, 0}),
                             on_right * moved({2.2f, 0, 0})};
    for (int i = 0; i < 3; ++i)
        gallery.place("Picture " + std::to_string(i + 1), picture(palette.room, i), hangings[i]);
    gallery.place("Vase", vase(palette.room), standing(6.25f, 0.32f));
}

}  // namespace

Scene make_indirect() {
    Scene scene;
    GalleryPalette palette = {.room = make_palette(scene, kPanelLuminance)};
    palette.plaster = matte(scene, "Plaster", {0.76f, 0.74f, 0.70f});
    palette.stone = matte(scene, "Slate", {0.07f, 0.07f, 0.075f});
    palette.plinth = matte(scene, "Limewashed plinth", {0.7f, 0.68f, 0.63f});
    palette.bronze = glossy(scene, "Bronze", {0.62f, 0.42f, 0.22f}, 0.3f, 1);
    Decorator gallery(scene);
    add_shell(gallery, palette);
    furnish(gallery, palette);
    scene.cameras = {{.name = "main",
                      .eye = {5.3f, 1.5f, 4.75f},
                      .target = {3.95f, 1.15f, 1.0f},
                      .vertical_fov = 58},
                     {.name = "chair",
                      .eye = {3.6f, 1.35f, 3.6f},
                      .target = {5.2f, 0.75f, 1.2f},
                      .vertical_fov = 42},
                     {.name = "sculpture",
                      .eye = {4.6f, 1.5f, 3.1f},
                      .target = {2.9f, 1.2f, 0.5f},
                      .vertical_fov = 45}};
    check_scene(scene);
    return scene;
}

}  // namespace chiaro
