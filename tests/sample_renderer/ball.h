// A surface whose normals lean from its planes everywhere.
#pragma once

#include "sample_renderer/tiny_scenes.h"

#include <cmath>

namespace chiaro::tiny {

/// A ball of 24 x 12 quads that its normals make look round.
inline ObjectId add_ball(Scene& scene, Vec3 centre, float radius, MaterialId material) {
    constexpr std::uint32_t kAround = 24, kDown = 12;
    Mesh mesh;
    for (std::uint32_t j = 0; j <= kDown; ++j)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const float theta = kPi * float(j) / kDown, phi = 2 * kPi * float(i) / kAround;
            mesh.normals.push_back({std::sin(theta) * std::cos(phi),
                                    std::sin(theta) * std::sin(phi), std::cos(theta)});
            mesh.positions.push_back(centre + radius * mesh.normals.back());
        }
    for (std::uint32_t j = 0; j < kDown; ++j)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t a = j * kAround + i, b = j * kAround + (i + 1) % kAround;
            mesh.primitives.push_back(quad(a, a + kAround, b + kAround, b, material));
        }
    return add_object(scene, std::move(mesh));
}

}  // namespace chiaro::tiny
