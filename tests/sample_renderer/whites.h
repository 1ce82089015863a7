// Surfaces that absorb nothing, one of each kind: in surroundings of one radiance nobody can see
// them.
#pragma once

#include "sample_renderer/tiny_scenes.h"

namespace chiaro::tiny {

struct White {
    const char* name;
    Gloss gloss;
    bool textured = false;  // metal and roughness, by texels of any values
};

/// MTL's facets, which reflect half of the light at all angles.
inline Gloss varnish() {
    return {.model = GlossModel::phong, .specular = Rgb(0.5f), .shininess = 40};
}
/// Half metal, and half of the rest a ground pane.
inline Gloss mixture() {
    Gloss gloss = glass(0.4f, true);
    gloss.metallic = gloss.transmission = 0.5f;
    return gloss;
}

inline const White kWhites[] = {{"chalk", Gloss()},
                                {"mirror", metal(0)},
                                {"polished metal", metal(0.15f)},
                                {"metal", metal(0.5f)},
                                {"lacquer", plastic(0)},
                                {"polished plastic", plastic(0.15f)},
                                {"plastic", plastic(0.5f)},
                                {"glass", glass(0, false)},
                                {"ground glass", glass(0.4f, false)},
                                {"pane", glass(0, true)},
                                {"ground pane", glass(0.4f, true)},
                                {"mixture", mixture()},
                                {"varnish", varnish()},
                                {"MTL mirror", mirror(Rgb(1))},
                                {"textured", metal(1), true}};

/// A box of that surface, from -1 to 1.
inline ObjectId add_white_box(Scene& scene, const White& white) {
    const MaterialId material = add_glossy(scene, Rgb(1), white.gloss);
    Mesh mesh = box_mesh(Vec3(-1), Vec3(1), material, false);
    for (const Vec3& p : mesh.positions)
        mesh.uvs[0].push_back(0.25f * Vec2(p.x + 0.3f * p.z, p.y - 0.2f * p.z));
    if (white.textured) {
        Texture texture;
        texture.srgb = false;
        texture.width = texture.height = 4;
        for (std::uint8_t i = 0; i < 16; ++i)
            texture.texels.push_back(
                {0, std::uint8_t(17 * (7 * i % 16)), std::uint8_t(17 * (11 * i % 16)), 255});
        scene.materials[index_of(material)].gloss.metallic_roughness.texture =
            static_cast<TextureId>(scene.textures.size());
        scene.textures.push_back(std::move(texture));
    }
    return add_object(scene, std::move(mesh));
}

}  // namespace chiaro::tiny
