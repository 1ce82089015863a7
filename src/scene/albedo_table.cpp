#include "scene/albedo_table.h"

#include "base/halton.h"
#include "scene/fresnel.h"
#include "scene/ggx.h"

#include <array>
#include <memory>
#include <mutex>

namespace chiaro {
namespace {

constexpr int kNodes = 32;     // of roughness and of the root of the cosine, each from 0 to 1
constexpr int kSamples = 384;  // directions a node
constexpr int kIndices = 12;   // of refraction, from 1 to 3
constexpr float kLeastAlpha = 1e-4f;

// A place between two of the nodes that divide [0, 1].
struct Place {
    int node;
    float rest;

    Place(float x, int nodes) {
        const float scaled = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
        node = std::min(static_cast<int>(scaled), nodes - 2);
        rest = scaled - static_cast<float>(node);
    }
};

// Two functions of roughness and cosine, and their means over the hemisphere.
struct Grid {
    std::array<std::array<Vec2, kNodes>, kNodes> values;  // [roughness][cosine]
    std::array<Vec2, kNodes> means;

    Vec2 at(Place roughness, Place cosine) const {
        const auto along = [&](const std::array<Vec2, kNodes>& row) {
            return glm::mix(row[cosine.node], row[cosine.node + 1], cosine.rest);
        };
        return glm::mix(along(values[roughness.node]), along(values[roughness.node + 1]),
                        roughness.rest);
    }
    Vec2 mean(Place roughness) const {
        return glm::mix(means[roughness.node], means[roughness.node + 1], roughness.rest);
    }
};

// The cosines lie as close as the values change: fast at grazing angles.
Place place_cosine(float cosine) {
    return {std::sqrt(std::max(cosine, 0.0f)), kNodes};
}
Place place_alpha(float alpha) {
    return {std::sqrt(std::max(alpha, 0.0f)), kNodes};
}

// The mean over the hemisphere of a row as it is interpolated: of 2 cos d(cos) = 4 x^3 dx.
Vec2 mean_of_row(const std::array<Vec2, kNodes>& row) {
    constexpr int kSteps = 8 * (kNodes - 1);
    Vec2 sum(0);
    float weights = 0;
    for (int i = 0; i < kSteps; ++i) {
        const float x = (static_cast<float>(i) + 0.5f) / kSteps;
        const Place p(x, kNodes);
        sum += x * x * x * glm::mix(row[p.node], row[p.node + 1], p.rest);
        weights += x * x * x;
    }
    return sum / weights;
}

// Fills a grid with the means of `scatter(eye, facet's normal, alpha)` over visible normals.
template <typename Scatter>
Grid integrate(const Scatter& scatter) {
    std::array<Vec2, kSamples> points;  // half the azimuths tell all
    for (int i = 0; i < kSamples; ++i)
        points[i] = {0.5f * (static_cast<float>(i) + 0.5f) / kSamples, halton(0, i)};

    Grid grid;
    for (int r = 0; r < kNodes; ++r) {
        const float roughness = static_cast<float>(r) / (kNodes - 1);
        const float alpha = std::max(roughness * roughness, kLeastAlpha);
        for (int c = 0; c < kNodes; ++c) {
            const float root = static_cast<float>(c) / (kNodes - 1);
            const float cosine = std::max(root * root, 1e-4f);
            const Vec3 eye(std::sqrt(1 - cosine * cosine), 0, cosine);
            Vec2 sum(0);
            for (const Vec2 u : points)
                sum += scatter(eye, sample_visible_normal(eye, alpha, u), alpha);
            grid.values[r][c] = glm::min(sum / static_cast<float>(kSamples), Vec2(1));
        }
        grid.means[r] = mean_of_row(grid.values[r]);
    }
    return grid;
}

// The part of the light from the mirrored direction that is not masked, which is density and
// visibility over the density of choosing the facet.
float reflected_part(Vec3 eye, Vec3 facet, float alpha) {
    const float cosine = 2 * glm::dot(eye, facet) * facet.z - eye.z;
    if (!(cosine > 0)) return 0;
    return 2 * cosine * ggx_visibility(eye.z, cosine, alpha) * ggx_reach(eye.z, alpha);
}

const Grid& mirror_grid() {
    static const Grid grid = integrate([](Vec3 eye, Vec3 facet, float alpha) {
        return reflected_part(eye, facet, alpha) * Vec2(1, schlick_weight(glm::dot(eye, facet)));
    });
    return grid;
}

float glass_part(Vec3 eye, Vec3 facet, float alpha, float eta) {
    const float cosine = glm::dot(eye, facet);
    const float reflectance = fresnel_dielectric(cosine, eta);
    const float reflected = reflectance * reflected_part(eye, facet, alpha);
    const Vec3 light = refracted(eye, facet, eta);
    if (reflectance == 1 || light.z >= 0) return reflected;
    return reflected + (1 - reflectance) * ggx_g1(-light.z, alpha);
}

// Nodes of the index are even in the fourth root of the normal reflectance: the less the facets
// bend the light, the less they must shadow, and the faster that changes.
Place place_index(float index) {
    return {std::sqrt(2 * (index - 1) / (index + 1)), kIndices};
}
float index_of_node(int node) {
    const float x = static_cast<float>(node) / (kIndices - 1);
    return std::max((1 + 0.5f * x * x) / (1 - 0.5f * x * x), 1.0001f);
}

// Seen from outside and from inside glass.
const Grid& glass_grid(int node) {
    static std::array<std::once_flag, kIndices> made;
    static std::array<std::unique_ptr<const Grid>, kIndices> grids;
    std::call_once(made[node], [node] {
        const float index = index_of_node(node);
        grids[node] =
            std::make_unique<const Grid>(integrate([index](Vec3 eye, Vec3 facet, float alpha) {
                return Vec2(glass_part(eye, facet, alpha, index),
                            glass_part(eye, facet, alpha, 1 / index));
            }));
    });
    return *grids[node];
}

}  // namespace

MirrorAlbedo mirror_albedo(float alpha, float cosine) {
    const Grid& grid = mirror_grid();
    const Place roughness = place_alpha(alpha);
    const Vec2 value = grid.at(roughness, place_cosine(cosine));
    return {value.x, value.y, grid.mean(roughness).x};
}

GlassAlbedo glass_albedo(float alpha, float eta, float cosine) {
    const bool inside = eta < 1;
    const Place index = place_index(inside ? 1 / eta : eta);
    const Place roughness = place_alpha(alpha);
    const Place place = place_cosine(cosine);
    const Grid& low = glass_grid(index.node);
    const Grid& high = glass_grid(index.node + 1);
    const Vec2 value = glm::mix(low.at(roughness, place), high.at(roughness, place), index.rest);
    const Vec2 mean = glm::mix(low.mean(roughness), high.mean(roughness), index.rest);
    return inside ? GlassAlbedo{value.y, mean.y, mean.x} : GlassAlbedo{value.x, mean.x, mean.y};
}

}  // namespace chiaro
