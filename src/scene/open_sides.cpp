#include "scene/open_sides.h"

#include "base/error.h"

namespace chiaro {

OpenSides::OpenSides(const Scene& scene) {
    add_objects(scene);
}

void OpenSides::add_objects(const Scene& scene) {
    const std::size_t first = objects_.size();
    objects_.resize(scene.objects.size());
    for (std::size_t i = first; i < scene.objects.size(); ++i)
        if (scene.objects[i].mesh != MeshId::none)
            objects_[i].sides.resize(scene.mesh_of(scene.objects[i]).primitives.size());
}

void OpenSides::mark(ObjectId object, std::uint32_t primitive, bool front) {
    check(index_of(object) < objects_.size(), "OpenSides: unknown object");
    Marks& marks = objects_[index_of(object)];
    check(primitive < marks.sides.size(), "OpenSides: unknown primitive");
    std::uint8_t& sides = marks.sides[primitive];
    const auto now = static_cast<std::uint8_t>(sides | (front ? kFront : kBack));
    if (now == sides) return;
    if (sides != 0) --marks.counts[sides];
    ++marks.counts[now];
    sides = now;
}

bool OpenSides::is_inside(ObjectId object, std::uint32_t primitive, bool front_hit) const {
    const Marks& marks = objects_[index_of(object)];
    const std::uint8_t met = front_hit ? kFront : kBack;
    const std::uint8_t other = front_hit ? kBack : kFront;
    if ((marks.sides[primitive] & met) != 0) return false;

    // Where the object's faces agree, one that disagrees was seen through a gap, and proves
    // nothing.
    const std::uint64_t marked = marks.counts[kFront] + marks.counts[kBack] + marks.counts[3];
    if (marked > 0 && std::uint64_t{10} * marks.counts[met] >= 9 * marked) return false;
    if (marked > 0 && std::uint64_t{10} * marks.counts[other] >= 9 * marked) return true;
    return (marks.sides[primitive] & other) != 0;
}

}  // namespace chiaro
