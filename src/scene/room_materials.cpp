#include "scene/room_materials.h"

#include "scene/make_material.h"

namespace chiaro {
namespace {

void add_shell_materials(Scene& scene, Palette& palette) {
    palette.wall = matte(scene, "Wall paint", {0.74f, 0.71f, 0.65f});
    palette.accent_wall = matte(scene, "Sage paint", {0.33f, 0.40f, 0.36f});
    palette.ceiling = matte(scene, "Ceiling paint", {0.82f, 0.82f, 0.80f});
    palette.woodwork = matte(scene, "White woodwork", {0.78f, 0.77f, 0.74f});
    palette.floor = textured(scene, "Oak floor", add_texture(scene, plank_texture()), kPlankTile);
    palette.glass = matte(scene, "Night window", {0.025f, 0.03f, 0.045f});
    palette.curtain = matte(scene, "Linen curtain", {0.62f, 0.55f, 0.45f});
}

void add_furniture_materials(Scene& scene, Palette& palette) {
    const TextureId grain = add_texture(scene, grain_texture());
    palette.oak = textured(scene, "Oak", grain, kGrainTile, {0.58f, 0.41f, 0.24f});
    palette.walnut = textured(scene, "Walnut", grain, kGrainTile, {0.26f, 0.15f, 0.085f});
    palette.metal = matte(scene, "Black metal", Rgb(0.045f));
    palette.brass = matte(scene, "Brass", {0.5f, 0.36f, 0.15f});
    palette.sofa = matte(scene, "Sofa cloth", {0.36f, 0.37f, 0.40f});
    palette.pillow = matte(scene, "Ochre cloth", {0.62f, 0.36f, 0.09f});
    palette.throw_pillow = matte(scene, "Teal cloth", {0.07f, 0.23f, 0.26f});
    palette.chair_seat = matte(scene, "Seat leather", {0.30f, 0.13f, 0.06f});
    palette.rug = textured(scene, "Rug", add_texture(scene, rug_texture()), kRugTile);
    palette.rug_border = matte(scene, "Rug border", {0.08f, 0.10f, 0.15f});
}

void add_small_materials(Scene& scene, Palette& palette) {
    palette.shade = matte(scene, "Lamp shade", {0.76f, 0.70f, 0.58f});
    palette.ceramic = matte(scene, "White ceramic", {0.75f, 0.74f, 0.71f});
    palette.glaze = glossy(scene, "Blue glaze", {0.06f, 0.17f, 0.32f}, 0.15f);
    palette.porcelain = glossy(scene, "Porcelain", {0.76f, 0.75f, 0.71f}, 0.1f);
    palette.silver = glossy(scene, "Silver", {0.84f, 0.82f, 0.78f}, 0.15f, 1);
    palette.terracotta = matte(scene, "Terracotta", {0.50f, 0.21f, 0.11f});
    palette.soil = matte(scene, "Soil", {0.06f, 0.045f, 0.03f});
    palette.leaf = matte(scene, "Leaf", {0.08f, 0.21f, 0.05f});
    palette.fruit = matte(scene, "Orange", {0.75f, 0.30f, 0.03f});
    palette.pages = matte(scene, "Pages", {0.72f, 0.67f, 0.55f});
    palette.passe_partout = matte(scene, "Passe-partout", {0.76f, 0.75f, 0.71f});
    for (int i = 0; i < 3; ++i) {
        const TextureId picture = add_texture(scene, picture_texture(i));
        palette.pictures[i] = textured(scene, scene.texture(picture).name, picture, 1);
    }
    const std::array<Rgb, 10> cloths = {{{0.42f, 0.06f, 0.05f},
                                         {0.05f, 0.13f, 0.28f},
                                         {0.08f, 0.22f, 0.12f},
                                         {0.60f, 0.47f, 0.20f},
                                         {0.63f, 0.58f, 0.48f},
                                         {0.20f, 0.20f, 0.21f},
                                         {0.52f, 0.22f, 0.08f},
                                         {0.12f, 0.29f, 0.33f},
                                         {0.28f, 0.11f, 0.20f},
                                         {0.70f, 0.66f, 0.60f}}};
    for (std::size_t i = 0; i < cloths.size(); ++i)
        palette.books[i] = matte(scene, "Book cloth " + std::to_string(i + 1), cloths[i]);
}

}  // namespace

Palette make_palette(Scene& scene, float lamp_luminance) {
    Palette palette;
    add_shell_materials(scene, palette);
    add_furniture_materials(scene, palette);
    add_small_materials(scene, palette);

    // A warm white of luminance 1. Linear Rec. 709 has 6500 K for white, and nothing adapts the eye
    // to the lamp: a true 4000 K would look orange.
    constexpr Rgb kWarmWhite = {1.11f, 0.99f, 0.78f};
    palette.lamp = add_material(
        scene, {.name = "Lamp", .base_color = Rgb(0.8f), .emission = lamp_luminance * kWarmWhite});
    return palette;
}

}  // namespace chiaro
