// Textures averaged over a pixel.

#include "image_generator/view_fragments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro {
namespace {

// Primitives in a row within a pixel of which one cannot speak for the others.
constexpr float kMostInPixel = 100;

}  // namespace

std::optional<PixelFootprint> footprint_on_plane(const Scene& scene, const View& view, int x, int y,
                                                 const SurfacePoint& point) {
    const Vec3 here = surface_position(scene, point);
    const SurfaceTangents edge = surface_tangents(scene, point);
    const Vec3 normal = glm::cross(edge.u, edge.v);
    const float area2 = glm::dot(normal, normal);
    if (!(area2 > 0)) return std::nullopt;
    const float distance = glm::distance(here, view.eye());

    // Where the next pixel's ray meets the plane, in terms of the edges.
    const auto change_to = [&](int next_x, int next_y) -> std::optional<Vec2> {
        const Ray ray =
            view.ray(static_cast<float>(next_x) + 0.5f, static_cast<float>(next_y) + 0.5f);
        const float t = glm::dot(here - ray.origin, normal) / glm::dot(ray.direction, normal);
        if (!(t > 0.5f * distance && t < 2 * distance)) return std::nullopt;
        const Vec3 there = ray.origin + t * ray.direction - here;
        return Vec2(glm::dot(glm::cross(there, edge.v), normal),
                    glm::dot(glm::cross(edge.u, there), normal)) /
               area2;
    };
    const auto across = change_to(x + 1, y), down = change_to(x, y + 1);
    if (!across || !down) return std::nullopt;
    const float largest =
        std::max({std::abs(across->x), std::abs(across->y), std::abs(down->x), std::abs(down->y)});
    if (!(largest < kMostInPixel)) return std::nullopt;
    return PixelFootprint{*across, *down};
}

Rgb mean_diffuse_albedo(const Scene& scene, const SeenPiece& piece,
                        const PixelFootprint& footprint) {
    const SurfacePoint& here = piece.point;
    const auto albedo_at = [&](float x, float y) {
        SurfacePoint p = here;
        p.u += x * footprint.across.x + y * footprint.down.x;
        p.v += x * footprint.across.y + y * footprint.down.y;
        return diffuse_albedo(bsdf_at(scene, p, piece.front), piece.cosine);
    };
    // Four places, irregular so that no pattern falls in step with them, show whether there is any
    // detail within the pixel; if so, sixteen resolve it.
    constexpr std::array<Vec2, 4> kProbes = {Vec2(-0.37f, -0.21f), Vec2(0.29f, -0.38f),
                                             Vec2(0.41f, 0.33f), Vec2(-0.18f, 0.27f)};
    Rgb sum(0), low(kInfinity), high(0);
    for (const Vec2 probe : kProbes) {
        const Rgb c = albedo_at(probe.x, probe.y);
        sum += c;
        low = glm::min(low, c);
        high = glm::max(high, c);
    }
    if (max_component(high - low) <= 0.02f * max_component(high)) return 0.25f * sum;
    sum = Rgb(0);
    for (int i = 0; i < 16; ++i)
        sum += albedo_at((static_cast<float>(i % 4) - 1.5f) / 4,
                         (static_cast<float>(i / 4) - 1.5f) / 4);
    return sum / 16.0f;
}

}  // namespace chiaro
