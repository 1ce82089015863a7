// Curved surfaces as a view shows them (3.3).
#include "image_generator/view_curves.h"

#include "image_generator/looking.h"
#include "scene/curved_shapes.h"
#include "scene/shapes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using tiny::Looking;

Scene ball(Vec3 centre, float radius) {
    Scene scene;
    const MaterialId m = tiny::add_material(scene, Rgb(0.5f));
    Mesh mesh;
    add(mesh, curved_sphere(radius), m);
    tiny::add_object(scene, std::move(mesh), moved(centre));
    return scene;
}

// Whether a ray meets a ball, exactly, with its radius grown by `more`.
bool meets(const Ray& ray, Vec3 centre, float radius, float more) {
    const Vec3 to = centre - ray.origin;
    const float along = glm::dot(to, ray.direction);
    const float squared = glm::dot(to, to) - along * along;
    const float grown = radius + more;
    return along > 0 && grown > 0 && squared < grown * grown;
}

// The outline of a ball is a circle from any distance: near enough to fill the picture and more,
// and of a few pixels. No ray farther than half a pixel from the true outline is wrong about it,
// and without tessellation for the view some are.
TEST(ViewCurves, OutlinesAreRoundAtAnyDistance) {
    constexpr int kSize = 1024;
    for (const float distance : {0.02f, 0.2f, 1.0f, 40.0f}) {
        // The outline runs through the picture's middle.
        const float angle = std::asin(1 / (1 + distance));
        const Vec3 centre =
            Vec3(0, 0, 4) + (1 + distance) * Vec3(std::sin(angle), 0, -std::cos(angle));
        Looking looking(ball(centre, 1), kSize, kSize);
        std::vector<Ray> rays;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                rays.push_back(
                    looking.view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const float pixel = glm::distance(rays[0].direction, rays[1].direction);
        const auto wrong = [&] {
            std::vector<Hit> hits(rays.size());
            looking.caster.intersect_coherent(rays, hits, RayKind::camera);
            int count = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const float at = glm::distance(centre, rays[i].origin);
                const float half = 0.5f * pixel * std::sqrt(std::max(0.0f, at * at - 1));
                const bool met{hits[i]};
                count += met != meets(rays[i], centre, 1, met ? half : -half);
            }
            return count;
        };
        const int before = wrong();
        const std::size_t triangles = show_curves(looking.caster, looking.view, 2);
        EXPECT_EQ(wrong(), 0) << distance;
        if (distance < 0.1f) {
            EXPECT_GT(before, 0) << distance;
        }
        if (distance > 10) {
            EXPECT_EQ(triangles, 0u);  // what other rays see is fine enough
        }
    }
}

// What is out of view is left as it is.
TEST(ViewCurves, OnlyWhatIsInViewIsDivided) {
    Looking behind(ball({0, 0, 5.5f}, 1), 512, 512);
    EXPECT_EQ(show_curves(behind.caster, behind.view, 1), 0u);
    Looking ahead(ball({0, 0, 2.5f}, 1), 512, 512);
    EXPECT_GT(show_curves(ahead.caster, ahead.view, 1), 1000u);
}

}  // namespace
}  // namespace chiaro
