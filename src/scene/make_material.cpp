#include "scene/make_material.h"

namespace chiaro {

MaterialId add_material(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return static_cast<MaterialId>(scene.materials.size() - 1);
}

MaterialId matte(Scene& scene, std::string name, Rgb reflectance) {
    return add_material(scene, {.name = std::move(name), .base_color = reflectance});
}

MaterialId glossy(Scene& scene, std::string name, Rgb reflectance, float roughness,
                  float metallic) {
    return add_material(scene, {.name = std::move(name),
                                .base_color = reflectance,
                                .gloss = {.model = GlossModel::metallic_roughness,
                                          .metallic = metallic,
                                          .roughness = roughness}});
}

TextureId add_texture(Scene& scene, Texture texture) {
    scene.textures.push_back(std::move(texture));
    return static_cast<TextureId>(scene.textures.size() - 1);
}

MaterialId textured(Scene& scene, std::string name, TextureId texture, float tile, Rgb tint) {
    return add_material(scene,
                        {.name = std::move(name),
                         .base_color = tint,
                         .base_color_texture = {.texture = texture, .scale = Vec2(1 / tile)}});
}

}  // namespace chiaro
