// Catmull-Clark surfaces: their limit points are known in closed form, and so is where they are
// smooth and where sharp.
#include "import/subdivide.h"

#include "import/import_testing.h"
#include "scene/bicubic.h"
#include "scene/bicubic_mesh.h"

#include <map>
#include <numbers>

namespace chiaro {
namespace {

const std::filesystem::path kScenes = CHIARO_SCENES;
constexpr float kNearly = 2e-6f;

// The cube from -1 to 1, faces outside in front.
constexpr char kCube[] = R"(v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

Mesh subdivided(const std::string& obj) {
    Scene scene = TempFolder().load("cage.obj", obj, {.subdivide = true});
    EXPECT_TRUE(scene.warnings.empty());
    return std::move(scene.meshes.at(0));
}

// How far the nearest corner of a patch is.
float nearest_corner(const Mesh& mesh, Vec3 place) {
    float nearest = kInfinity;
    for (const BicubicPatch& patch : mesh.bicubics)
        for (int c = 0; c < 4; ++c)
            nearest =
                std::min(nearest, glm::distance(place, patch_position(patch, patch_corner(c))));
    return nearest;
}

// Halstead, Kass and DeRose, "Efficient, fair interpolation using Catmull-Clark surfaces", 1993: a
// vertex of valence n comes to (n^2 v + 4 sum of edge points + sum of face points) / (n (n + 5)).
// Of the cube's corner (1, 1, 1) that is (9 + 4 - 1) / 24; of the middle of a face, a vertex of
// valence 4 after one level, (16 + 4 * 3 / 4 * 4 + 4 * 5 / 9) / 36.
TEST(Subdivide, ACubesLimitPointsAreThoseOfTheFormula) {
    const Mesh mesh = subdivided(kCube);
    EXPECT_LT(nearest_corner(mesh, Vec3(0.5f)), kNearly);
    EXPECT_LT(nearest_corner(mesh, Vec3(0, 0, (16 + 12 + 20.0f / 9) / 36)), kNearly);
}

TEST(Subdivide, NormalsPointTheWayOfTheCagesFaces) {
    for (const BicubicPatch& patch : subdivided(kCube).bicubics)
        EXPECT_GT(glm::dot(patch_normal(patch, Vec2(0.5f)), patch_position(patch, Vec2(0.5f))), 0);
}

// Each edge of a closed surface is two patches', and the same curve to the last bit.
TEST(Subdivide, NeighboursHaveTheSameEdge) {
    const Mesh mesh = subdivided(kCube);
    using Key = std::array<float, 12>;
    std::map<Key, int> edges;
    for (const BicubicPatch& patch : mesh.bicubics)
        for (int side = 0; side < 4; ++side) {
            const auto key_of = [](const CubicCurve& curve) {
                Key key;
                for (int k = 0; k < 12; ++k) key[k] = curve[k / 3][k % 3] + 0.0f;
                return key;
            };
            const CubicCurve edge = patch_edge(patch, side);
            ++edges[std::min(key_of(edge), key_of(reversed(edge)))];
        }
    EXPECT_EQ(edges.size(), 2 * mesh.bicubics.size());
    for (const auto& [edge, patches] : edges) EXPECT_EQ(patches, 2);
}

// Across an edge the normals of both patches agree but for what the approximation at extraordinary
// vertices leaves: 0.3 degrees on the cube, none on a surface that is regular all over.
TEST(Subdivide, NormalsJumpLittleAcrossEdges) {
    const Mesh mesh = subdivided(kCube);
    std::map<std::tuple<float, float, float>, Vec3> normal_at;
    float least = 1;
    for (const BicubicPatch& patch : mesh.bicubics)
        for (const Vec2 at : {Vec2(0.5f, 0), Vec2(1, 0.5f), Vec2(0.5f, 1), Vec2(0, 0.5f)}) {
            const Vec3 p = glm::round(patch_position(patch, at) * 1e4f) + 0.0f;
            const Vec3 normal = patch_normal(patch, at);
            const auto [known, fresh] = normal_at.try_emplace({p.x, p.y, p.z}, normal);
            if (!fresh) least = std::min(least, glm::dot(normal, known->second));
        }
    EXPECT_EQ(normal_at.size(), 2 * mesh.bicubics.size());
    EXPECT_GT(least, std::cos(0.4f * std::numbers::pi_v<float> / 180));
}

// A torus cage of quads: one patch a face, and second derivatives go on across edges.
std::string torus(float scale = 1, float x = 0) {
    constexpr int kAround = 8, kAcross = 6;
    std::string text;
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j) {
            const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
            const float b = 2 * std::numbers::pi_v<float> * static_cast<float>(j) / kAcross;
            const float r = scale * (3 + std::cos(b));
            text += "v " + std::to_string(x + r * std::cos(a)) + " " +
                    std::to_string(scale * std::sin(b)) + " " + std::to_string(r * std::sin(a)) +
                    "\n";
        }
    const auto vertex = [](int i, int j) {
        return " " + std::to_string(1 + i % kAround * kAcross + j % kAcross);
    };
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j)
            text += "f" + vertex(i, j) + vertex(i, j + 1) + vertex(i + 1, j + 1) +
                    vertex(i + 1, j) + "\n";
    return text;
}

