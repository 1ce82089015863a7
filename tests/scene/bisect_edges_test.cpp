#include "scene/bisect_edges.h"

#include "sample_renderer/tiny_scenes.h"
#include "scene/area_lights.h"
#include "scene/built_in.h"
#include "scene/shapes.h"
#include "scene/surface.h"

#include <gtest/gtest.h>

#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace chiaro {
namespace {

using namespace tiny;

// Calls use(a, b, c) with the points of each triangle of a mesh; a quad is the two of its surface.
// Bicubic patches, which are not divided, have none.
template <typename Use>
void for_each_triangle(const Mesh& mesh, const Use& use) {
    for (const Primitive& p : std::span(mesh.primitives).subspan(mesh.bicubics.size())) {
        const auto& c = p.corners;
        use(c[0], c[1], p.is_quad() ? c[3] : c[2]);
        if (p.is_quad()) use(c[2], c[3], c[1]);
    }
}

float longest_edge(const Scene& scene) {
    float longest = 0;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.mesh_of(object);
        const auto measure = [&](std::uint32_t a, std::uint32_t b) {
            const Vec3 edge = Mat3(object.to_world) * (mesh.positions[b] - mesh.positions[a]);
            longest = std::max(longest, glm::length(edge));
        };
        for_each_triangle(mesh, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            measure(a, b);
            measure(b, c);
            measure(c, a);
        });
    }
    return longest;
}

std::map<MaterialId, double> area_by_material(const Scene& scene) {
    std::map<MaterialId, double> area;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const auto& primitives = scene.mesh_of(scene.objects[o]).primitives;
        for (std::uint32_t p = 0; p < primitives.size(); ++p)
            area[primitives[p].material] += primitive_area(scene, ObjectId(o), p);
    }
    return area;
}

std::size_t primitive_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.primitives.size();
    return count;
}

using Place = std::tuple<float, float, float>;

// How often triangles run from the one place to the other.
std::map<std::pair<Place, Place>, int> edges_by_place(const Mesh& mesh) {
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](std::uint32_t point) {
        const Vec3 p = mesh.positions[point];
        return Place(p.x, p.y, p.z);
    };
    for_each_triangle(mesh, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        ++edges[{place(a), place(b)}];
        ++edges[{place(b), place(c)}];
        ++edges[{place(c), place(a)}];
    });
    return edges;
}

// On a closed surface each edge is run through once either way; an edge that ends in the middle of
// another would be alone.
void expect_closed(const Mesh& mesh) {
    std::size_t alone = 0;
    const auto edges = edges_by_place(mesh);
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        alone += count != 1 || back == edges.end() || back->second != 1;
    }
    EXPECT_EQ(alone, 0u) << "of " << edges.size();
}

Scene with_mesh(Mesh mesh, const Mat4& to_world = Mat4(1)) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(0.5f));
    for (Primitive& p : mesh.primitives) p.material = material;
    add_object(scene, std::move(mesh), to_world);
    return scene;
}

TEST(BisectEdges, NoEdgeIsLongerAfterwards) {
    Scene scene = make_room();
    const float longest = bounds(scene).diagonal() / 60;
    bisect_edges(scene, longest);
    check_scene(scene);
    EXPECT_GT(primitive_count(scene), 30'000u);
    EXPECT_LE(longest_edge(scene), longest * (1 + 1e-5f));
    EXPECT_GT(longest_edge(scene), longest / 2);  // nothing is halved without need
}

TEST(BisectEdges, AreasOfMaterialsAndBoundsStay) {
    Scene scene = make_room();
    const auto areas = area_by_material(scene);
    const Box box = bounds(scene);
    bisect_edges(scene, box.diagonal() / 40);
    const auto after = area_by_material(scene);
    ASSERT_EQ(after.size(), areas.size());
    for (const auto& [material, area] : areas)
        EXPECT_NEAR(after.at(material), area, 1e-5 * area) << index_of(material);
    EXPECT_EQ(bounds(scene).low, box.low);
    EXPECT_EQ(bounds(scene).high, box.high);
}

// Faces with points of their own, edges of many lengths: neighbours agree by place alone.
TEST(BisectEdges, AClosedSurfaceStaysClosed) {
    for (const float longest : {2.0f, 0.9f, 0.35f}) {
        Scene scene = with_mesh(box({0, 0, 0}, {1, 2.3f, 5}));
        bisect_edges(scene, longest);
        expect_closed(scene.meshes[0]);
    }
    Scene cushion = with_mesh(rounded_box({0, 0, 0}, {2, 1, 3}, 0.2f), turned({1, 2, 3}, 40));
    const std::size_t plain = primitive_count(cushion);
    bisect_edges(cushion, 0.17f);
    EXPECT_GT(primitive_count(cushion), 10 * plain);
    expect_closed(cushion.meshes[0]);
}

// Euler: a closed surface without holes has two vertices more than half its triangles.
TEST(BisectEdges, PointsOnAnEdgeAreSharedWhereItsEndsAre) {
    Scene scene;
    add_box(scene, Vec3(0), Vec3(1, 2, 3), add_material(scene, Rgb(0.5f)));
    bisect_edges(scene, 0.3f);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions.size(), mesh.primitives.size() / 2 + 2);
    EXPECT_GT(mesh.primitives.size(), 500u);
}

