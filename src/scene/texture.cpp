#include "scene/texture.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

std::array<float, 256> make_table(bool srgb) {
    std::array<float, 256> table;
    for (int i = 0; i < 256; ++i) {
        const float value = static_cast<float>(i) / 255.0f;
        table[i] = srgb ? srgb_to_linear(value) : value;
    }
    return table;
}

const std::array<float, 256> kFromSrgb = make_table(true);
const std::array<float, 256> kFromLinear = make_table(false);

Vec4 texel(const Texture& texture, int x, int y) {
    const std::array<float, 256>& decode = texture.srgb ? kFromSrgb : kFromLinear;
    const auto& t = texture.texels[static_cast<std::size_t>(y) * texture.width + x];
    return {decode[t[0]], decode[t[1]], decode[t[2]], kFromLinear[t[3]]};
}

// A coordinate brought into [0, 1] as the sampler says; then no product with a size overflows.
float wrap_coordinate(float x, Wrap wrap) {
    switch (wrap) {
        case Wrap::clamp_to_edge:
            return glm::clamp(x, 0.0f, 1.0f);
        case Wrap::repeat:
            return x - std::floor(x);
        case Wrap::mirrored_repeat: {
            const float period = x - 2 * std::floor(0.5f * x);
            return period > 1 ? 2 - period : period;
        }
    }
    return 0;
}

// A texel index that may lie one step outside [0, size).
int wrap_index(int i, int size, Wrap wrap) {
    if (i >= 0 && i < size) return i;
    if (wrap == Wrap::repeat) return i < 0 ? size - 1 : 0;
    return i < 0 ? 0 : size - 1;
}

}  // namespace

Vec2 TextureUse::transform(Vec2 uv) const {
    const Vec2 scaled = scale * uv;
    if (rotation == 0) return offset + scaled;
    // Counter-clockwise as seen in an image whose v points down: what the implementations of glTF
    // agree on.
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    return offset + Vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

Vec4 sample_texture(const Texture& texture, Vec2 uv) {
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return texel(texture, 0, 0);
    const float x = wrap_coordinate(uv.x, texture.wrap_u) * static_cast<float>(texture.width);
    const float y = wrap_coordinate(uv.y, texture.wrap_v) * static_cast<float>(texture.height);
    if (texture.nearest)
        return texel(texture, std::min(static_cast<int>(x), texture.width - 1),
                     std::min(static_cast<int>(y), texture.height - 1));

    const float left = std::floor(x - 0.5f);
    const float top = std::floor(y - 0.5f);
    const float fx = x - 0.5f - left;
    const float fy = y - 0.5f - top;
    const int x0 = wrap_index(static_cast<int>(left), texture.width, texture.wrap_u);
    const int y0 = wrap_index(static_cast<int>(top), texture.height, texture.wrap_v);
    const int x1 = wrap_index(static_cast<int>(left) + 1, texture.width, texture.wrap_u);
    const int y1 = wrap_index(static_cast<int>(top) + 1, texture.height, texture.wrap_v);
    return (1 - fy) * ((1 - fx) * texel(texture, x0, y0) + fx * texel(texture, x1, y0)) +
           fy * ((1 - fx) * texel(texture, x0, y1) + fx * texel(texture, x1, y1));
}

Rgb mean_color(const Texture& texture) {
    glm::dvec3 weighted(0), plain(0);
    double alpha_sum = 0;
    for (int y = 0; y < texture.height; ++y) {
        for (int x = 0; x < texture.width; ++x) {
            const glm::dvec4 t(texel(texture, x, y));
            weighted += t.w * glm::dvec3(t);
            plain += glm::dvec3(t);
            alpha_sum += t.w;
        }
    }
    if (alpha_sum > 0) return Rgb(weighted / alpha_sum);
    return Rgb(plain / std::max(1.0, static_cast<double>(texture.texels.size())));
}

}  // namespace chiaro
