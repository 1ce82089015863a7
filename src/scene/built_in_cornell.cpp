// The Cornell box (Goral et al. 1984) with the coordinates that Cornell University published for
// its comparison with photographs, divided by 100. Its published coordinates are not mirrored: x
// runs to the left as the camera sees it, and the red wall is on the left.

#include "scene/built_in.h"

namespace chiaro {
namespace {

using Corners = std::array<Vec3, 4>;  // counter-clockwise from the front

struct Part {
    const char* name;
    MaterialId material;
    std::vector<Corners> quads;
};

constexpr MaterialId kWhite{0};
constexpr MaterialId kGreen{1};
constexpr MaterialId kRed{2};
constexpr MaterialId kLight{3};

std::vector<Material> materials() {
    return {{.name = "white", .base_color = {0.725f, 0.71f, 0.68f}},
            {.name = "green", .base_color = {0.14f, 0.45f, 0.091f}},
            {.name = "red", .base_color = {0.63f, 0.065f, 0.05f}},
            {.name = "light", .base_color = Rgb(0), .emission = {17, 12, 4}}};
}

// A block: its top, counter-clockwise from above, and the walls under each of the top's edges. It
// has no bottom, as it stands on the floor.
std::vector<Corners> block(const Corners& top, const std::array<int, 4>& wall_order) {
    std::vector<Corners> quads = {top};
    for (const int i : wall_order) {
        // Walls are published from their lower corner below the edge's end.
        const Vec3 from = top[(i + 1) % 4];
        const Vec3 to = top[i];
        quads.push_back({Vec3(from.x, 0, from.z), from, to, Vec3(to.x, 0, to.z)});
    }
    return quads;
}

std::vector<Part> parts() {
    const Corners short_top = {
        {{1.3f, 1.65f, 0.65f}, {0.82f, 1.65f, 2.25f}, {2.4f, 1.65f, 2.72f}, {2.9f, 1.65f, 1.14f}}};
    const Corners tall_top = {
        {{4.23f, 3.3f, 2.47f}, {2.65f, 3.3f, 2.96f}, {3.14f, 3.3f, 4.56f}, {4.72f, 3.3f, 4.06f}}};
    return {
        {"floor", kWhite, {{{{5.528f, 0, 0}, {0, 0, 0}, {0, 0, 5.592f}, {5.496f, 0, 5.592f}}}}},
        {"ceiling",
         kWhite,
         {{{{5.56f, 5.488f, 0}, {5.56f, 5.488f, 5.592f}, {0, 5.488f, 5.592f}, {0, 5.488f, 0}}}}},
        {"back wall",
         kWhite,
         {{{{5.496f, 0, 5.592f}, {0, 0, 5.592f}, {0, 5.488f, 5.592f}, {5.56f, 5.488f, 5.592f}}}}},
        {"short block", kWhite, block(short_top, {2, 3, 0, 1})},
        {"tall block", kWhite, block(tall_top, {3, 2, 1, 0})},
        {"green wall",
         kGreen,
         {{{{0, 0, 5.592f}, {0, 0, 0}, {0, 5.488f, 0}, {0, 5.488f, 5.592f}}}}},
        {"red wall",
         kRed,
         {{{{5.528f, 0, 0}, {5.496f, 0, 5.592f}, {5.56f, 5.488f, 5.592f}, {5.56f, 5.488f, 0}}}}},
        {"lamp",
         kLight,
         {{{{3.43f, 5.483f, 2.27f},
            {3.43f, 5.483f, 3.32f},
            {2.13f, 5.483f, 3.32f},
            {2.13f, 5.483f, 2.27f}}}}},
    };
}

// Without normals: each quad is as flat as its published corners make it (the red wall is not
// quite).
Mesh flat_mesh(const Part& part) {
    Mesh mesh = {.name = part.name};
    for (const Corners& corners : part.quads) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
        mesh.primitives.push_back(
            {.corners = {first, first + 1, first + 2, first + 3}, .material = part.material});
    }
    order_primitives(mesh);
    return mesh;
}

}  // namespace

Scene make_cornell_box() {
    Scene scene;
    scene.materials = materials();
    for (const Part& part : parts()) {
        scene.objects.push_back(
            {.name = part.name, .mesh = static_cast<MeshId>(scene.meshes.size())});
        scene.meshes.push_back(flat_mesh(part));
    }
    scene.cameras = {{.name = "main",
                      .eye = {2.78f, 2.73f, -8},
                      .target = {2.78f, 2.73f, 0},
                      .up = {0, 1, 0},
                      .vertical_fov = 39.3076481f}};
    check_scene(scene);
    return scene;
}

}  // namespace chiaro
