// Where edits put things.

#include "base/error.h"
#include "import/finish_scene.h"
#include "import/load_scene.h"
#include "import/resolve_edits.h"

#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {

glm::dmat4 EditResolver::Placement::matrix() const {
    const glm::dvec3 centre(box.centre());
    const glm::dmat4 there = glm::translate(glm::dmat4(1), centre + glm::dvec3(translate));
    return there * glm::dmat4(turn) * glm::dmat4(stretch) * glm::translate(glm::dmat4(1), -centre);
}

Box EditResolver::box_of(const NamedThings& things) const {
    Box box;
    for (const ObjectId id : things.objects) {
        const Object& object = objects_[index_of(id)];
        box.add(bounds(mesh_of(object), object.to_world));
    }
    if (things.objects.empty())
        for (const LightId id : things.lights) box.add(lights_in_file_[index_of(id)].position);
    return box;
}

EditResolver::Placement& EditResolver::placement_of(const std::string& name,
                                                    const NamedThings& things) {
    const auto [known, fresh] = placements_.try_emplace(name);
    if (fresh) known->second.box = box_of(things);
    return known->second;
}

void EditResolver::change(const PlaceChange& edit, Placement& placement) {
    if (edit.translate) placement.translate = *edit.translate;
    if (edit.rotate)
        placement.turn = Mat3(glm::rotate(glm::dmat4(1), glm::radians(double(edit.rotate->w)),
                                          glm::normalize(glm::dvec3(Vec3(*edit.rotate)))));
    if (edit.scale) placement.stretch = Mat3(*edit.scale);
}

std::vector<Edit> EditResolver::placed(const NamedThings& things, const Placement& placement) {
    const glm::dmat4 m = placement.matrix();
    check_reach(m, placement.box);
    std::vector<Edit> edits;
    for (const ObjectId id : things.objects) {
        const Mat4 to_world(m * glm::dmat4(objects_[index_of(id)].to_world));
        if (scaled_to_nothing(to_world)) throw Error(where_, "scales an object to nothing");
        edits.emplace_back(SetTransform{id, to_world});
    }
    for (const LightId id : things.lights) {
        const PunctualLight& before = lights_in_file_[index_of(id)];
        PunctualLight& light = lights_[index_of(id)];
        light.position = Vec3(m * glm::dvec4(before.position, 1));
        light.direction = Vec3(glm::normalize(glm::dmat3(m) * glm::dvec3(before.direction)));
        edits.emplace_back(SetLight{id, light});
    }
    return edits;
}

// The corners of a box go farther than what is in it.
void EditResolver::check_reach(const glm::dmat4& m, const Box& box) const {
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                i & 4 ? box.high.z : box.low.z);
        if (!within_reach(Vec3(m * glm::dvec4(corner, 1))))
            throw Error(where_, "moves something beyond 1e9");
    }
}

}  // namespace chiaro