TEST(Subdivide, RegularPatchesJoinWithEqualSecondDerivatives) {
    const Mesh mesh = subdivided(torus());
    ASSERT_EQ(mesh.bicubics.size(), 48u);
    // Along u towards u = 1, as the Bezier points of a row have them: places, first and second.
    const auto ends = [](const BicubicPatch& p, int j, bool far) {
        const auto at = [&](int i) { return p.place(far ? 3 - i : i, j); };
        const Vec3 first = (at(1) - at(0)) * (far ? -1.0f : 1.0f);
        return std::array<Vec3, 3>{at(0), first, at(0) - 2.0f * at(1) + at(2)};
    };
    int joined = 0;
    for (const BicubicPatch& low : mesh.bicubics)
        for (const BicubicPatch& high : mesh.bicubics) {
            if (low.place(3, 0) != high.place(0, 0) || low.place(3, 3) != high.place(0, 3))
                continue;
            ++joined;
            for (int j = 0; j < 4; ++j)
                for (int order = 0; order < 3; ++order)
                    EXPECT_LT(glm::distance(ends(low, j, true)[order], ends(high, j, false)[order]),
                              5e-6f);
        }
    EXPECT_EQ(joined, 48);
}

// Rounding, there, is more than an edge is bent: no reason to divide a patch.
TEST(Subdivide, ASmallCageFarAwayHasAPatchAFaceToo) {
    EXPECT_EQ(subdivided(torus(1e-3f, 100)).bicubics.size(), 48u);
}

// All twelve edges infinitely sharp: the cube itself.
TEST(Subdivide, ACubeOfSharpCreasesStaysACube) {
    std::string creases;
    for (const char* edge :
         {"0 1", "1 2", "2 3", "3 0", "4 5", "5 6", "6 7", "7 4", "0 4", "1 5", "2 6", "3 7"})
        creases += "t crease 2/1/0 " + std::string(edge) + " 10\n";
    const Scene scene = TempFolder().load("cage.obj", kCube + creases);
    const Mesh& mesh = scene.meshes.at(0);
    for (int c = 0; c < 8; ++c)
        EXPECT_LT(nearest_corner(mesh, Vec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1)),
                  kNearly);
    for (const BicubicPatch& patch : mesh.bicubics) {
        const Vec3 p = glm::abs(patch_position(patch, Vec2(0.3f, 0.6f)));
        EXPECT_NEAR(std::max({p.x, p.y, p.z}), 1, kNearly);
    }
}

TEST(Subdivide, ASharpVertexStaysInItsPlace) {
    const Scene scene = TempFolder().load("cage.obj", kCube + std::string("t corner 1/1/0 6 10\n"));
    EXPECT_LT(nearest_corner(scene.meshes.at(0), Vec3(1)), kNearly);
    EXPECT_GT(nearest_corner(scene.meshes.at(0), Vec3(-1)), 0.5f);
}

