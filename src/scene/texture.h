// Textures: texel arrays and how they are looked up (glTF 2.0, 5.26 samplers;
// KHR_texture_transform).
#pragma once

#include "base/color.h"
#include "base/ids.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace chiaro {

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// 8-bit RGBA texels, sRGB-encoded in the colour channels where `srgb` says so, rows from the top
/// of the image. Texture coordinate (0, 0) is the top left corner (glTF); importers of files with
/// another origin flip the coordinate.
struct Texture {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<std::array<std::uint8_t, 4>> texels;
    bool srgb = true;
    bool nearest = false;  // magnification filter NEAREST; otherwise bilinear
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
};

/// A texture as a material uses it: which set of coordinates, and how these are transformed first.
struct TextureUse {
    TextureId texture = TextureId::none;
    std::uint8_t uv_set = 0;  // 0 or 1
    Vec2 offset = Vec2(0);    // KHR_texture_transform: uv' = offset + rotate(scale * uv)
    Vec2 scale = Vec2(1);
    float rotation = 0;  // radians, counter-clockwise in uv as glTF defines it

    bool used() const { return texture != TextureId::none; }
    Vec2 transform(Vec2 uv) const;
    bool operator==(const TextureUse&) const = default;
};

/// Linear RGB and alpha at `uv` (already transformed), bilinear unless the texture says nearest.
/// Any finite uv; a non-finite one reads texel (0, 0).
Vec4 sample_texture(const Texture& texture, Vec2 uv);

/// Mean linear RGB over all texels, weighted by alpha where the texture has any.
Rgb mean_color(const Texture& texture);

}  // namespace chiaro
