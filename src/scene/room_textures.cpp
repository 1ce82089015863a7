// Textures of the built-in room, computed: no files to ship, no licences to keep.

#include "scene/painting.h"
#include "scene/room_materials.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

float distance(Vec2 p, Vec2 q) {
    return glm::length(p - q);
}

Rgb landscape(float u, float v) {
    Rgb color =
        glm::mix(Rgb(0.25f, 0.38f, 0.5f), Rgb(0.75f, 0.5f, 0.33f), std::min(v / 0.6f, 1.0f));
    if (distance({0.75f * u, v}, {0.47f, 0.36f}) < 0.09f) color = Rgb(0.8f, 0.62f, 0.3f);
    const Rgb hills[] = {{0.3f, 0.32f, 0.36f}, {0.16f, 0.24f, 0.2f}, {0.08f, 0.12f, 0.08f}};
    for (int k = 0; k < 3; ++k) {
        const auto layer = static_cast<float>(k);
        const float ridge = 0.52f + 0.15f * layer + 0.06f * std::sin(7 * u + 2.5f * layer) +
                            0.025f * std::sin(19 * u + layer);
        if (v > ridge) color = hills[k];
    }
    return color;
}

Rgb circles(float u, float v) {
    const Vec2 p(0.75f * u, v);
    Rgb color(0.72f, 0.66f, 0.55f);
    if (distance(p, {0.3f, 0.38f}) < 0.22f) color = Rgb(0.55f, 0.13f, 0.07f);
    if (distance(p, {0.5f, 0.6f}) < 0.16f) color = Rgb(0.05f, 0.11f, 0.2f);
    if (distance(p, {0.3f, 0.38f}) < 0.22f && distance(p, {0.5f, 0.6f}) < 0.16f)
        color = Rgb(0.7f, 0.45f, 0.1f);
    if (std::abs(p.y - 0.84f) < 0.012f && std::abs(p.x - 0.375f) < 0.24f) color = Rgb(0.06f);
    return color;
}

Rgb arches(float u, float v) {
    const Rgb bands[] = {
        {0.5f, 0.2f, 0.1f}, {0.68f, 0.45f, 0.28f}, {0.3f, 0.36f, 0.3f}, {0.62f, 0.56f, 0.44f}};
    const Vec2 p(0.75f * (u - 0.5f), v - 0.52f);
    const float radius = p.y < 0 ? glm::length(p) : std::abs(p.x);
    const int band = static_cast<int>(radius / 0.07f);
    if (band < 4 && p.y < 0.34f) return bands[band];
    return Rgb(0.74f, 0.68f, 0.58f);
}

}  // namespace

Texture plank_texture() {
    constexpr int kPlanks = 15;
    constexpr float kPlankWidth = kPlankTile / kPlanks;
    return painted("Oak planks", 512, 512, 1, [](float u, float v) {
        const int row = static_cast<int>(v * kPlanks);
        const float joint = lattice_value(row, 7, 1);
        const float along = u - joint - std::floor(u - joint);  // two planks a row, unequal
        const float split = 0.4f + 0.2f * lattice_value(row, 8, 2);
        const int plank = 2 * row + (along < split ? 0 : 1);

        const float tone = 0.8f + 0.4f * lattice_value(plank, 9, 3);
        const float figure = wood_figure(u, v, 40 + static_cast<std::uint32_t>(plank));
        Rgb color = tone * (0.75f + 0.5f * figure) * Rgb(0.475f, 0.34f, 0.195f);

        // Dark joints, as soft as a texel is wide.
        const float across = v * kPlanks - static_cast<float>(row);
        const float to_side = std::min(across, 1 - across) * kPlankWidth;
        const float to_end = std::min({along, std::abs(along - split), 1 - along}) * kPlankTile;
        color *= glm::mix(0.4f, 1.0f, glm::smoothstep(0.0f, 0.005f, std::min(to_side, to_end)));
        return color;
    });
}

Texture grain_texture() {
    return painted("Wood grain", 256, 256, 1,
                   [](float u, float v) { return Rgb(0.6f + 0.4f * wood_figure(u, v, 11)); });
}

Texture rug_texture() {
    return painted("Rug", 256, 256, 2, [](float u, float v) {
        const float wool = 0.9f + 0.2f * tiling_noise(u, v, 64, 64, 5);
        const float lozenge = std::abs(std::abs(u - 0.5f) + std::abs(v - 0.5f) - 0.5f);
        const float knot = std::abs(u - 0.5f) + std::abs(v - 0.5f);
        const bool dark = lozenge < 0.035f || knot < 0.07f;
        return wool * (dark ? Rgb(0.05f, 0.07f, 0.12f) : Rgb(0.56f, 0.5f, 0.41f));
    });
}

Texture picture_texture(int which) {
    const Paint paints[] = {landscape, circles, arches};
    return painted("Picture " + std::to_string(which + 1), 192, 256, 2, paints[which]);
}

}  // namespace chiaro
