#include "import/import_testing.h"

#include <clocale>

namespace chiaro {
namespace {

constexpr std::string_view kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, AQuadStaysAQuadInCounterClockwiseOrder) {
    const Scene scene = TempFolder().load("a.obj", std::string(kSquare) + "f 1 2 3 4\n");
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.quad_count, 1u);
    ASSERT_EQ(mesh.primitives.size(), 1u);
    const auto& corners = mesh.primitives[0].corners;
    EXPECT_EQ(mesh.positions[corners[2]], Vec3(1, 1, 0));
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(scene.materials[0].double_sided);
    EXPECT_EQ(scene.materials[0].base_color, Rgb(0.8f));
    EXPECT_EQ(scene.objects[0].name, "object 1");
}

TEST(ReadObj, EveryFormOfCornerIsRead) {
    const std::string text = std::string(kSquare) +
                             "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\n"
                             "f 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//1 3//1\nf 1/1/1 2/2/1 3/3/1\n"
                             "f -4/-3/-1 -3/-2/-1 -2/-1/-1\n";
    const Scene scene = TempFolder().load("a.obj", text);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.primitives.size(), 5u);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const Vec3 n : mesh.normals) EXPECT_EQ(n, Vec3(0, 0, 1));
    // The last two faces have the same corners and so share their points.
    EXPECT_EQ(mesh.primitives[3].corners, mesh.primitives[4].corners);
}

TEST(ReadObj, TextureCoordinatesAreTurnedDownwards) {
    const Scene scene = TempFolder().load(
        "a.obj", std::string(kSquare) + "vt 0 0\nvt 1 0\nvt 0.25 0.75\nf 1/1 2/2 3/3\n");
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.uvs[0][mesh.primitives[0].corners[0]], Vec2(0, 1));
    EXPECT_EQ(mesh.uvs[0][mesh.primitives[0].corners[2]], Vec2(0.25f, 0.25f));
}

TEST(ReadObj, CornersWithoutANormalGetThatOfTheirFaceWhereOthersHaveOne) {
    const Scene scene =
        TempFolder().load("a.obj", std::string(kSquare) +
                                       "v 0 0 1\nvn 1 0 0\nvn 0 0 0\nf 1//1 2//1 3//1\n"
                                       "f 1 3 4\nf 1//2 5//2 2//2\n");
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.normals[mesh.primitives[0].corners[0]], Vec3(1, 0, 0));
    EXPECT_EQ(mesh.normals[mesh.primitives[1].corners[0]], Vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[mesh.primitives[2].corners[1]], Vec3(0, 1, 0));
}

TEST(ReadObj, VertexColoursAreReadAndWhiteWhereThereAreNone) {
    const Scene scene =
        TempFolder().load("a.obj", "v 0 0 0\nv 1 0 0 0.5 0.25 1\nv 0 1 0 1.0\nf 1 2 3\n");
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_EQ(mesh.colors[0], Vec4(1));
    EXPECT_EQ(mesh.colors[1], Vec4(0.5f, 0.25f, 1, 1));
    EXPECT_EQ(mesh.colors[2], Vec4(1));
}

TEST(ReadObj, ANewObjectBeginsWhereTheObjectOrTheGroupChanges) {
    const Scene scene = TempFolder().load("a.obj", std::string(kSquare) +
                                                       "f 1 2 3\no Table\nf 1 2 3\ng leg left\n"
                                                       "f 1 2 3\ng top\nf 1 2 3\ng leg left\n"
                                                       "f 1 3 4\no Lamp\nf 1 2 3\n");
    ASSERT_EQ(scene.objects.size(), 5u);
    EXPECT_EQ(scene.objects[1].name, "Table");
    EXPECT_EQ(scene.objects[2].name, "Table/leg left");
    EXPECT_EQ(scene.mesh_of(scene.objects[2]).primitives.size(), 2u);
    EXPECT_EQ(scene.objects[3].name, "Table/top");
    EXPECT_EQ(scene.objects[4].name, "Lamp");
}

TEST(ReadObj, LineEndsContinuationsCommentsAndBlanksDoNotMatter) {
    const Scene scene =
        TempFolder().load("a.OBJ",
                          "# first\r\n\tv  0 0 0 # here\r\nv 1 \\\r\n 0 0\rv 0 1 0\r\n\r\ns off\r\n"
                          "f 1 \\\n 2 \\\n 3 # a face \\");
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1u);
}

// However a line of comment ends, the next one counts.
TEST(ReadObj, ACommentEndsWithItsLine) {
    for (const std::string comment :
         {"# C:\\rooms\\\n", "s 1 # half \\\n", "s \\\n1 # half \\\n"}) {
        const Scene scene =
            TempFolder().load("a.obj", comment + std::string(kSquare) + "f 1 2 3 4\n");
        EXPECT_EQ(scene.meshes.at(0).positions[0], Vec3(0)) << comment;
        EXPECT_TRUE(scene.warnings.empty()) << comment;
    }
}

