// Caches over flat scenes, divided at random from a seed, and what every cache must be like.
#pragma once

#include "base/random.h"
#include "sample_renderer/tiny_scenes.h"
#include "shading_cache/id_map.h"
#include "shading_cache/shading_cache.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace chiaro::tiny {

/// Makes things `times` as wide in x.
inline Mat4 stretched(float times) {
    Mat4 m(1);
    m[0].x = times;
    return m;
}

/// `columns` x `rows` unit squares in the plane z = 0, fronts up, points shared; each two triangles
/// if `triangles`. Moved by `to_world`.
inline Scene grid(int columns, int rows, bool triangles = false, const Mat4& to_world = Mat4(1)) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(0.5f));
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x)
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (columns + 1) + x);
            const auto d = a + static_cast<std::uint32_t>(columns) + 1;
            if (!triangles) {
                mesh.primitives.push_back(quad(a, a + 1, d + 1, d, material));
                continue;
            }
            mesh.primitives.push_back(triangle(a, a + 1, d + 1, material));
            mesh.primitives.push_back(triangle(a, d + 1, d, material));
        }
    add_object(scene, std::move(mesh), to_world);
    return scene;
}

/// Roots of all fronts of the first object.
inline std::vector<PatchId> front_roots(ShadingCache& cache) {
    std::vector<PatchId> roots;
    const Scene& scene = cache.scene();
    const auto count = scene.mesh_of(scene.objects[0]).primitives.size();
    for (std::uint32_t i = 0; i < count; ++i) roots.push_back(cache.root(ObjectId{0}, i, true));
    return roots;
}

inline std::vector<PatchId> leaves(const ShadingCache& cache) {
    std::vector<PatchId> result;
    for (std::uint32_t i = 0; i < cache.patches().size(); ++i)
        if (cache.patches()[i].is_leaf()) result.push_back(static_cast<PatchId>(i));
    return result;
}

inline void subdivide_at_random(ShadingCache& cache, int times, Rng& rng) {
    for (int i = 0; i < times; ++i) {
        const auto open = leaves(cache);
        cache.subdivide(open[rng.below(static_cast<std::uint32_t>(open.size()))]);
    }
}

/// World position of a patch's corner as the mesh has it, not pulled in.
inline Vec3 corner_position(const ShadingCache& cache, PatchId id, int corner) {
    const Patch& patch = cache.patch(id);
    const Vec2 uv = cache.surface_uv(id, node_place(patch.is_quad(), static_cast<Node>(corner)));
    SurfacePoint point = cache.surface_point(patch.corners[corner]);
    point.primitive = cache.surface_side(id) / 2;  // of the first object
    point.u = uv.x;
    point.v = uv.y;
    return surface_geometry(cache.scene(), point).position;
}

/// Evaluates all vertices, in one channel and without noise, to `value(position)`.
template <typename Value>
void store_everywhere(ShadingCache& cache, const Value& value) {
    for (std::uint32_t i = 0; i < cache.patches().size(); ++i) {
        const auto id = static_cast<PatchId>(i);
        for (int c = 0; c < cache.patch(id).corner_count(); ++c) {
            const VertexId vertex = cache.patch(id).corners[c];
            if (cache.evaluated(vertex, 0)) continue;
            cache.store(vertex, 0, value(corner_position(cache, id, c)), 0, 1, 1);
        }
    }
    cache.resolve();
}

inline void store_constant(ShadingCache& cache, Rgb value) {
    store_everywhere(cache, [&](Vec3) { return value; });
}
inline void store_random(ShadingCache& cache, Rng& rng) {
    store_everywhere(cache, [&](Vec3) {
        return Rgb(100 * rng.uniform(), 100 * rng.uniform(), 100 * rng.uniform());
    });
}

struct LeafPlace {
    PatchId leaf;
    Vec2 local;
};
/// From a place on a patch down to the leaf that holds it.
inline LeafPlace leaf_at(const ShadingCache& cache, PatchId id, Vec2 local) {
    while (!cache.patch(id).is_leaf()) {
        const Split split = cache.patch(id).split;
        const int child = child_at(split, local);
        local = to_child(split, child, local);
        id = offset_by(cache.patch(id).first_child, child);
    }
    return {id, local};
}

/// A uniform place on a quad or a triangle.
inline Vec2 random_place(bool quad, Rng& rng) {
    const Vec2 p(rng.uniform(), rng.uniform());
    return quad || p.x + p.y <= 1 ? p : Vec2(1) - p;
}

/// A map of one fragment a pixel in one row, at random places on `roots`, not attached yet.
inline IdMap random_map(const ShadingCache& cache, const std::vector<PatchId>& roots, int count,
                        Rng& rng) {
    IdMap map;
    map.width = count;
    map.height = 1;
    map.background = Image(count, 1);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        const PatchId root = roots[rng.below(static_cast<std::uint32_t>(roots.size()))];
        map.first_of_pixel.push_back(i);
        map.fragments.push_back({i, root, random_place(cache.patch(root).is_quad(), rng),
                                 Rgb(rng.uniform(), rng.uniform(), 1)});
    }
    map.first_of_pixel.push_back(static_cast<std::uint32_t>(count));
    return map;
}

/// What holds in any cache: links agree both ways, parents come first, no edge has two midpoints,
/// and each midpoint is found from the ends of its edge.
inline void expect_consistent(const ShadingCache& cache) {
    for (std::uint32_t i = 0; i < cache.patches().size(); ++i) {
        const auto id = static_cast<PatchId>(i);
        const Patch& patch = cache.patch(id);
        for (int c = 0; c < patch.corner_count(); ++c)
            ASSERT_LT(index_of(patch.corners[c]), cache.vertices().size());
        if (!patch.is_root()) {
            ASSERT_LT(patch.parent, i);
            const Patch& parent = cache.patches()[patch.parent];
            ASSERT_FALSE(parent.is_leaf());
            ASSERT_LT(cache.child_index(id), child_count(parent.split));
            EXPECT_EQ(patch.level, parent.level + 1);
            const auto nodes = child_corners(parent.split, cache.child_index(id));
            for (int c = 0; c < patch.corner_count(); ++c)
                if (nodes[c] < kFirstMidpoint) {
                    EXPECT_EQ(patch.corners[c], parent.corners[nodes[c]]);
                } else if (nodes[c] < kCentre) {
                    EXPECT_EQ(patch.corners[c],
                              cache.midpoint(parent.corners[nodes[c] - kFirstMidpoint],
                                             parent.corners[(nodes[c] - kFirstMidpoint + 1) %
                                                            parent.corner_count()]));
                }
        }
    }
    std::set<std::pair<VertexId, VertexId>> edges;
    for (std::uint32_t i = 0; i < cache.vertices().size(); ++i) {
        const CacheVertex& vertex = cache.vertices()[i];
        const Parents parents = cache.parents(static_cast<VertexId>(i));
        for (const VertexId parent : parents) EXPECT_LT(index_of(parent), i);
        if (vertex.of_mesh || parents.size() != 2) continue;
        EXPECT_TRUE(edges.insert(std::minmax(parents[0], parents[1])).second);
        EXPECT_EQ(cache.midpoint(parents[1], parents[0]), static_cast<VertexId>(i));
    }
}

}  // namespace chiaro::tiny
