// Walks through a scene that advance together, as the paths of path_wave.h do: from the eye's end
// and from lights alike.
#pragma once

#include "sample_renderer/emitters.h"
#include "sample_renderer/path_vertex.h"

#include <functional>

namespace chiaro {

/// A walk on its way from one vertex to the next; its ray and hit stand at the same place in the
/// wave's arrays.
struct Walk {
    Rgb throughput;         // after the scattering
    float pdf;              // of the ray's direction over solid angle
    Trail trail;            // as going_on() makes it
    Vec3 position, normal;  // of the vertex, or of the light; the real plane's, or 0
    bool parallel = false;  // from infinitely far: `pdf` is over area across the ray
    Transport transport = Transport::radiance;
    const Emission* emission = nullptr;  // that it begins with, on its first edge
    std::uint32_t sample = 0;            // which sample of the wave it belongs to
    std::uint32_t key = 0;               // names its random numbers
    std::uint32_t steps = 0;             // that it took, panes passed included
    std::uint32_t vertices = 1;          // that it has, its start included
};

struct WalkWave {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Walk> walks;

    void clear();
    void add(const Ray& ray, const Walk& walk);
    /// Hits of all rays.
    void cast(const RayCaster& caster);
};

/// The vertex where a walk's ray met a surface.
PathVertex arrive(const LitScene& lit, const Walk& walk, const Ray& ray, const Hit& hit,
                  const MetSurface& surface);

/// Its trail where it left the scene along `direction`, for what shines there.
Trail trail_at_sky(const Walk& walk, Vec3 direction);

/// What a walk met, before it is scattered there.
struct WalkMeeting {
    const Walk& walk;
    const Ray& ray;
    const Hit& hit;
    const MetSurface& surface;
    const PathVertex& vertex;
};
/// Called with the walk's numbers at the place: those that are taken are taken before its own.
using MeetsVertex = std::function<void(const WalkMeeting&, BounceNumbers&)>;

/// Called for a walk that left the scene.
using LeavesScene = std::function<void(const Walk&, const Ray&)>;

/// Follows all walks to their ends, at what the wave's rays have hit to begin with: calls
/// `meets` at every surface, `leaves` at the end of those that leave the scene. Russian roulette as
/// of paths, no other bound on their length. A walk that passes a smooth pane straight on is still
/// on the same edge.
void follow_walks(const LitScene& lit, WalkWave& wave, const MeetsVertex& meets,
                  const LeavesScene& leaves);

/// The walk from the eye's end along a direction of density cosine / pi that `u`, in [0, 1)^2,
/// maps to.
std::optional<Walk> walk_from_eye(const PathVertex& end, Vec2 u, Ray& ray);

/// The walk that an emission begins, which must outlive its first edge.
Walk walk_from_light(const Emission& emission);

}  // namespace chiaro
