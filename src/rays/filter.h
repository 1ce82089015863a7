// What see-through materials let pass, asked by Embree at every possible hit.
#pragma once

#include "rays/ray_caster.h"

#include <embree3/rtcore.h>

namespace chiaro {

/// Embree's context of a cast, followed by what our filter reads; Embree hands it through by
/// address.
struct CastContext {
    RTCIntersectContext embree;
    std::span<const Ray> rays;  // a packet lane's id is its place here
    RayKind kind;
};

/// Drops the hits that `kind` of the CastContext says to pass through; user data is a FilterData.
void see_through_filter(const RTCFilterFunctionNArguments* arguments);

}  // namespace chiaro
