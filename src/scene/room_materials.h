// Materials of the built-in room, and the textures that they are made with.
#pragma once

#include "scene/scene.h"

#include <array>

namespace chiaro {

/// Materials by what they are for; ids in the scene that make_palette() was given.
struct Palette {
    MaterialId wall, accent_wall, ceiling, woodwork, floor;
    MaterialId oak, walnut, metal, brass, glass;
    MaterialId sofa, pillow, throw_pillow, curtain, chair_seat, rug, rug_border;
    MaterialId shade, ceramic, glaze, terracotta, soil, leaf, fruit;
    MaterialId porcelain, silver;  // glossy, as glaze is
    MaterialId pages, passe_partout, lamp;
    std::array<MaterialId, 3> pictures;
    std::array<MaterialId, 10> books;
};

/// Adds the room's materials and textures to `scene`. Reflectances are those of real paints, woods
/// and cloths; none is above 0.85. `lamp_luminance` is that of the ceiling panel [cd/m2].
Palette make_palette(Scene& scene, float lamp_luminance);

/// Tileable textures, linear reflectance encoded as sRGB. Texture coordinates in metres are to be
/// divided by the tile's side.
inline constexpr float kPlankTile = 2.4f;  // metres
inline constexpr float kGrainTile = 1.0f;
inline constexpr float kRugTile = 0.36f;
Texture plank_texture();             // oak floor, planks along u, mean luminance about 0.35
Texture grain_texture();             // grey figure of wood along u, to be tinted by a base colour
Texture rug_texture();               // dark lozenges on wool
Texture picture_texture(int which);  // 0 to 2, not tileable

}  // namespace chiaro
