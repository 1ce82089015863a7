// The furnished room: what a carpenter would check.

#include "scene/built_in.h"
#include "scene/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// A face in the world, with the plane that it lies in.
struct Face {
    std::string object;
    std::vector<Vec3> corners;
    Vec3 normal;
    Box box;
};

std::vector<Face> faces_of(const Scene& scene) {
    std::vector<Face> faces;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.mesh_of(object);
        for (const Primitive& primitive : mesh.primitives) {
            Face face = {.object = object.name};
            for (int i = 0; i < primitive.corner_count(); ++i) {
                const Vec4 p(mesh.positions[primitive.corners[i]], 1);
                face.corners.push_back(Vec3(object.to_world * p));
                face.box.add(face.corners.back());
            }
            const auto& c = face.corners;
            face.normal = glm::normalize(
                glm::cross(c[2] - c[0], (c.size() == 4 ? c[3] - c[1] : c[2] - c[1])));
            faces.push_back(std::move(face));
        }
    }
    return faces;
}

// How deep `a` and `b`, in one plane, overlap: the least over the axes that could separate them.
float overlap(const Face& a, const Face& b) {
    float least = kInfinity;
    for (const Face* edges_of : {&a, &b}) {
        const std::size_t count = edges_of->corners.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 edge = edges_of->corners[(i + 1) % count] - edges_of->corners[i];
            const Vec3 axis = glm::normalize(glm::cross(edge, edges_of->normal));
            float low[2] = {kInfinity, kInfinity};
            float high[2] = {-kInfinity, -kInfinity};
            for (int k = 0; k < 2; ++k)
                for (const Vec3 p : (k == 0 ? a : b).corners) {
                    low[k] = std::min(low[k], glm::dot(p, axis));
                    high[k] = std::max(high[k], glm::dot(p, axis));
                }
            least = std::min({least, high[0] - low[1], high[1] - low[0]});
        }
    }
    return least;
}

bool in_one_plane(const Face& a, const Face& b) {
    constexpr float kApart = 2e-4f;  // metres
    if (std::abs(glm::dot(a.normal, b.normal)) < 0.99999f) return false;
    if (glm::any(glm::lessThan(a.box.high + kApart, b.box.low))) return false;
    if (glm::any(glm::lessThan(b.box.high + kApart, a.box.low))) return false;
    return std::ranges::all_of(
        b.corners, [&](Vec3 p) { return std::abs(glm::dot(p - a.corners[0], a.normal)) < kApart; });
}

TEST(Room, HasAboutFourThousandPrimitivesMostlyQuads) {
    const Scene scene = *built_in_scene("room");
    std::size_t primitives = 0;
    std::size_t quads = 0;
    for (const Object& object : scene.objects) {
        primitives += scene.mesh_of(object).primitives.size();
        quads += scene.mesh_of(object).quad_count;
    }
    EXPECT_GE(primitives, 3600u);
    EXPECT_LE(primitives, 4400u);
    EXPECT_GE(quads, 9 * primitives / 10);
}

TEST(Room, ItsChairsAreOneMesh) {
    const Scene scene = *built_in_scene("room");
    std::vector<MeshId> meshes;
    for (const Object& object : scene.objects)
        if (object.name.starts_with("Chair ")) meshes.push_back(object.mesh);
    ASSERT_EQ(meshes.size(), 4u);
    EXPECT_TRUE(std::ranges::all_of(meshes, [&](MeshId m) { return m == meshes[0]; }));
}

TEST(Room, KeepsEverythingWithinItsWalls) {
    const Scene scene = *built_in_scene("room");
    for (const Face& face : faces_of(scene)) {
        // The window is let into the right wall.
        const float right = face.object == "Window" ? 6.37f : 6.2001f;
        EXPECT_TRUE(glm::all(glm::greaterThan(face.box.low, Vec3(-1e-4f)))) << face.object;
        EXPECT_TRUE(glm::all(glm::lessThan(face.box.high, Vec3(right, 2.6001f, 4.8001f))))
            << face.object;
    }
}

// Two faces in one place fight for the pixel, and both surfaces have a corner that is shaded
// wrongly.
TEST(Room, HasNoTwoFacesInOnePlace) {
    const std::vector<Face> faces = faces_of(*built_in_scene("room"));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!in_one_plane(faces[i], faces[j])) continue;
            const Vec3 place = faces[i].corners[0];
            EXPECT_LT(overlap(faces[i], faces[j]), 1e-3f)
                << faces[i].object << " and " << faces[j].object << " near " << place.x << " "
                << place.y << " " << place.z;
        }
    }
}

TEST(Room, ItsSolidsFaceOutward) {
    const Scene scene = *built_in_scene("room");
    const std::vector<std::string> solid = {
        "Sofa",       "Coffee table", "Table",   "Chair",   "Vase",      "Fruit bowl",
        "Book stack", "Floor lamp",   "Books 1", "Books 3", "Bookshelf", "Curtain rod",
        "Cup",        "Saucer",       "Spoon",   "Teapot",  "Radiator"};
    int tested = 0;
    for (const Mesh& mesh : scene.meshes) {
        if (std::ranges::find(solid, mesh.name) == solid.end()) continue;
        ++tested;
        for (const auto& [root, primitives] : solids_of(mesh))
            EXPECT_GE(outwardness(mesh, primitives), -1e-12) << mesh.name;
    }
    EXPECT_EQ(tested, static_cast<int>(solid.size()));
}

}  // namespace
}  // namespace chiaro
