#include "update/eye_track.h"

#include "base/error.h"

#include <algorithm>

namespace chiaro {

void EyeTrack::move_to(Vec3 eye, Cycle now) {
    if (!places_.empty() && places_.back().from == now) places_.pop_back();
    places_.push_back({now, eye});
    // The first one of the rest is where the eye was as many cycles ago as estimates tell.
    while (places_.size() > 1 && places_[1].from + Estimate::kCycleMask <= now) places_.pop_front();
}

Vec3 EyeTrack::at(const Estimate& estimate, Cycle now) const {
    check(!places_.empty(), "EyeTrack: the eye has been nowhere yet");
    const Cycle age = (now - estimate.shaded_at) & Estimate::kCycleMask;
    const Cycle cycle = age > now ? 0 : now - age;
    const auto after = std::ranges::upper_bound(places_, cycle, {}, &Place::from);
    return after == places_.begin() ? after->eye : std::prev(after)->eye;
}

}  // namespace chiaro
