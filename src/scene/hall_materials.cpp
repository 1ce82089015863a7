#include "scene/hall_materials.h"

#include "scene/make_material.h"
#include "scene/painting.h"

namespace chiaro {
namespace {

// Worsted wool: an even nap.
Texture cloth_texture() {
    return painted("Cloth", 256, 256, 1, [](float u, float v) {
        const float nap = 0.7f * tiling_noise(u, v, 96, 96, 3) + 0.3f * tiling_noise(u, v, 9, 9, 4);
        return (0.88f + 0.24f * nap) * Rgb(0.005f, 0.045f, 0.028f);
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
    hall.rail = varnished(scene, "Mahogany", grain, {0.13f, 0.045f, 0.025f}, 0.4f);
    hall.panel = textured(scene, "Dark oak", grain, kGrainTile, {0.15f, 0.085f, 0.05f});
    hall.floor = textured(scene, "Stained boards", planks, kPlankTile, {0.30f, 0.21f, 0.16f});
    hall.leather = matte(scene, "Black leather", Rgb(0.025f));
    hall.inlay = matte(scene, "Mother of pearl", {0.75f, 0.73f, 0.66f});
    hall.metal = glossy(scene, "Polished brass", {0.78f, 0.56f, 0.24f}, 0.25f, 1);
    hall.casting = glossy(scene, "Bronze", {0.26f, 0.19f, 0.12f}, 0.3f, 1);
    hall.paint = matte(scene, "Ochre paint", {0.72f, 0.58f, 0.40f});
    hall.ceiling = matte(scene, "Smoked ceiling", {0.74f, 0.69f, 0.58f});
    hall.enamel = glossy(scene, "Green enamel", {0.015f, 0.12f, 0.07f}, 0.2f);
    hall.enamel_inside = matte(scene, "White enamel", {0.8f, 0.79f, 0.75f});
    hall.seat = matte(scene, "Oxblood leather", {0.15f, 0.022f, 0.018f});
    hall.cue_shaft = matte(scene, "Maple", {0.66f, 0.50f, 0.30f});
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