// One, two or three edges that are just too long make two, three or four triangles of one.
TEST(BisectEdges, AsManyEdgesAsAreLongAreHalved) {
    const auto parts = [](Vec3 a, Vec3 b, Vec3 c) {
        Scene scene;
        Mesh mesh;
        mesh.positions = {a, b, c};
        mesh.primitives = {triangle(0, 1, 2, add_material(scene, Rgb(0.5f)))};
        add_object(scene, std::move(mesh));
        bisect_edges(scene, 1);
        return std::pair(scene.meshes[0].primitives.size(), scene.meshes[0].positions.size());
    };
    EXPECT_EQ(parts({0, 0, 0}, {1, 0, 0}, {0.5f, 0.5f, 0}), std::pair(1UL, 3UL));
    EXPECT_EQ(parts({0, 0, 0}, {1.2f, 0, 0}, {0.6f, 0.5f, 0}), std::pair(2UL, 4UL));
    EXPECT_EQ(parts({0, 0, 0}, {0.4f, 0, 0}, {0.2f, 1.5f, 0}), std::pair(3UL, 5UL));
    EXPECT_EQ(parts({0, 0, 0}, {1.1f, 0, 0}, {0.55f, 0.95f, 0}), std::pair(4UL, 6UL));
}

TEST(BisectEdges, TextureCoordinatesAndColoursThatAreLinearStayTheSameFunctionOfPlace) {
    Mesh mesh = sheet(3, 2, [](float u, float v) { return Vec3(4 * u, 0, -3 * v); });
    const auto uv_at = [](Vec3 p) { return Vec2(2 * p.x - p.z + 1, 0.5f * p.z); };
    const auto color_at = [](Vec3 p) { return Vec4(0.1f * p.x, 0.2f, -0.3f * p.z, 1); };
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.uvs[0][i] = uv_at(mesh.positions[i]);
        mesh.colors.push_back(color_at(mesh.positions[i]));
    }
    Scene scene = with_mesh(std::move(mesh));
    bisect_edges(scene, 0.2f);
    const Mesh& fine = scene.meshes[0];
    EXPECT_GT(fine.positions.size(), 400u);
    for (std::size_t i = 0; i < fine.positions.size(); ++i) {
        EXPECT_NEAR(glm::distance(fine.uvs[0][i], uv_at(fine.positions[i])), 0, 1e-5f);
        EXPECT_NEAR(glm::distance(fine.colors[i], color_at(fine.positions[i])), 0, 1e-6f);
    }
}

