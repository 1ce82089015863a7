// Free-form surfaces of OBJ files.
#include "import/import_testing.h"
#include "scene/bicubic.h"

namespace chiaro {
namespace {

constexpr float kNearly = 1e-6f;

// Points (i, j, 0) of a grid, u fastest, each with a texture coordinate ten times smaller.
std::string grid(int columns, int rows) {
    std::string text;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::string x = std::to_string(i), y = std::to_string(j);
            text += "v " + x + " " + y + " 0\nvt 0." + x + " 0." + y + "\n";
        }
    return text;
}

std::string surf(int points, const std::string& range = "0 1 0 1", bool textured = false) {
    std::string text = "surf " + range;
    for (int k = 1; k <= points; ++k) {
        const std::string n = std::to_string(k);
        text += " " + n + (textured ? "/" + n : "");
    }
    return text + "\n";
}

const std::string kBezier = "cstype bezier\ndeg 3 3\n";
const std::string kEnd = "parm u 0 1\nparm v 0 1\nend\n";

TEST(ObjFreeForm, ASurfaceIsAPatchWhosePointsRunAlongUFirst) {
    const Scene scene = TempFolder().load(
        "a.obj", grid(4, 4) + "usemtl none\no sheet\n" + kBezier + surf(16) + kEnd);
    ASSERT_EQ(scene.meshes.at(0).bicubics.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "sheet");
    EXPECT_EQ(scene.meshes[0].bicubics[0].place(1, 0), Vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes[0].bicubics[0].place(0, 1), Vec3(0, 1, 0));
}

TEST(ObjFreeForm, ASurfaceOfSeveralPiecesIsAsManyPatches) {
    const std::string parm = "parm u 0 0.25 1\nparm v 0 1\nend\n";
    const Scene scene =
        TempFolder().load("a.obj", grid(7, 4) + kBezier + surf(28, "0 1 0 1", true) + parm);
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.bicubics.size(), 2u);
    EXPECT_EQ(mesh.bicubics[1].place(0, 0), Vec3(3, 0, 0));
    EXPECT_EQ(mesh.bicubics[1].place(3, 3), Vec3(6, 3, 0));
    // Texture coordinates are those of its corners, with v downwards.
    const Vec2 uv = mesh.uvs[0][mesh.primitives[1].corners[2]];
    EXPECT_NEAR(uv.x, 0.6f, kNearly);
    EXPECT_NEAR(uv.y, 0.7f, kNearly);
}

// Weights 1, 1/3, 1/3, 1 and a profile that doubles the square's height: a half circle is a
// rational cubic, so all of its points lie at distance 1 from its axis.
TEST(ObjFreeForm, ARationalSurfaceIsACylinderExactly) {
    std::string text;
    for (int j = 0; j < 4; ++j)
        for (const char* row : {"1 0 # 1", "1 2 # 0.333333333", "-1 2 # 0.333333333", "-1 0 # 1"}) {
            std::string line = row;
            line.replace(line.find('#'), 1, std::to_string(j));
            text += "v " + line + "\n";
        }
    const Scene scene =
        TempFolder().load("a.obj", text + "cstype rat bezier\ndeg 3 3\n" + surf(16) + kEnd);
    const BicubicPatch& patch = scene.meshes.at(0).bicubics.at(0);
    for (const float u : {0.1f, 0.35f, 0.5f, 0.9f})
        EXPECT_NEAR(glm::length(Vec2(patch_position(patch, Vec2(u, 0.3f)))), 1, kNearly);
    // The same file without "rat" is no circle.
    const Scene plain = TempFolder().load("a.obj", text + kBezier + surf(16) + kEnd);
    EXPECT_NEAR(patch_position(plain.meshes.at(0).bicubics.at(0), Vec2(0.5f, 0)).y, 1.5f, kNearly);
}

TEST(ObjFreeForm, FacesAndSurfacesOfAPartAreOneMesh) {
    const Scene scene = TempFolder().load(
        "a.obj", "v 0 0 0 1 0 0\n" + grid(4, 4) + "f 1 2 3\n" + kBezier + surf(16) + kEnd);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.bicubics.size(), 1u);
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.colors.size(), mesh.positions.size());
    EXPECT_EQ(mesh.colors[mesh.primitives[0].corners[0]], Vec4(1, 0, 0, 1));
}

