#include "scene/built_in_paths.h"

namespace chiaro {
namespace {

constexpr Vec3 kUp(0, 1, 0);

// From the door past the sofa to the tea on the table, while the lamp glides under the ceiling.
BuiltInPaths room_paths() {
    return {.camera = {{0, {0.35f, 1.6f, 4.5f}, {3.45f, 0.85f, 1.6f}},
                       {4, {1.6f, 1.5f, 4.1f}, {4, 0.8f, 2.2f}},
                       {7, {2.8f, 1.35f, 4.2f}, {4.5f, 0.75f, 3}},
                       {10, {3.85f, 1.1f, 4.1f}, {4.42f, 0.78f, 3.2f}}},
            .object = "Ceiling lamp",
            .object_keys = {{0, Vec3(0), kUp, 0},
                            {3, {1.6f, 0, 0.9f}, kUp, 0},
                            {7, {-1.5f, 0, 0.6f}, kUp, 45},
                            {10, Vec3(0), kUp, 0}}};
}

// The chair goes round the rug: toward the sculpture, back, and along the right wall.
BuiltInPaths indirect_paths() {
    return {.camera = {{0, {5.3f, 1.5f, 4.75f}, {3.95f, 1.15f, 1}},
                       {5, {4.1f, 1.45f, 4.4f}, {4.5f, 1, 1}},
                       {11, {3.7f, 1.4f, 3.7f}, {5.2f, 0.8f, 1.1f}}},
            .object = "Chair",
            .object_keys = {{0, Vec3(0), kUp, 0},
                            {3, {-1.35f, 0, 0.05f}, kUp, 55},
                            {6, {0.1f, 0, 0}, kUp, -5},
                            {9, {0.4f, 0, 1.5f}, kUp, -50},
                            {11, {0.3f, 0, 0.4f}, kUp, -20}}};
}

// The cue ball rolls toward the others and back; the camera comes down to the cloth and goes round.
BuiltInPaths poolhall_paths() {
    constexpr float kRolled = 648;  // degrees: the way over a ball's radius
    constexpr Vec3 kRollAxis(-0.928f, 0, 0.371f);
    return {.camera = {{0, {6.1f, 1.27f, 6.8f}, {5.36f, 0.89f, 4.7f}},
                       {3, {4.75f, 1.2f, 6.1f}, {5.5f, 0.79f, 5.1f}},
                       {5.5f, {4.5f, 1.1f, 5}, {5.48f, 0.79f, 5.03f}},
                       {8, {5.15f, 1.08f, 4}, {5.48f, 0.79f, 5}},
                       {10, {6.35f, 1.12f, 4.5f}, {5.5f, 0.79f, 5.05f}},
                       {12, {6.2f, 1.25f, 6.1f}, {5.52f, 0.79f, 5.1f}}},
            .object = "Cue ball",
            .object_keys = {{0, Vec3(0), kRollAxis, 0},
                            {4, {-0.12f, 0, -0.3f}, kRollAxis, kRolled},
                            {8, Vec3(0), kRollAxis, 0},
                            {12, {-0.12f, 0, -0.3f}, kRollAxis, kRolled}}};
}

}  // namespace

std::optional<BuiltInPaths> built_in_paths(std::string_view name) {
    if (name == "room") return room_paths();
    if (name == "indirect") return indirect_paths();
    if (name == "poolhall") return poolhall_paths();
    return std::nullopt;
}

}  // namespace chiaro
