#include "furnished_box.h"

#include "base/random.h"
#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace chiaro {
namespace {

constexpr Vec3 kRoom(6, 3, 5);
constexpr int kPaints = 12;
constexpr MaterialId kLamp{kPaints};
constexpr std::uint32_t kSeed = 7;

// From the unit square to the faces of the cube [-1, 1]^3, seen from outside.
Vec3 on_cube(int face, Vec2 uv) {
    const Vec2 p = 2.0f * uv - 1.0f;
    switch (face) {
        case 0:
            return {1, p.x, p.y};
        case 1:
            return {-1, p.y, p.x};
        case 2:
            return {p.y, 1, p.x};
        case 3:
            return {p.x, -1, p.y};
        case 4:
            return {p.x, p.y, 1};
        default:
            return {p.y, p.x, -1};
    }
}

// A cube of n x n quads a face, each corner moved by `shape`; flat, without normals.
Mesh subdivided_cube(int n, MaterialId material, const std::function<Vec3(Vec3)>& shape) {
    Mesh mesh;
    const auto row = static_cast<std::uint32_t>(n + 1);
    for (int face = 0; face < 6; ++face) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i)
                mesh.positions.push_back(shape(on_cube(face, Vec2(i, j) / static_cast<float>(n))));
        for (std::uint32_t j = 0; j + 1 < row; ++j)
            for (std::uint32_t i = 0; i + 1 < row; ++i) {
                const std::uint32_t at = first + j * row + i;
                mesh.primitives.push_back({{at, at + 1, at + row + 1, at + row}, material});
            }
    }
    order_primitives(mesh);
    return mesh;
}

// Quads along each edge of a cube of about `quads` quads.
int across_face(int quads) {
    const float across = std::sqrt(static_cast<float>(std::max(0, quads)) / 6);
    return std::max(1, static_cast<int>(std::lround(across)));
}

void add_materials(Scene& scene, Rng& rng) {
    for (int i = 0; i < kPaints; ++i) {
        Material paint;
        for (int c = 0; c < 3; ++c) paint.base_color[c] = 0.3f + 0.5f * rng.uniform();
        scene.materials.push_back(paint);
    }
    Material lamp;
    lamp.base_color = Rgb(0.3f);
    lamp.emission = Rgb(3000);
    scene.materials.push_back(lamp);
}

void add_object(Scene& scene, Mesh mesh, const Mat4& to_world = Mat4(1)) {
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(
        {.mesh = static_cast<MeshId>(scene.meshes.size() - 1), .to_world = to_world});
}

void add_shell(Scene& scene) {
    const auto inside_out = [](Vec3 p) { return 0.5f * (Vec3(-p.x, p.y, p.z) + 1.0f) * kRoom; };
    add_object(scene, subdivided_cube(4, MaterialId{0}, inside_out));
    const Vec3 low(2.25f, 2.95f, 2), high(3.75f, 2.95f, 3);
    Mesh lamp = quad({low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, low.y, high.z},
                     {low.x, low.y, high.z});
    for (Primitive& p : lamp.primitives) p.material = kLamp;
    lamp.normals.clear();
    add_object(scene, std::move(lamp));
}

}  // namespace

Scene make_furnished_box(int quads) {
    Scene scene;
    Rng rng(kSeed);
    add_materials(scene, rng);
    add_shell(scene);

    // Things on a grid over the floor and above it, each turned its own way.
    constexpr int kAcross = 6, kUp = 2, kDeep = 5;
    constexpr int kOfAKind = kAcross * kUp * kDeep / 2;
    const int of_sphere = across_face(quads / (2 * kOfAKind)) + 1;
    const int of_box = across_face(quads / kOfAKind - 6 * of_sphere * of_sphere);
    for (int y = 0; y < kUp; ++y)
        for (int z = 0; z < kDeep; ++z)
            for (int x = 0; x < kAcross; ++x) {
                const Vec3 jitter(rng.uniform(), rng.uniform(), rng.uniform());
                const Vec3 centre = (Vec3(x, y, z) + 0.4f + 0.2f * jitter) * Vec3(1, 1.1f, 1);
                const float size = 0.15f + 0.15f * rng.uniform();
                const Vec3 sides = size * Vec3(1, 0.4f + 0.6f * rng.uniform(), 0.8f);
                const auto paint = static_cast<MaterialId>(1 + rng.below(kPaints - 1));
                const bool sphere = (x + y + z) % 2 == 0;
                const auto shape = [&](Vec3 p) {
                    return sphere ? size * glm::normalize(p) : sides * p;
                };
                add_object(scene, subdivided_cube(sphere ? of_sphere : of_box, paint, shape),
                           moved(centre) * turned({0, 1, 0}, 360 * rng.uniform()));
            }
    check_scene(scene);
    return scene;
}

}  // namespace chiaro