constexpr char kSquare[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

// One square: with its corners kept it is itself; without, its boundary is the cubic B-spline of
// the square, whose corner comes to (4 * corner + both neighbours) / 6.
TEST(Subdivide, BoundariesFollowTheirRule) {
    const auto with_rule = [](const std::string& rule) {
        return TempFolder().load("a.obj", kSquare + ("t interpolateboundary 1/0/0 " + rule + "\n"));
    };
    EXPECT_LT(nearest_corner(with_rule("1").meshes.at(0), Vec3(0)), kNearly);
    const Scene smooth = with_rule("2");
    EXPECT_LT(nearest_corner(smooth.meshes.at(0), Vec3(1.0f / 6, 1.0f / 6, 0)), kNearly);
    EXPECT_TRUE(with_rule("0").objects.empty());
}

TEST(Subdivide, AHoleHasNoSurface) {
    const Scene scene = TempFolder().load("cage.obj", kCube + std::string("t hole 1/0/0 1\n"));
    EXPECT_GT(nearest_corner(scene.meshes.at(0), Vec3(0, 0, 0.8395f)), 0.1f);
    EXPECT_LT(nearest_corner(scene.meshes.at(0), Vec3(0, 0, -0.8395f)), 1e-3f);
}

// Linear in the cage's plane, so exactly the place on the surface, and two maps meet at a seam.
TEST(Subdivide, TextureCoordinatesGoWithTheSurface) {
    const Mesh mesh = subdivided(
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "f 1/1 2/2 5/3 4/4\nf 2/1 3/2 6/3 5/4\n");
    ASSERT_EQ(mesh.bicubics.size(), 2u);
    for (int patch = 0; patch < 2; ++patch)
        for (int c = 0; c < 4; ++c) {
            const Vec2 uv = mesh.uvs[0][mesh.primitives[patch].corners[c]];
            EXPECT_NEAR(uv.x, patch_corner(c).x, kNearly);
            EXPECT_NEAR(uv.y, 1 - patch_corner(c).y, kNearly);
        }
}

// Five triangles round a point: where places, texture coordinates and colours begin equal they
// stay so, by equal rules, also next to a vertex of five faces.
TEST(Subdivide, TextureCoordinatesAndColoursAreBlendedAsPlacesAre) {
    std::string text = "v 0.5 0.5 0 0.5 0.5 0\nvt 0.5 0.5\n";
    for (int k = 0; k < 5; ++k) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / 5;
        const std::string x = std::to_string(0.5f + 0.4f * std::cos(angle)),
                          y = std::to_string(0.5f + 0.4f * std::sin(angle));
        text += "v " + x + " " + y + " 0 " + x + " " + y + " 0\nvt " + x + " " + y + "\n";
    }
    for (int k = 0; k < 5; ++k) {
        const std::string from = std::to_string(k + 2), to = std::to_string((k + 1) % 5 + 2);
        text += "f 1/1 " + from + "/" + from + " " + to + "/" + to + "\n";
    }
    const Mesh mesh = subdivided(text);
    ASSERT_FALSE(mesh.bicubics.empty());
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const Vec2 place(mesh.positions[k]);
        EXPECT_LT(glm::distance(Vec2(mesh.colors[k]), place), kNearly);
        EXPECT_LT(glm::distance(mesh.uvs[0][k], Vec2(place.x, 1 - place.y)), kNearly);
    }
}

TEST(Subdivide, PolygonsOfAnyKindBecomePatchesOnlyWhenAsked) {
    const TempFolder folder;
    const std::string pyramid =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\n"
        "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    EXPECT_TRUE(folder.load("a.obj", pyramid).meshes[0].bicubics.empty());
    const Mesh mesh = subdivided(pyramid);
    EXPECT_EQ(mesh.primitives.size(), mesh.bicubics.size());
    const Scene triangle = folder.load("a.gltf", triangle_gltf().text(), {.subdivide = true});
    EXPECT_EQ(triangle.meshes[0].bicubics.size() % 3, 0u);
    EXPECT_LT(nearest_corner(triangle.meshes[0], Vec3(1, 0, 0)), kNearly);
}

