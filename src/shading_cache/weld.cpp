#include "shading_cache/weld.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "scene/bicubic_mesh.h"
#include "scene/surface.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

namespace chiaro {
namespace {

// Corners are one vertex where their normals are within this of each other. Faces without normals
// of their own are flat, as the file says, and stay apart at any visible crease.
constexpr float kSmoothCosine = 0.9613f;  // 16 degrees
constexpr float kFlatCosine = 0.9998f;    // 1 degree

// What one body of a parallel loop does at once.
constexpr std::size_t kRange = 16384;

constexpr std::uint32_t kNone = 0xffff'ffff;

// A point of the mesh on its way to the shard of points that can be in the same place.
struct PlacedPoint {
    std::array<std::uint32_t, 3> position;  // bits
    std::uint32_t point;
};

PlacedPoint placed(const Mesh& mesh, std::size_t point) {
    const Vec3 p = mesh.positions[point] + 0.0f;  // -0 becomes 0
    return {{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
             std::bit_cast<std::uint32_t>(p.z)},
            static_cast<std::uint32_t>(point)};
}
std::uint32_t hash_of(const PlacedPoint& p) {
    return hash32(hash32(p.position[0], p.position[1]), p.position[2]);
}

// Points cut into shards by the high bits of their hash, in order within each: a table over one
// shard stays in the cache.
struct Shards {
    std::vector<PlacedPoint> points;
    std::vector<std::size_t> first;  // of each shard, and the end of the last
};

Shards cut_into_shards(const Mesh& mesh, int threads) {
    const std::size_t count = mesh.positions.size();
    const int bits = std::min(static_cast<int>(std::bit_width(count / 8192)), 11);
    const std::size_t shards = std::size_t{1} << bits;
    const std::size_t range = std::max(kRange, 8 * shards);
    const auto shard_of = [&](const PlacedPoint& p) {
        return static_cast<std::size_t>(static_cast<std::uint64_t>(hash_of(p)) << bits >> 32);
    };

    // How many points each range sends to each shard, and then where it puts them.
    std::vector<std::size_t> places((count + range - 1) / range * shards);
    parallel_for_ranges(threads, count, range, [&](IndexRange r) {
        for (std::size_t i = r.begin; i < r.end; ++i)
            ++places[r.number * shards + shard_of(placed(mesh, i))];
    });
    Shards result;
    std::size_t sum = 0;
    for (std::size_t s = 0; s < shards; ++s) {
        result.first.push_back(sum);
        for (std::size_t i = s; i < places.size(); i += shards)
            sum += std::exchange(places[i], sum);
    }
    result.first.push_back(sum);
    result.points.resize(count);
    parallel_for_ranges(threads, count, range, [&](IndexRange r) {
        for (std::size_t i = r.begin; i < r.end; ++i) {
            const PlacedPoint p = placed(mesh, i);
            result.points[places[r.number * shards + shard_of(p)]++] = p;
        }
    });
    return result;
}

// For each point the first one in the same place.
std::vector<std::uint32_t> find_places(const Mesh& mesh, int threads) {
    const Shards shards = cut_into_shards(mesh, threads);
    std::vector<std::uint32_t> first_in_place(mesh.positions.size());
    parallel_for(threads, shards.first.size() - 1, [&](std::size_t s) {
        const std::span points =
            std::span(shards.points)
                .subspan(shards.first[s], shards.first[s + 1] - shards.first[s]);
        const std::size_t slots = std::bit_ceil(points.size() + points.size() / 2 + 1);
        std::vector<std::uint32_t> table(slots, kNone);  // of positions in `points`
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            std::size_t slot = hash_of(points[i]) & (slots - 1);
            while (table[slot] != kNone && points[table[slot]].position != points[i].position)
                slot = (slot + 1) & (slots - 1);
            if (table[slot] == kNone) table[slot] = i;
            first_in_place[points[i].point] = points[table[slot]].point;
        }
    });
    return first_in_place;
}

// The corners in each place, in order.
struct CornersOfPlaces {
    std::vector<std::uint32_t> first;  // by place, which is its first point's index; and the end
    std::vector<std::uint32_t> corners;
};

CornersOfPlaces gather_corners(const Mesh& mesh, int threads) {
    const std::vector<std::uint32_t> place_of_point = find_places(mesh, threads);
    CornersOfPlaces result;
    result.first.resize(mesh.positions.size() + 1);
    result.corners.resize(corner_count(mesh));
    const auto for_corners = [&](const auto& body) {
        parallel_for_ranges(threads, mesh.primitives.size(), kRange, [&](IndexRange r) {
            for (std::size_t i = r.begin; i < r.end; ++i) {
                const Primitive& p = mesh.primitives[i];
                const std::uint32_t index = corner_index(mesh, {static_cast<std::uint32_t>(i), 0});
                for (int c = 0; c < p.corner_count(); ++c) {
                    std::uint32_t& cursor = result.first[place_of_point[p.corners[c]]];
                    body(std::atomic_ref(cursor), index + static_cast<std::uint32_t>(c));
                }
            }
        });
    };

    // Counts become the ends of lists, and filling the lists backward moves these to their starts.
    for_corners([](std::atomic_ref<std::uint32_t> cursor, std::uint32_t) {
        cursor.fetch_add(1, std::memory_order_relaxed);
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& entry : result.first) entry = sum += entry;
    for_corners([&](std::atomic_ref<std::uint32_t> cursor, std::uint32_t corner) {
        result.corners[cursor.fetch_sub(1, std::memory_order_relaxed) - 1] = corner;
    });

    // Threads have filled a list in any order.
    parallel_for_ranges(threads, mesh.positions.size(), kRange, [&](IndexRange r) {
        for (std::size_t i = r.begin; i < r.end; ++i)
            std::sort(result.corners.begin() + result.first[i],
                      result.corners.begin() + result.first[i + 1]);
    });
    return result;
}

// A vertex among those in one place, numbered within its range of places.
struct VertexInPlace {
    std::uint32_t number;
    MaterialId material;
    Vec3 normal;
};

// Welds the corners in one place; `known` is scratch. Appends the first corners of new vertices.
void weld_place(const Mesh& mesh, std::span<const std::uint32_t> corners,
                std::vector<VertexInPlace>& known, std::vector<std::uint32_t>& corner_of_vertex,
                std::vector<std::uint32_t>& vertex_of_corner) {
    const float cosine =
        mesh.normals.empty() && mesh.bicubics.empty() ? kFlatCosine : kSmoothCosine;
    known.clear();
    for (const std::uint32_t index : corners) {
        const MeshCorner corner = corner_at(mesh, index);
        const MaterialId material = mesh.primitives[corner.primitive].material;
        const Vec3 normal = corner_normal(mesh, corner);
        auto same = std::find_if(known.begin(), known.end(), [&](const VertexInPlace& v) {
            return v.material == material && glm::dot(v.normal, normal) >= cosine;
        });
        if (same == known.end()) {
            known.push_back(
                {static_cast<std::uint32_t>(corner_of_vertex.size()), material, normal});
            corner_of_vertex.push_back(index);
            same = known.end() - 1;
        }
        vertex_of_corner[index] = same->number;
    }
}

// Along the geometric normal at a corner, on the front side.
Vec3 corner_cross(const Mesh& mesh, const Primitive& p, int corner) {
    if (p.is_quad()) {
        const float past_diagonal = corner == 2 ? 1.0f : 0.0f;
        return front_cross(mesh, p, corner_weights(true, past_diagonal, past_diagonal));
    }
    const Vec3 origin = mesh.positions[p.corners[0]];
    return glm::cross(mesh.positions[p.corners[1]] - origin, mesh.positions[p.corners[2]] - origin);
}

}  // namespace

Weld weld_corners(const Mesh& mesh, int threads) {
    check(corner_count(mesh) < kNone, "weld_corners: more corners than ids");
    const CornersOfPlaces places = gather_corners(mesh, threads);
    const std::size_t count = mesh.positions.size();
    std::vector<std::vector<std::uint32_t>> made((count + kRange - 1) / kRange);  // by range
    Weld weld;
    weld.vertex_of_corner.resize(places.corners.size());
    parallel_for_ranges(threads, count, kRange, [&](IndexRange r) {
        std::vector<VertexInPlace> known;
        for (std::size_t i = r.begin; i < r.end; ++i)
            weld_place(mesh,
                       std::span(places.corners)
                           .subspan(places.first[i], places.first[i + 1] - places.first[i]),
                       known, made[r.number], weld.vertex_of_corner);
    });

    // Ranges are put one after the other.
    std::vector<std::uint32_t> first_vertex;
    std::uint32_t sum = 0;
    for (const auto& corners : made) {
        first_vertex.push_back(sum);
        sum += static_cast<std::uint32_t>(corners.size());
    }
    weld.corner_of_vertex.resize(sum);
    parallel_for_ranges(threads, count, kRange, [&](IndexRange r) {
        const std::uint32_t first = first_vertex[r.number];
        std::ranges::copy(made[r.number], weld.corner_of_vertex.begin() + first);
        for (std::size_t i = places.first[r.begin]; i < places.first[r.end]; ++i)
            weld.vertex_of_corner[places.corners[i]] += first;
    });
    return weld;
}

Vec3 corner_normal(const Mesh& mesh, MeshCorner corner) {
    const Primitive& p = mesh.primitives[corner.primitive];
    if (is_bicubic(mesh, corner.primitive))
        return patch_normal(mesh.bicubics[corner.primitive], patch_corner(corner.corner));
    const Vec3 cross = corner_cross(mesh, p, corner.corner);
    if (mesh.normals.empty()) return safe_normalize(cross, Vec3(0, 0, 1));
    const Vec3 normal = mesh.normals[p.corners[corner.corner]];
    const float side = glm::dot(normal, cross);
    if (side == 0) return safe_normalize(cross, Vec3(0, 0, 1));
    return safe_normalize(side < 0 ? -normal : normal, Vec3(0, 0, 1));
}

}  // namespace chiaro
