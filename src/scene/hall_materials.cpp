#include "scene/hall_materials.h"

#include "scene/make_material.h"
#include "scene/painting.h"

#include <algorithm>

namespace chiaro {
namespace {

// Worsted wool: an even nap.
Texture cloth_texture() {
    return painted("Cloth", 256, 256, 1, [](float u, float v) {
        const float nap = 0.7f * tiling_noise(u, v, 96, 96, 3) + 0.3f * tiling_noise(u, v, 9, 9, 4);
        return (0.88f + 0.24f * nap) * Rgb(0.006f, 0.044f, 0.027f);
    });
}

// Mahogany: dark pores along broad figure.
Texture mahogany_texture() {
    return painted("Mahogany grain", 512, 512, 1, [](float u, float v) {
        const float figure = wood_figure(u, v, 23);
        const float ribbon = tiling_noise(u, v, 2, 14, 29);
        const float pores = glm::smoothstep(0.62f, 0.85f, tiling_noise(u, v, 28, 256, 31));
        const float tone = (0.3f + 0.9f * figure * figure + 0.35f * ribbon) * (1 - 0.45f * pores);
        return std::min(tone, 0.97f) * Rgb(1, 0.9f + 0.1f * figure, 0.8f + 0.2f * figure);
    });
}

MaterialId varnished(Scene& scene, const std::string& name, TextureId grain, Rgb tint,
                     float roughness) {
    const MaterialId material = textured(scene, name, grain, kGrainTile, tint);
    scene.materials[index_of(material)].gloss = {
        .model = GlossModel::metallic_roughness, .metallic = 0, .roughness = roughness};
    return material;
}

}  // namespace

HallPalette make_hall_palette(Scene& scene) {
    HallPalette hall;
    hall.room = make_palette(scene, 0);
    const TextureId grain = scene.material(hall.room.walnut).base_color_texture.texture;
    const TextureId planks = scene.material(hall.room.floor).base_color_texture.texture;
    hall.cloth = textured(scene, "Cloth", add_texture(scene, cloth_texture()), 0.25f);
    hall.rail = varnished(scene, "Mahogany", add_texture(scene, mahogany_texture()),
                          {0.12f, 0.036f, 0.019f}, 0.45f);
    hall.panel = textured(scene, "Dark oak", grain, kGrainTile, {0.2f, 0.12f, 0.07f});
    hall.floor = textured(scene, "Stained boards", planks, kPlankTile, {0.2f, 0.135f, 0.1f});
    hall.leather = matte(scene, "Black leather", Rgb(0.025f));
    hall.inlay = matte(scene, "Mother of pearl", {0.75f, 0.73f, 0.66f});
    hall.metal = glossy(scene, "Polished brass", {0.78f, 0.56f, 0.24f}, 0.25f, 1);
    hall.casting = glossy(scene, "Bronze", {0.3f, 0.22f, 0.13f}, 0.5f, 1);
    hall.paint = matte(scene, "Ochre paint", {0.55f, 0.4f, 0.25f});
    hall.ceiling = matte(scene, "Smoked ceiling", {0.6f, 0.5f, 0.36f});
    hall.enamel = glossy(scene, "Green enamel", {0.015f, 0.12f, 0.07f}, 0.2f);
    // As bright as a lamp, and small: whiter, it would be most of what lights the hall, by chance.
    hall.enamel_inside = matte(scene, "Enamel, browned", {0.14f, 0.125f, 0.1f});
    hall.seat = matte(scene, "Oxblood leather", {0.1f, 0.014f, 0.012f});
    hall.cue_shaft = matte(scene, "Maple", {0.66f, 0.50f, 0.30f});
    hall.label = matte(scene, "Chalk paper", {0.03f, 0.06f, 0.16f});
    hall.chalk = matte(scene, "Chalk", {0.08f, 0.25f, 0.45f});
    const Rgb glass[] = {{0.02f, 0.09f, 0.03f},
                         {0.16f, 0.06f, 0.015f},
                         {0.35f, 0.2f, 0.05f},
                         {0.4f, 0.42f, 0.38f},
                         {0.03f, 0.05f, 0.14f}};
    for (std::size_t i = 0; i < hall.bottles.size(); ++i)
        hall.bottles[i] = glossy(scene, "Bottle " + std::to_string(i + 1), glass[i], 0.25f);
    return hall;
}

}  // namespace chiaro
