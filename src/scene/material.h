// What a surface does with light, as files have it; scene/bsdf.h is what renderers ask.
#pragma once

#include "scene/texture.h"

namespace chiaro {

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Which of the parameters of Gloss count: none (the surface is a Lambertian of its base colour),
/// those of glTF, or those of MTL.
enum class GlossModel : std::uint8_t { none, metallic_roughness, phong };

/// Parameters of the reflection that is not diffuse, as the file has them.
struct Gloss {
    GlossModel model = GlossModel::none;
    float metallic = 0;               // [0, 1]
    float roughness = 1;              // [0, 1], perceptual
    TextureUse metallic_roughness;    // B metallic, G roughness
    Rgb specular = Rgb(0);            // MTL Ks
    float shininess = 0;              // MTL Ns
    int illumination_model = 2;       // MTL illum
    float ior = 1.5f;                 // KHR_materials_ior, MTL Ni
    float specular_factor = 1;        // KHR_materials_specular
    Rgb specular_color = Rgb(1);      // KHR_materials_specular
    float transmission = 0;           // KHR_materials_transmission; MTL illum 4, 6, 7: 1
    Rgb transmission_color = Rgb(1);  // MTL Tf
    bool thin = true;  // light goes straight on, as through a pane; false: the surface of a solid

    bool operator==(const Gloss&) const = default;
};

struct Material {
    std::string name;
    Rgb base_color = Rgb(0.8f);  // diffuse reflectance in [0, 1], times texture and vertex colour
    float alpha = 1;             // times the alpha of texture and vertex colour
    TextureUse base_color_texture;
    Rgb emission = Rgb(0);  // exitant radiance, cd/m2 a channel, times the texture
    TextureUse emission_texture;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;  // mask: surface where alpha >= cutoff
    bool double_sided = true;   // false: invisible from behind to the camera, opaque to other rays
    bool emits_backward = false;  // emission leaves the back face too (glTF double-sided)
    Gloss gloss;

    bool emissive() const { return max_component(emission) > 0; }
    bool see_through() const { return alpha_mode != AlphaMode::opaque; }
    bool operator==(const Material&) const = default;
};

}  // namespace chiaro