TEST(ObjFreeForm, WhatIsNotSupportedIsNamed) {
    struct Kind {
        std::string text, said;
    };
    const Kind table[] = {
        {"cstype bspline\ndeg 3 3\n" + surf(16) + kEnd, "surfaces of cstype bspline"},
        {"cstype rat bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\n"
         "parm u 0 0 0 0 1 1 1 1\nparm v 0 0 0 0 1 1 1 1\nend\n",
         "surfaces of cstype bspline"},
        {"cstype rat cardinal\ndeg 3 3\n" + surf(16) + kEnd, "surfaces of cstype cardinal"},
        {"cstype bmatrix\ndeg 3 3\nstep 3 3\nbmat u 1 0\n" + surf(16) + kEnd,
         "surfaces of cstype bmatrix"},
        {"cstype taylor\ndeg 3 3\n" + surf(16) + kEnd, "surfaces of cstype taylor"},
        {"cstype bezier\ndeg 2 2\n" + surf(9) + kEnd, "surfaces of degrees other than 3 3 (deg)"},
        {"deg 3 3\n" + surf(16) + kEnd, "surfaces without a cstype"},
        {"cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n", "curves (curv)"},
        {"vp 0 1\n", "statements \"vp\""},
        {kBezier + "bzp 1 2 3 4\n", "statements \"bzp\""},
        {"con 1 0 1 1 2 0 1 1\n", "statements \"con\""},
    };
    const TempFolder folder;
    for (const Kind& kind : table) {
        const std::string alone = fault_of_file(folder, "a.obj", grid(4, 4) + kind.text);
        EXPECT_NE(alone.find(kind.said + " are not supported"), std::string::npos) << alone;
        const Scene scene = folder.load("a.obj", grid(4, 4) + kind.text + "f 1 2 6\n");
        ASSERT_EQ(scene.warnings.size(), 1u) << kind.said;
        EXPECT_NE(scene.warnings[0].find(kind.said), std::string::npos) << scene.warnings[0];
    }
}

TEST(ObjFreeForm, ATrimmedSurfaceIsShownWholeWithAWarning) {
    const Scene scene = TempFolder().load(
        "a.obj", grid(4, 4) + kBezier + surf(16) + "parm u 0 1\ntrim 0 1 1\nend\n");
    EXPECT_EQ(scene.meshes.at(0).bicubics.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("a.obj:37: trims of surfaces (trim)"), std::string::npos)
        << scene.warnings[0];
}

TEST(ObjFreeForm, FaultsNameTheLine) {
    struct Wrong {
        std::string text, said;
    };
    const std::string rational = "cstype rat bezier\ndeg 3 3\n";
    const Wrong table[] = {
        {kBezier + surf(15) + kEnd,
         "a.obj:38: the surface of line 35 has 15 control points, not the 16 of 1 x 1 bicubic "
         "pieces"},
        {kBezier + surf(16) + "parm u 0 1 2 3\nend\n",
         "a.obj:37: the surface of line 35 is cut off: its u runs from 0 to 1, parm from 0 to 3"},
        {kBezier + surf(16) + "parm u 1 0\nend\n",
         "a.obj:37: parm: the values of the surface of line 35 do not increase"},
        {kBezier + surf(16) + "parm u 0\nend\n", "a.obj:36: parm: there are fewer than 2 values"},
        {kBezier + surf(16) + "parm w 0 1\nend\n", "a.obj:36: parm: \"w\" is neither u nor v"},
        {kBezier + surf(16), "a.obj:35: the surface has no \"end\""},
        {kBezier + surf(16) + surf(16), "a.obj:35: the surface has no \"end\""},
        {kBezier + "surf 0 1 0\n", "a.obj:35: v1 is missing"},
        {kBezier + "surf 0 1 0 1 17 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\n" + kEnd,
         "a.obj:35: a face names v 17, but there are 16"},
        {"cstype\n", "a.obj:33: cstype names no type"},
        {"v 0 0 0 0\n" + rational + "surf 0 1 0 1 -1 -1 -1 -1 -1 -1 -1 -1 1 1 1 1 1 1 1 1\n" + kEnd,
         "a.obj:36: control point 17 has the weight 0, not one from 0.01 to 100"},
        {"v 2e9 0 0\n" + kBezier + "surf 0 1 0 1 -1 -1 -1 -1 -1 -1 -1 -1 1 1 1 1 1 1 1 1\n" + kEnd,
         "a.obj:36: control point 17 has coordinates beyond 1e9"},
    };
    const TempFolder folder;
    for (const Wrong& wrong : table)
        EXPECT_EQ(fault_of_file(folder, "a.obj", grid(4, 4) + wrong.text), wrong.said)
            << wrong.text;
}

}  // namespace
}  // namespace chiaro
