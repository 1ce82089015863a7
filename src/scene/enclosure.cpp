#include "scene/enclosure.h"

#include "scene/bicubic_mesh.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace chiaro {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;  // from, to: in the order of the winding

// Six times the volume between a face and `from`, below 0 where `from` sees the face's front.
double signed_volume(const Mesh& mesh, const Primitive& primitive, glm::dvec3 from) {
    const auto corner = [&](int i) {
        return glm::dvec3(mesh.positions[primitive.corners[i]]) - from;
    };
    double volume = 0;
    for (int i = 2; i < primitive.corner_count(); ++i)
        volume += glm::dot(corner(0), glm::cross(corner(i - 1), corner(i)));
    return volume;
}

// The same of a bicubic patch, as a grid of triangles.
double signed_volume(const BicubicPatch& patch, glm::dvec3 from) {
    constexpr int kAcross = 8;
    const auto place = [&](int i, int j) {
        return glm::dvec3(patch_position(patch, Vec2(i, j) / static_cast<float>(kAcross))) - from;
    };
    double volume = 0;
    for (int j = 0; j < kAcross; ++j)
        for (int i = 0; i < kAcross; ++i) {
            const glm::dvec3 a = place(i, j), c = place(i + 1, j + 1);
            volume += glm::dot(a, glm::cross(place(i + 1, j), c));
            volume += glm::dot(a, glm::cross(c, place(i, j + 1)));
        }
    return volume;
}

bool uses(const Mesh& mesh, MaterialId material) {
    return std::ranges::any_of(mesh.primitives,
                               [&](const Primitive& p) { return p.material == material; });
}

}  // namespace

bool encloses_volume(const Mesh& mesh, MaterialId material) {
    if (!uses(mesh, material)) return false;
    // One number for all points in one place.
    std::map<std::tuple<float, float, float>, std::size_t> places;
    const auto place = [&](std::uint32_t corner) {
        const Vec3 p = mesh.positions[corner];
        return places.try_emplace({p.x, p.y, p.z}, places.size()).first->second;
    };
    std::vector<Edge> edges, reversed;
    double volume = 0;
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
        const Primitive& primitive = mesh.primitives[p];
        if (primitive.material != material) continue;
        const glm::dvec3 from = mesh.positions.front();
        volume += is_bicubic(mesh, p) ? signed_volume(mesh.bicubics[p], from)
                                      : signed_volume(mesh, primitive, from);
        const int count = primitive.corner_count();
        for (int i = 0; i < count; ++i) {
            const Edge edge = {place(primitive.corners[i]),
                               place(primitive.corners[(i + 1) % count])};
            if (edge.first == edge.second) continue;
            edges.push_back(edge);
            reversed.emplace_back(edge.second, edge.first);
        }
    }
    std::ranges::sort(edges);
    std::ranges::sort(reversed);
    return edges == reversed && volume > 0;
}

void decide_thin(Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!(scene.materials[i].gloss.transmission > 0)) continue;
        const auto id = static_cast<MaterialId>(i);
        scene.materials[i].gloss.thin = std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
            return uses(mesh, id) && !encloses_volume(mesh, id);
        });
    }
}

}  // namespace chiaro
