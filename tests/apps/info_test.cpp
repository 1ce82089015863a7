// What `chiaro info` says of a scene's primitives.
#include "apps/command.h"

namespace chiaro {
namespace {

// A triangle, a quad and a bicubic patch.
std::string one_of_each() {
    std::string text = "v 0 0 1\nv 3 0 1\nv 3 3 1\nv 0 3 1\nf 1 2 3\nf 1 2 3 4\n";
    for (int k = 0; k < 16; ++k)
        text += "v " + std::to_string(k % 4) + " " + std::to_string(k / 4) + " 0\n";
    return text +
           "cstype bezier\ndeg 3 3\n"
           "surf 0 1 0 1 -16 -15 -14 -13 -12 -11 -10 -9 -8 -7 -6 -5 -4 -3 -2 -1\nend\n";
}

TEST(Info, PrimitivesAreCountedByKind) {
    const TempFolder folder;
    const std::string file = folder.write("kinds.obj", one_of_each()).string();
    const auto j = nlohmann::json::parse(expect_done({"info", "--json", file}).out);
    EXPECT_EQ(j["primitives"], 3);
    EXPECT_EQ(j["bicubic_patches"], 1);
    EXPECT_EQ(j["bezier_patches"], 1);
    EXPECT_EQ(j["quads"], 1);
    EXPECT_EQ(j["triangles"], 1);
    EXPECT_NE(expect_done({"info", file}).out.find("1 quads, 1 triangles, 1 bicubic patches"),
              std::string::npos);
}

// A square, as it is and as a cage.
TEST(Info, SubdivideMakesPatchesOfPolygons) {
    const TempFolder folder;
    const std::string file =
        folder.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").string();
    const auto count = [&](const Arguments& arguments) {
        return nlohmann::json::parse(expect_done(arguments).out)["bicubic_patches"].get<int>();
    };
    EXPECT_EQ(count({"info", "--json", file}), 0);
    EXPECT_EQ(count({"info", "--json", file, "--subdivide"}), 1);
}

}  // namespace
}  // namespace chiaro
