#include "scene/animate.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// What is scaled less is scaled so: a singular transform is no place.
constexpr double kLeastScale = 1e-4;

void set_part(Pose& pose, AnimatedPart part, Vec4 value) {
    switch (part) {
        case AnimatedPart::translation:
            pose.translation = Vec3(value);
            return;
        case AnimatedPart::rotation:
            // A spline may pass through zero.
            if (glm::dot(value, value) > 0)
                pose.rotation = glm::dquat(value.w, value.x, value.y, value.z);
            return;
        case AnimatedPart::scale:
            for (int axis = 0; axis < 3; ++axis)
                pose.scale[axis] = std::copysign(
                    std::max(std::abs(double(value[axis])), kLeastScale), double(value[axis]));
    }
}

// A node's way to its parent, and whether it is animated.
struct Way {
    glm::dmat4 to_parent;
    bool animated = false;
};

std::vector<Way> ways_at(const Scene& scene, const Animation& animation, float seconds) {
    std::vector<Pose> poses(scene.nodes.size());
    std::vector<Way> ways(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (const Pose* pose = std::get_if<Pose>(&scene.nodes[i].to_parent)) poses[i] = *pose;
    for (const AnimationChannel& channel : animation.channels) {
        check(index_of(channel.node) < scene.nodes.size(), "animate: node out of range");
        set_part(poses[index_of(channel.node)], channel.part, value_at(channel, seconds));
        ways[index_of(channel.node)].animated = true;
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const glm::dmat4* matrix = std::get_if<glm::dmat4>(&scene.nodes[i].to_parent);
        ways[i].to_parent = matrix != nullptr ? *matrix : matrix_of(poses[i]);
    }
    return ways;
}

// A place that rays can follow.
bool usable(const glm::dmat4& to_world) {
    constexpr double kFarthest = 1e9, kMostInverse = 1e8;
    const glm::dmat3 back = glm::inverse(glm::dmat3(to_world));
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) {
            if (!(std::abs(to_world[column][row]) <= kFarthest)) return false;
            if (column < 3 && !(std::abs(back[column][row]) <= kMostInverse)) return false;
        }
    return true;
}

void add_edits(const Scene& scene, const SceneNode& node, const Mat4& to_world,
               std::vector<Edit>& edits) {
    if (node.object != ObjectId::none) edits.emplace_back(SetTransform{node.object, to_world});
    if (node.light != LightId::none) {
        PunctualLight light = scene.lights[index_of(node.light)];
        if (place_light(to_world, light)) edits.emplace_back(SetLight{node.light, light});
    }
    if (node.camera != CameraId::none) {
        Camera camera = scene.cameras[index_of(node.camera)];
        if (place_camera(to_world, camera)) edits.push_back(SetCamera{camera});
    }
}

}  // namespace

std::vector<Edit> animate(const Scene& scene, const Animation& animation, double seconds) {
    const double length = double(animation.duration);
    double within = length > 0 ? std::fmod(seconds, length) : 0;
    if (within < 0) within += length;
    std::vector<Way> ways = ways_at(scene, animation, static_cast<float>(within));

    // Parents come before their children: to_parent becomes the way to the world.
    std::vector<Edit> edits;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        const bool root = node.parent == NodeId::none;
        check(root || index_of(node.parent) < i, "animate: a node comes before its parent");
        const Way above =
            root ? Way{glm::dmat4(scene.nodes_to_world)} : ways[index_of(node.parent)];
        ways[i] = {above.to_parent * ways[i].to_parent, above.animated || ways[i].animated};
        if (ways[i].animated && usable(ways[i].to_parent))
            add_edits(scene, node, Mat4(ways[i].to_parent), edits);
    }
    return edits;
}

bool place_camera(const Mat4& to_world, Camera& camera) {
    const Vec3 forward = -Vec3(to_world[2]), up = Vec3(to_world[1]);
    if (!(glm::length(forward) > 0) || !(glm::length(glm::cross(forward, up)) > 0)) return false;
    camera.eye = Vec3(to_world[3]);
    // Far from the origin a unit is lost in rounding.
    const float distance = std::max(1.0f, 1e-3f * glm::length(camera.eye));
    camera.target = camera.eye + distance * glm::normalize(forward);
    camera.up = glm::normalize(up);
    return true;
}

bool place_light(const Mat4& to_world, PunctualLight& light) {
    const Vec3 direction = -Vec3(to_world[2]);
    if (light.kind != LightKind::point) {
        if (!(glm::length(direction) > 0)) return false;
        light.direction = glm::normalize(direction);
    }
    light.position = Vec3(to_world[3]);
    return true;
}

}  // namespace chiaro