// What meshes of files are at times: each of them comes to an end, without a word of OpenSubdiv.
TEST(Subdivide, OddCagesDoNotStopIt) {
    std::string fan = "v 0 0 1\n";
    for (int k = 0; k < 1200; ++k)
        fan += "v " + std::to_string(std::cos(0.005 * k)) + " " +
               std::to_string(std::sin(0.005 * k)) + " 0\n";
    for (int k = 0; k < 1199; ++k)
        fan += "f 1 " + std::to_string(k + 2) + " " + std::to_string(k + 3) + "\n";
    const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 1\nv 1 0 -1\n";
    struct Odd {
        std::string text, said;  // empty: taken
    };
    const Odd table[] = {
        {points + "f 1 2 2 3\n", ""},                         // a corner twice
        {points + "f 1 2 3\nf 1 2 4\nf 1 2 5\n", ""},         // three faces at an edge
        {points + "f 1 2 3\nf 1 2 3\n", ""},                  // a face twice
        {points + "f 1 2 3\nf 1 5 6\n", ""},                  // two faces at a vertex alone
        {points + "f 1 2 3 4\nf 1 2 3 4\nf 4 3 2 1\n", ""},   // and from behind
        {points + "f 1 2 3 4 1 2 3 4\n", ""},                 // twice round
        {"v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", ""},         // in one place
        {points + "f 1 2 3 4\nt crease 2/1/0 0 2 5\n", ""},   // a crease that is no edge
        {points + "f 1 2 3 4\nt crease 2/1/0 0 99 5\n", ""},  // of no vertex
        {points + "f 1 2 3 4\nt corner 1/1/0 4000000000 5\n", ""},
        {points + "f 1 2 3 4\nt hole 1/0/0 7\n", ""},
        {fan, "more than 1000 faces meet at a vertex"},
        {"v 2e9 0 0\n" + points + "f 1 2 3\n", "coordinates beyond 1e9"},
    };
    const TempFolder folder;
    for (const Odd& odd : table) {
        const std::string fault =
            fault_of([&] { folder.load("a.obj", odd.text, {.subdivide = true}); });
        EXPECT_EQ(fault.empty(), odd.said.empty()) << odd.text.substr(0, 200) << fault;
        EXPECT_NE(fault.find(odd.said), std::string::npos) << fault;
    }
}

TEST(Subdivide, WrongTagsAreRefusedByLine) {
    struct Wrong {
        std::string tag, said;
    };
    const Wrong table[] = {
        {"crease", "tag: \"\" is not a count"},
        {"crease 2/1", "tag: \"\" is not a count"},
        {"crease 2/1/0 0", "tag: \"\" is not an index"},
        {"crease 4000000000/1/0 0 1 2", "tag: \"\" is not an index"},
        {"crease 2/1/0 0 1", "sharpness is missing"},
        {"crease 2/0/0 0 1", "tag: the sharpness is missing"},
        {"crease 1/1/0 0 1", "tag: a crease needs 2 vertices"},
        {"crease 2/1/0 -1 1 2", "tag: \"-1\" is not an index"},
        {"corner 1/1/0 0 nan", "sharpness: \"nan\" is not finite"},
        {"interpolateboundary 1/0/0 3", "tag: interpolateboundary takes one number from 0 to 2"},
        {"facevaryinginterpolateboundary 0/0/0",
         "tag: facevaryinginterpolateboundary takes one number from 0 to 3"},
        {"creasemethod 0/0/1 round", "tag: creasemethod is normal or chaikin"},
        {"creasemethod 0/0/1", "tag: a string is missing"},
    };
    const TempFolder folder;
    for (const Wrong& wrong : table)
        EXPECT_EQ(fault_of_file(folder, "a.obj", kSquare + ("t " + wrong.tag + "\n")),
                  "a.obj:6: " + wrong.said);
    const Scene scene = folder.load("a.obj", kSquare + std::string("t vertexedit 1/0/0 0\n"));
    EXPECT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.meshes.at(0).bicubics.empty());
}

TEST(Subdivide, RealCagesBecomePatchesAlone) {
    const auto folder = kScenes / "subdiv_cages";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the cages are not in " << folder;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".obj") continue;
        const Scene scene = load_scene(entry.path(), {.subdivide = true});
        ASSERT_EQ(scene.meshes.size(), 1u) << entry.path();
        EXPECT_EQ(scene.meshes[0].bicubics.size(), scene.meshes[0].primitives.size());
        EXPECT_LE(scene.meshes[0].bicubics.size(), 16'384u) << entry.path();
    }
}

}  // namespace
}  // namespace chiaro
