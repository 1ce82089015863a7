// The last steps of every import, on scenes made in memory.
#include "import/finish_scene.h"

#include "import/import_testing.h"
#include "scene/scene.h"

namespace chiaro {
namespace {

// A sheet of 4096 triangles, shown so many times in one place.
Scene repeated(std::size_t times) {
    Scene scene;
    scene.materials.emplace_back();
    Mesh sheet;
    sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    sheet.primitives.assign(4096, {{0, 1, 2, Primitive::kNoCorner}, MaterialId{0}});
    scene.meshes.push_back(std::move(sheet));
    scene.objects.assign(times, {.name = "sheet", .mesh = MeshId{0}});
    return scene;
}

// Sides of surfaces have numbers of 28 bits: 2^27 triangles are taken, more are refused, and no
// check ends the program.
TEST(FinishScene, TooManyPolygonsAreRefused) {
    Scene most = repeated(kMostPrimitives / 4096);
    EXPECT_EQ(fault_of([&] { finish_scene(most, {}, "room.obj"); }), "");
    Scene more = repeated(kMostPrimitives / 4096 + 1);
    const std::string fault = fault_of([&] { finish_scene(more, {}, "room.obj"); });
    EXPECT_TRUE(fault.starts_with("room.obj: 134221824 polygons")) << fault;
    EXPECT_NE(fault.find("leave out"), std::string::npos) << fault;
}

}  // namespace
}  // namespace chiaro
