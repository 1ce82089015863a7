#include "rays/casting.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// A log holds every ray that is cast while it is kept, in packets of 16, and no other.
TEST(RayLog, HoldsEveryRayOnce) {
    Scene scene;
    tiny::add_quad(scene, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, tiny::add_material(scene, Rgb(1)));
    RayCaster caster(scene, 1);
    std::vector<Ray> rays = tiny::random_rays(37, Vec3(0));
    rays[5].t_max = -1;  // never cast
    std::vector<Hit> hits(rays.size());
    std::vector<Rgb> through(rays.size());

    RayLog log;
    caster.intersect(rays, hits);
    caster.record(&log);
    caster.intersect(rays, hits);
    caster.intersect_coherent(rays, hits);
    caster.transmittance(rays, through);
    caster.record(nullptr);
    caster.intersect(rays, hits);
    ASSERT_EQ(log.packets.size(), 9u);
    EXPECT_EQ(log.rays(), 3 * 36u);
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_EQ(log.packets[i].coherent, i >= 3 && i < 6);
        EXPECT_EQ(log.packets[i].occlusion, i >= 6);
        EXPECT_EQ(log.packets[i].direction[1][3], rays[16 * (i % 3) + 3].direction.y);
    }
    EXPECT_GE(replay(caster, log.packets), 0);
}

}  // namespace
}  // namespace chiaro
