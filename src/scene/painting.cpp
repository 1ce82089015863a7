#include "scene/painting.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

std::uint8_t encode(float linear) {
    return static_cast<std::uint8_t>(
        std::lround(255 * linear_to_srgb(std::clamp(linear, 0.0f, 1.0f))));
}

}  // namespace

Texture painted(std::string name, int width, int height, int samples, const Paint& paint) {
    Texture texture = {.name = std::move(name), .width = width, .height = height};
    texture.texels.reserve(static_cast<std::size_t>(width) * height);
    const Vec2 size(width * samples, height * samples);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Rgb sum(0);
            for (int j = 0; j < samples; ++j) {
                for (int i = 0; i < samples; ++i) {
                    const Vec2 p = (Vec2(x * samples + i, y * samples + j) + 0.5f) / size;
                    sum += paint(p.x, p.y);
                }
            }
            const Rgb mean = sum / static_cast<float>(samples * samples);
            texture.texels.push_back({encode(mean.x), encode(mean.y), encode(mean.z), 255});
        }
    }
    return texture;
}

float lattice_value(int x, int y, std::uint32_t seed) {
    return to_unit_float(
        hash32(hash32(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), seed));
}

float tiling_noise(float u, float v, int columns, int rows, std::uint32_t seed) {
    const float x = u * static_cast<float>(columns);
    const float y = v * static_cast<float>(rows);
    const int i = static_cast<int>(std::floor(x));
    const int j = static_cast<int>(std::floor(y));
    const auto smooth = [](float t) { return t * t * (3 - 2 * t); };
    const float fx = smooth(x - static_cast<float>(i));
    const float fy = smooth(y - static_cast<float>(j));
    const auto at = [&](int di, int dj) {
        return lattice_value((i + di) % columns, (j + dj) % rows, seed);
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
}

float wood_figure(float u, float v, std::uint32_t seed) {
    const float wander = 0.012f * tiling_noise(u, v, 4, 8, seed + 3);
    v = v + wander - std::floor(v + wander);
    return 0.5f * tiling_noise(u, v, 5, 48, seed) + 0.3f * tiling_noise(u, v, 12, 120, seed + 1) +
           0.2f * tiling_noise(u, v, 24, 200, seed + 2);
}

}  // namespace chiaro