TEST(ReadObj, AByteOrderMarkIsPassedOver) {
    const std::string text = "\xef\xbb\xbf" + std::string(kSquare) + "f 1 2 3 4\n";
    const Scene scene = TempFolder().load("a.obj", text);
    EXPECT_EQ(scene.meshes.at(0).positions[0], Vec3(0));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(ReadObj, AFaceMayComeBeforeItsPoints) {
    EXPECT_EQ(TempFolder().load("a.obj", "f 1 2 3\n" + std::string(kSquare)).objects.size(), 1u);
}

TEST(ReadObj, NumbersAreReadAlikeInEveryForm) {
    const Scene scene =
        TempFolder().load("a.obj", "v +1 2. -3.e0\nv 1e2 .5E+1 1e-400\nv +.5 1E-2 -0\nf 1 2 3\n");
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions[0], Vec3(1, 2, -3));
    EXPECT_EQ(mesh.positions[1], Vec3(100, 5, 0));
    EXPECT_EQ(mesh.positions[2], Vec3(0.5f, 0.01f, 0));
}

TEST(ReadObj, FaultsNameTheLine) {
    const TempFolder folder;
    const auto fault = [&](const std::string& text) {
        return fault_of_file(folder, "a.obj", std::string(kSquare) + text);
    };
    EXPECT_EQ(fault("f 1 2 9\n"), "a.obj:5: a face names v 9, but there are 4");
    EXPECT_EQ(fault("f 1/1 2/1 3/1\n"), "a.obj:5: a face names vt 1, but there are 0");
    EXPECT_EQ(fault("\nf 0 1 2\n"), "a.obj:6: corner \"0\": indices count from 1");
    EXPECT_EQ(fault("f -5 1 2\n"), "a.obj:5: corner \"-5\": there are 4 before it");
    EXPECT_EQ(fault("f 1 2\n"), "a.obj:5: a face needs at least 3 corners and has 2");
    EXPECT_EQ(fault("f 1 2 x\n"), "a.obj:5: \"x\" is not a corner of a face");
    EXPECT_EQ(fault("f 1 2 3/1/1/1\n"), "a.obj:5: \"3/1/1/1\" is not a corner");
    EXPECT_EQ(fault("f 1 2 99999999999999999999\n"),
              "a.obj:5: \"99999999999999999999\" is not a corner of a face");
    EXPECT_EQ(fault("v 1 2\n"), "a.obj:5: z is missing");
    EXPECT_EQ(fault("v nan 0 0\n"), "a.obj:5: x: \"nan\" is not finite");
    EXPECT_EQ(fault("v 1e39 0 0\n"), "a.obj:5: x: \"1e39\" is not finite");
    EXPECT_EQ(fault("v 1e400 0 0\n"), "a.obj:5: x: \"1e400\" is not finite");
    EXPECT_EQ(fault("v 3.1+e2 0 0\n"), "a.obj:5: x: \"3.1+e2\" is not a number");
    EXPECT_EQ(fault("v +-1 0 0\n"), "a.obj:5: x: \"+-1\" is not a number");
    EXPECT_EQ(fault("v 1\x1b[2Jx 0 0\n"), "a.obj:5: x: \"1\\x1b[2Jx\" is not a number");
    EXPECT_EQ(fault(""), "a.obj: there is no face in the file");
}

TEST(ReadObj, PolygonsOfManyCornersAreSplit) {
    const Scene scene = TempFolder().load("a.obj",
                                          "v 0 0 0\nv 2 0 0\nv .3 .3 0\nv 0 2 0\nv -1 1 0\n"
                                          "f 1 2 3 4\nf 1 2 3 4 5\n");
    for (const Primitive& p : scene.meshes[0].primitives) EXPECT_FALSE(p.is_quad());
    EXPECT_EQ(scene.meshes[0].primitives.size(), 5u);
}

TEST(ReadObj, ScaleAndUpApplyToTheWorldNotToTheMesh) {
    const Scene scene = TempFolder().load("a.obj", std::string(kSquare) + "f 1 2 3 4\n",
                                          {.up = Vec3(0, 0, 2), .scale = 0.01f});
    EXPECT_EQ(scene.up, Vec3(0, 0, 1));
    EXPECT_NEAR(bounds(scene).high.x, 0.01f, 1e-8f);
}

TEST(ReadObj, SurfacesWithoutAreaAreLeftOutWithAWarning) {
    const Scene scene =
        TempFolder().load("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n");
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_FALSE(scene.warnings.empty());
}

}  // namespace
}  // namespace chiaro
