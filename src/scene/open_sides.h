// Which sides of surfaces are known to face open space. A file's winding is not to be trusted, so a
// side counts as the outside only once it was seen from a place that is known to be good; where a
// ray then meets the other side, it started inside a solid.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace chiaro {

/// Thread: marks on one thread while nobody reads; reads from any number.
class OpenSides {
public:
    /// Nothing is known yet of any object of `scene`, which is not kept.
    explicit OpenSides(const Scene& scene);

    /// Nor of those that were appended to the scene since. Not while others read.
    void add_objects(const Scene& scene);

    /// The front (or back) of the primitive was seen from a good place.
    void mark(ObjectId object, std::uint32_t primitive, bool front);

    /// True if whoever meets this side is inside a solid: the side is not known to be open, and at
    /// least 90 % of the object's marked primitives are open on the other side only; or, where the
    /// object's primitives do not agree like that, this one is open on the other side.
    bool is_inside(ObjectId object, std::uint32_t primitive, bool front_hit) const;

private:
    static constexpr std::uint8_t kFront = 1;
    static constexpr std::uint8_t kBack = 2;

    // A byte a primitive, and how many of them hold each of the four combinations of marks.
    struct Marks {
        std::vector<std::uint8_t> sides;
        std::uint32_t counts[4] = {};
    };
    std::vector<Marks> objects_;
};

}  // namespace chiaro
