// The solids that a mesh is put together from, and which way their faces look.
#pragma once

#include "scene/scene.h"

#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

namespace chiaro {

/// Primitives of a mesh that hang together by corners in one place.
inline std::map<std::size_t, std::vector<const Primitive*>> solids_of(const Mesh& mesh) {
    std::map<std::tuple<long, long, long>, std::size_t> places;
    std::vector<std::size_t> place(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3 p = mesh.positions[i] * 1e5f;
        const std::tuple key(std::lround(p.x), std::lround(p.y), std::lround(p.z));
        place[i] = places.try_emplace(key, i).first->second;
    }
    std::vector<std::size_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Primitive& p : mesh.primitives)
        for (int i = 1; i < p.corner_count(); ++i)
            parent[root(place[p.corners[i]])] = root(place[p.corners[0]]);
    std::map<std::size_t, std::vector<const Primitive*>> solids;
    for (const Primitive& p : mesh.primitives) solids[root(place[p.corners[0]])].push_back(&p);
    return solids;
}

/// Six times the volume, seen from the middle of the solid's underside: positive if its faces look
/// outward, also where the underside (which counts nothing from there) and others are left out.
inline double outwardness(const Mesh& mesh, const std::vector<const Primitive*>& solid) {
    Box box;
    for (const Primitive* p : solid)
        for (int i = 0; i < p->corner_count(); ++i) box.add(mesh.positions[p->corners[i]]);
    const Vec3 eye(box.centre().x, box.low.y, box.centre().z);
    const auto corner = [&](const Primitive* p, int i) {
        return glm::dvec3(mesh.positions[p->corners[i]] - eye);
    };
    double sum = 0;
    for (const Primitive* p : solid)
        for (int i = 1; i + 1 < p->corner_count(); ++i)
            sum += glm::dot(corner(p, 0), glm::cross(corner(p, i), corner(p, i + 1)));
    return sum;
}

/// Primitives of all objects together.
inline std::size_t primitive_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Object& object : scene.objects) count += scene.mesh_of(object).primitives.size();
    return count;
}

}  // namespace chiaro
