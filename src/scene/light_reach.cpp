#include "scene/light_reach.h"

#include "scene/environment.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chiaro {
namespace {

// The part of the way from `origin` along `direction` that lies in the box grown by `margin` on all
// sides, as [first, second]; empty if first > second. The way goes from 0 to `last`.
std::pair<float, float> within(Vec3 origin, Vec3 direction, float last, const Box& box,
                               Vec3 margin) {
    float from = 0, to = last;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = box.low[axis] - margin[axis] - origin[axis];
        const float high = box.high[axis] + margin[axis] - origin[axis];
        if (direction[axis] == 0) {
            if (low > 0 || high < 0) return {1, 0};
            continue;
        }
        const float a = low / direction[axis], b = high / direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return {from, to};
}

// True unless no segment from `point` to the light's box meets `box`. At the part t of the way
// these segments fill a box of t times the light's size. So `box`, grown by that of the last t at
// which they can still be in it, is met by the segment to the light's centre, or by none; and a
// smaller last t makes the box smaller in turn.
bool may_cross_toward(Vec3 point, Vec3 centre, Vec3 extent, const Box& box) {
    constexpr int kRounds = 3;
    float last = 1;
    for (int round = 0; round < kRounds; ++round) {
        const auto [from, to] = within(point, centre - point, last, box, last * extent);
        if (from > to) return false;
        last = to;
    }
    return true;
}

}  // namespace

LightReach::LightReach(const Scene& scene) : everywhere_(!is_dark(scene.environment)) {
    for (const PunctualLight& light : scene.lights) {
        if (!light.lit()) continue;
        if (light.kind == LightKind::directional)
            suns_.push_back(-light.direction);
        else
            places_.push_back({light.position, Vec3(0)});
    }
    for (const Object& object : scene.objects) {
        if (!emits(scene, object)) continue;
        const Box box = bounds(scene.mesh_of(object), object.to_world);
        places_.push_back({0.5f * (box.low + box.high), 0.5f * (box.high - box.low)});
    }
}

bool LightReach::may_cross(Vec3 point, const Box& box) const {
    if (everywhere_) return true;
    for (const Place& place : places_)
        if (may_cross_toward(point, place.centre, place.extent, box)) return true;
    for (const Vec3 sun : suns_)
        if (const auto [from, to] = within(point, sun, kInfinity, box, Vec3(0)); from <= to)
            return true;
    return false;
}

}  // namespace chiaro
