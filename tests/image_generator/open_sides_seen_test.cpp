// What a view learns of the insides of solids.
#include "image_generator/looking.h"
#include "scene/curved_shapes.h"
#include "scene/make_material.h"
#include "scene/shapes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

// Two polished balls that grow out of each other. Rays leave each of them from a little above it,
// all the more where curved surfaces are drawn coarsely, and at the seam that is inside of the
// other: what polish shows from there does not make an inside open.
TEST(OpenSidesSeen, PolishDoesNotSeeTheOutsideFromWithinASolid) {
    Scene scene;
    const MaterialId glaze = glossy(scene, "Glaze", Rgb(0.8f), 0.1f);
    for (const float x : {-0.7f, 0.7f}) {
        Mesh mesh;
        add(mesh, curved_sphere(1), glaze);
        add_object(scene, std::move(mesh), moved({x, 0, 0}));
    }
    Looking l(std::move(scene), 200, 200, {0, 0, 1.5f});
    const RayCaster coarse(l.scene, 1, 0.01f);
    OpenSides open(l.scene);
    make_id_map(l.cache, coarse, l.view, {}, &open);
    for (std::uint32_t ball = 0; ball < 2; ++ball)
        for (std::uint32_t patch = 0; patch < 8; ++patch)
            EXPECT_TRUE(open.is_inside(ObjectId{ball}, patch, false)) << ball << " " << patch;
}

}  // namespace
}  // namespace chiaro
