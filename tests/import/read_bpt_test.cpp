// Files of Bezier patches: what is in them, and what is refused.
#include "import/import_testing.h"
#include "scene/bicubic.h"

namespace chiaro {
namespace {

// The patch whose control point (i, j) is (i, j, z).
std::string flat_patch(const std::string& z, const std::string& degrees = "3 3") {
    std::string text = degrees + "\n";
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            text += std::to_string(i) + " " + std::to_string(j) + " " + z + "\n";
    return text;
}

TEST(ReadBpt, TheFirstPointsRunAlongUAndTheFrontFacesDuCrossDv) {
    const Scene scene = TempFolder().load("sheet.bpt", "1\n" + flat_patch("5"));
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "sheet");
    EXPECT_EQ(scene.materials.at(0).name, "default");
    ASSERT_EQ(scene.meshes[0].bicubics.size(), 1u);
    const BicubicPatch& patch = scene.meshes[0].bicubics[0];
    EXPECT_EQ(patch.place(1, 0), Vec3(1, 0, 5));
    EXPECT_EQ(patch.place(0, 2), Vec3(0, 2, 5));
    EXPECT_EQ(patch_normal(patch, Vec2(0.5f)), Vec3(0, 0, 1));
}

TEST(ReadBpt, FaultsNameTheLine) {
    struct Wrong {
        std::string text, said;
    };
    const std::string one = flat_patch("0");
    const Wrong table[] = {
        {"# nothing\n", "a.bpt: the number of patches is missing"},
        {"0\n", "a.bpt:1: \"0\" is not a number of patches"},
        {"-1\n" + one, "a.bpt:1: \"-1\" is not a number of patches"},
        {"1.5\n" + one, "a.bpt:1: \"1.5\" is not a number of patches"},
        {"99999999999999999999999\n" + one,
         "a.bpt:1: \"99999999999999999999999\" is not a number of patches"},
        {"1 2\n" + one, "a.bpt:1: \"2\" is one word too many"},
        {"2\n" + one, "a.bpt: the file ends in patch 2 of 2"},
        {"18446744073709551615\n" + one, "a.bpt: the file ends in patch 2 of 18446744073709551615"},
        {"1\n" + one + one, "a.bpt:19: more follows the 1 patches"},
        {"1\n" + flat_patch("0", "2 3"),
         "a.bpt:2: the degrees of patch 1 are \"2 3\": only bicubic patches, 3 3, are supported"},
        {"1\n" + flat_patch("nan"), "a.bpt:3: z: \"nan\" is not finite"},
        {"1\n" + flat_patch(""), "a.bpt:3: z is missing"},
        {"1\n" + flat_patch("0 1"), "a.bpt:3: \"1\" is one word too many"},
        {"1\n" + flat_patch("x"), "a.bpt:3: z: \"x\" is not a number"},
        {"1\n" + flat_patch("1e30"), "a.bpt:3: a control point lies beyond 1e9"},
        {"1\n3 3\n0 0 0\n", "a.bpt: the file ends in patch 1 of 1"},
    };
    const TempFolder folder;
    for (const Wrong& wrong : table)
        EXPECT_EQ(fault_of_file(folder, "a.bpt", wrong.text), wrong.said) << wrong.text;
}

TEST(ReadBpt, APatchWithoutAreaIsLeftOut) {
    std::string point = "1\n3 3\n";
    for (int k = 0; k < 16; ++k) point += "1 2 3\n";
    const Scene scene = TempFolder().load("a.bpt", point);
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_EQ(scene.warnings.size(), 2u);
}

}  // namespace
}  // namespace chiaro
