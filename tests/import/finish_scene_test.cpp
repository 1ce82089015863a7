// The last steps of every import, on scenes made in memory.
#include "import/finish_scene.h"

#include "import/import_testing.h"
#include "scene/bicubic_mesh.h"
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

// A patch reaches no further than its control points, and those count: corners alone may be near.
TEST(FinishScene, ControlPointsMayBeNoFartherThanCorners) {
    std::array<Vec3, 16> points;
    for (int k = 0; k < 16; ++k) points[k] = Vec3(k % 4, k / 4, 0);
    points[5].z = 9e8f;
    const auto scene_of = [&](const Mat4& to_world) {
        Scene scene;
        scene.materials.emplace_back();
        add_bicubic(scene.meshes.emplace_back(), make_bicubic(points), MaterialId{0});
        scene.objects.push_back({"sheet", MeshId{0}, to_world});
        return scene;
    };
    const auto fault = [](Scene scene, const LoadOptions& options = {}) {
        return fault_of([&] { finish_scene(scene, options, "sheet.bpt"); });
    };
    EXPECT_EQ(fault(scene_of(Mat4(1))), "");
    EXPECT_NE(fault(scene_of(Mat4(1)), {.scale = 1.2f}).find("beyond 1e9"), std::string::npos);
    points[5].z = 1.1e9f;
    EXPECT_NE(fault(scene_of(Mat4(1))).find("\"sheet\" has coordinates beyond 1e9"),
              std::string::npos);
}

}  // namespace
}  // namespace chiaro