// Normals that point away from the centre do so in between, the better the finer the mesh is that
// one starts with: an edge's middle normal is that of the middle of its chord.
TEST(BisectEdges, NormalsAreOfUnitLengthBetweenThoseOfTheEnds) {
    constexpr float kStep = 2 * kPi / 24;
    std::vector<Vec2> profile;
    for (int i = 2; i <= 10; ++i) {
        const float angle = kPi * static_cast<float>(i) / 12;
        profile.push_back({std::sin(angle), -std::cos(angle)});
    }
    Mesh ball = lathe(profile, 24);
    for (std::size_t i = 0; i < ball.positions.size(); ++i)
        ball.normals[i] = glm::normalize(ball.positions[i]);
    Scene scene = with_mesh(std::move(ball));
    bisect_edges(scene, 0.05f);
    const Mesh& fine = scene.meshes[0];
    EXPECT_GT(fine.positions.size(), 2000u);
    for (std::size_t i = 0; i < fine.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(fine.normals[i]), 1, 1e-6f);
        const Vec3 away = glm::normalize(fine.positions[i]);
        EXPECT_GT(glm::dot(fine.normals[i], away), std::cos(kStep * kStep));
    }
}

// Halves of what a float holds exactly are exact.
TEST(BisectEdges, TheAreaOfEmittersIsExactlyKept) {
    Scene scene;
    add_room(scene, Vec3(-2), Vec3(2), add_material(scene, Rgb(0.5f)));
    const MaterialId lamp = add_material(scene, Rgb(0), Rgb(100));
    add_quad(scene, {-0.5f, 1.5f, -0.25f}, {1, 0, 0}, {0, 0, 0.5f}, lamp);
    const float power = AreaLights(scene).power();
    bisect_edges(scene, 0.0625f);
    const AreaLights lights(scene);
    EXPECT_GE(lights.size(), 2 * 0.5 / (0.0625 * 0.0625));
    EXPECT_EQ(area_by_material(scene).at(lamp), 0.5);
    EXPECT_NEAR(lights.power(), power, 1e-6f * power);
}

TEST(BisectEdges, AMeshOfSeveralObjectsIsMeasuredWhereItIsLargest) {
    Scene scene = with_mesh(box(Vec3(0), Vec3(1)));
    const auto show_scaled = [&scene](Vec3 scale) {
        Object object = scene.objects[0];
        for (int axis = 0; axis < 3; ++axis) object.to_world[axis] *= scale[axis];
        scene.objects.push_back(object);
    };
    show_scaled(Vec3(3));
    show_scaled({-0.5f, 0.5f, 7});
    bisect_edges(scene, 0.8f);
    EXPECT_LE(longest_edge(scene), 0.8f * (1 + 1e-6f));
    EXPECT_GT(longest_edge(scene), 0.4f);
    expect_closed(scene.meshes[0]);
}

TEST(BisectEdges, ShortEdgesAreLeftAlone) {
    Scene scene = make_cornell_box();
    const Scene plain = scene;
    bisect_edges(scene, bounds(scene).diagonal());
    ASSERT_EQ(scene.meshes.size(), plain.meshes.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        EXPECT_EQ(scene.meshes[m].positions, plain.meshes[m].positions);
        EXPECT_EQ(scene.meshes[m].quad_count, plain.meshes[m].quad_count);
    }
}

// Cut across: not into a thousand times a thousand parts.
TEST(BisectEdges, SliversBecomeShortAndKeepTheirArea) {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1000, 0, 0}, {300, 0.01f, 0}, {1000, 0.02f, 0}};
    const MaterialId material = add_material(scene, Rgb(0.5f));
    mesh.primitives = {triangle(0, 1, 2, material), triangle(1, 3, 2, material)};
    add_object(scene, std::move(mesh));
    const double area = area_by_material(scene).at(material);
    bisect_edges(scene, 1);
    EXPECT_LE(longest_edge(scene), 1 + 1e-5f);
    EXPECT_NEAR(area_by_material(scene).at(material), area, 1e-3 * area);
    EXPECT_LT(primitive_count(scene), 100'000u);
}

// Far from the origin floats are 1/16 apart: edges cannot become shorter than that.
TEST(BisectEdges, EndsWherePlacesAreNotToldApart) {
    Scene scene;
    add_quad(scene, Vec3(1e6f), {1, 0, 0}, {0, 1, 0}, add_material(scene, Rgb(0.5f)));
    bisect_edges(scene, 1e-3f);
    EXPECT_GE(longest_edge(scene), 1.0f / 16);
    EXPECT_LE(longest_edge(scene), 3.0f / 16);
    EXPECT_NEAR(area_by_material(scene).begin()->second, 1, 1e-4);
}

}  // namespace
}  // namespace chiaro
