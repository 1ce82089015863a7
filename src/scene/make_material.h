// Materials and textures added to a scene that is made in code.
#pragma once

#include "scene/scene.h"

#include <string>

namespace chiaro {

TextureId add_texture(Scene& scene, Texture texture);
MaterialId add_material(Scene& scene, Material material);

/// A Lambertian surface.
MaterialId matte(Scene& scene, std::string name, Rgb reflectance);

/// `tile`: metres that the texture covers; 1 where coordinates are already from 0 to 1.
MaterialId textured(Scene& scene, std::string name, TextureId texture, float tile,
                    Rgb tint = Rgb(1));

/// A glaze or varnish over the reflectance, or a metal of it (`metallic` = 1).
MaterialId glossy(Scene& scene, std::string name, Rgb reflectance, float roughness,
                  float metallic = 0);

}  // namespace chiaro
