#include "scene/path_animation.h"

#include "base/error.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace chiaro {
namespace {

// Quaternions go the shorter way, and turn evenly where an object that looks at a place does not:
// keys between those of the path leave no more than this of it to them.
constexpr int kParts = 16;

NodeId add_node(Scene& scene, SceneNode node) {
    scene.nodes.push_back(std::move(node));
    return static_cast<NodeId>(scene.nodes.size() - 1);
}

Vec4 as_vector(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

glm::quat looking(Vec3 eye, Vec3 target, Vec3 up) {
    const Vec3 back = glm::normalize(eye - target);
    const Vec3 right = glm::normalize(glm::cross(up, back));
    return glm::quat_cast(Mat3(right, glm::cross(back, right), back));
}

// Both channels of a node.
struct Way {
    AnimationChannel places, turns;
    explicit Way(NodeId node) {
        places.node = turns.node = node;
        turns.part = AnimatedPart::rotation;
    }
    void add(float time, Vec3 place, const glm::quat& turn) {
        places.times.push_back(time);
        places.values.emplace_back(place, 0);
        turns.times.push_back(time);
        turns.values.push_back(as_vector(turn));
    }
};

// Calls add(from, to, part) for the first key, then for kParts places up to each next one.
template <typename Key, typename Add>
void for_each_part(const std::vector<Key>& keys, const Add& add) {
    if (!keys.empty()) add(keys.front(), keys.front(), 0.0f);
    for (std::size_t i = 1; i < keys.size(); ++i)
        for (int part = 1; part <= kParts; ++part)
            add(keys[i - 1], keys[i], static_cast<float>(part) / kParts);
}

Way object_way(Scene& scene, const BuiltInPaths& paths) {
    const auto object = std::ranges::find(scene.objects, paths.object, &Object::name);
    check(object != scene.objects.end(), "add_path_animation: the scene lacks the object");
    const Vec3 centre = bounds(scene.mesh_of(*object), object->to_world).centre();
    SceneNode moving;
    moving.to_parent = Pose{.translation = centre};
    const NodeId node = add_node(scene, moving);
    SceneNode shown;
    shown.parent = node;
    shown.to_parent =
        glm::translate(glm::dmat4(1), -glm::dvec3(centre)) * glm::dmat4(object->to_world);
    shown.object = static_cast<ObjectId>(object - scene.objects.begin());
    add_node(scene, shown);

    Way way(node);
    for_each_part(paths.object_keys, [&](const ObjectKey& a, const ObjectKey& b, float part) {
        const float degrees = glm::mix(a.degrees, b.degrees, part);
        way.add(glm::mix(a.time, b.time, part), centre + glm::mix(a.translate, b.translate, part),
                glm::angleAxis(glm::radians(degrees), glm::normalize(b.axis)));
    });
    return way;
}

Way camera_way(Scene& scene, const BuiltInPaths& paths) {
    check(!scene.cameras.empty(), "add_path_animation: the scene lacks a camera");
    SceneNode node;
    node.camera = CameraId(0);
    Way way(add_node(scene, node));
    for_each_part(paths.camera, [&](const CameraKey& a, const CameraKey& b, float part) {
        const Vec3 eye = glm::mix(a.eye, b.eye, part), target = glm::mix(a.target, b.target, part);
        way.add(glm::mix(a.time, b.time, part), eye, looking(eye, target, scene.up));
    });
    return way;
}

}  // namespace

void add_path_animation(Scene& scene, const BuiltInPaths& paths) {
    Animation animation;
    animation.name = "path";
    for (Way way : std::array{object_way(scene, paths), camera_way(scene, paths)})
        for (AnimationChannel* channel : {&way.places, &way.turns}) {
            if (channel->times.empty()) continue;
            animation.duration = std::max(animation.duration, channel->times.back());
            animation.channels.push_back(std::move(*channel));
        }
    scene.animations.push_back(std::move(animation));
}

}  // namespace chiaro
