// Rays to cast.
#pragma once

#include "base/random.h"
#include "rays/ray_caster.h"
#include "sample_renderer/tiny_scenes.h"

#include <cmath>
#include <vector>

namespace chiaro::tiny {

inline Vec3 random_direction(Rng& rng) {
    const float z = 2 * rng.uniform() - 1;
    const float phi = 2 * kPi * rng.uniform();
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

inline Hit cast(const RayCaster& caster, const Ray& ray, RayKind kind = RayKind::transport) {
    Hit hit;
    caster.intersect({&ray, 1}, {&hit, 1}, kind);
    return hit;
}

inline std::vector<Ray> random_rays(std::size_t count, Vec3 origin) {
    Rng rng(5);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) ray = {origin, random_direction(rng)};
    return rays;
}

}  // namespace chiaro::tiny
