#include "rays/ray_caster.h"

#include "base/random.h"
#include "sample_renderer/tiny_scenes.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <cstring>

namespace chiaro {
namespace {

Vec3 random_direction(Rng& rng) {
    const float z = 2 * rng.uniform() - 1;
    const float phi = 2 * kPi * rng.uniform();
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

Hit cast(const RayCaster& caster, const Ray& ray, RayKind kind = RayKind::transport) {
    Hit hit;
    caster.intersect({&ray, 1}, {&hit, 1}, kind);
    return hit;
}

std::vector<Ray> random_rays(std::size_t count, Vec3 origin) {
    Rng rng(5);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) ray = {origin, random_direction(rng)};
    return rays;
}

// Bent quads, triangles, a turned, stretched and mirrored object.
Scene assorted() {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(0.8f));
    tiny::add_room(scene, Vec3(-3), Vec3(3), white);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1.2f, 1, 0.4f}, {0, 1, 0}, {0.5f, 0.5f, -1}};
    mesh.primitives = {tiny::triangle(0, 4, 1, white), tiny::quad(0, 1, 2, 3, white),
                       tiny::triangle(0, 3, 4, white)};
    const Mat4 turned = glm::rotate(Mat4(1), 1.1f, glm::normalize(Vec3(1, 2, 3)));
    tiny::add_object(scene, mesh, glm::translate(Mat4(1), Vec3(1.2f, 0, 0)) * turned);
    tiny::add_object(scene, mesh,
                     glm::translate(Mat4(1), Vec3(-2, 0, 0.3f)) *
                         glm::scale(Mat4(1), Vec3(-1, 2, 0.7f)) * turned);
    return scene;
}

// A hit's (object, primitive, u, v) is the place where the ray arrives, its normal that of the
// surface, and `front` the side: on quads of any shape, triangles, and whatever the transform.
TEST(RayCaster, HitsAgreeWithSurfaceGeometry) {
    const Scene scene = assorted();
    const RayCaster caster(scene, 1);
    const std::vector<Ray> rays = random_rays(20'000, {0.1f, 0.2f, 0.3f});
    std::vector<Hit> hits(rays.size());
    caster.intersect(rays, hits);
    int others = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(hits[i]);
        const SurfaceGeometry g = surface_geometry(scene, hits[i].point);
        EXPECT_LT(glm::length(g.position - (rays[i].origin + hits[i].t * rays[i].direction)),
                  1e-4f);
        EXPECT_GT(glm::dot(g.geometric_normal, hits[i].normal), 0.9999f);
        EXPECT_EQ(hits[i].front, glm::dot(g.geometric_normal, rays[i].direction) < 0);
        if (hits[i].point.object != ObjectId(0)) ++others;
    }
    EXPECT_GT(others, 1000);
}

// Packets of any size give the same hits, and no lane that is idle brings the process down.
TEST(RayCaster, AnyNumberOfRays) {
    const Scene scene = assorted();
    const RayCaster caster(scene, 1);
    const std::vector<Ray> rays = random_rays(33, Vec3(0));
    std::vector<Hit> all(rays.size());
    caster.intersect(rays, all);
    for (std::size_t n = 0; n <= rays.size(); ++n) {
        std::vector<Hit> hits(n);
        std::vector<std::uint8_t> blocked(n);
        caster.intersect({rays.data(), n}, hits);
        caster.occluded({rays.data(), n}, blocked);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(hits[i].point.primitive, all[i].point.primitive);
            EXPECT_NEAR(hits[i].t, all[i].t, 1e-5f);
            EXPECT_EQ(blocked[i], 1);
        }
    }
}

TEST(RayCaster, RaysThatMissAndEmptyRangesMissTogetherWithOthers) {
    Scene scene;
    tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, tiny::add_material(scene, Rgb(1)));
    const RayCaster caster(scene, 1);
    const Ray rays[] = {
        {{0.5f, 0.5f, 1}, {0, 0, -1}},          {{0.5f, 0.5f, 1}, {0, 0, 1}},
        {{0.5f, 0.5f, 1}, {0, 0, -1}, 0, 0.5f}, {{0.5f, 0.5f, 1}, {0, 0, -1}, 2, 1},
        {{0.5f, 0.5f, 1}, {0, 0, -1}, 1.5f},    {{0.5f, 0.5f, 1}, {0, 0, -4}, 0.1f, 0.5f}};
    const bool expected[] = {true, false, false, false, false, true};
    Hit hits[6];
    std::uint8_t blocked[6];
    caster.intersect(rays, hits);
    caster.occluded(rays, blocked);
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(bool(hits[i]), expected[i]) << i;
        EXPECT_EQ(blocked[i], expected[i]) << i;
    }
    EXPECT_FLOAT_EQ(hits[5].t, 0.25f);
}

TEST(RayCasterDeathTest, RefusesRaysThatAreNotFinite) {
    Scene scene;
    tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, tiny::add_material(scene, Rgb(1)));
    const RayCaster caster(scene, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_DEATH(cast(caster, {{0, nan, 0}, {0, 0, 1}}), "not finite");
    EXPECT_DEATH(cast(caster, {{0, 0, 0}, {kInfinity, 0, 1}}), "not finite");
}

TEST(RayCaster, CoherentRaysMeetTheSame) {
    const Scene scene = assorted();
    const RayCaster caster(scene, 1);
    const std::vector<Ray> rays = random_rays(1000, Vec3(0.4f));
    std::vector<Hit> one(rays.size()), other(rays.size());
    caster.intersect(rays, one);
    caster.intersect_coherent(rays, other);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_NEAR(one[i].t, other[i].t, 1e-5f);
}

TEST(RayCaster, EmptySceneMeetsNothing) {
    const Scene scene;
    const RayCaster caster(scene, 1);
    EXPECT_FALSE(cast(caster, {Vec3(0), {0, 0, 1}}));
}

// An object that moved is met where it is now.
TEST(RayCaster, MovedObjectsAreFollowed) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(1));
    tiny::add_box(scene, Vec3(-0.5f), Vec3(0.5f), white);
    tiny::add_box(scene, Vec3(4), Vec3(5), white);
    RayCaster caster(scene, 1);
    const Ray ray = {{0, 0, 10}, {0, 0, -1}};
    EXPECT_NEAR(cast(caster, ray).t, 9.5f, 1e-5f);
    scene.objects[0].to_world = glm::translate(Mat4(1), Vec3(3, 0, 0));
    caster.set_transform(ObjectId(0));
    EXPECT_FALSE(cast(caster, ray));
    scene.objects[0].to_world = glm::scale(Mat4(1), Vec3(-2));
    caster.set_transform(ObjectId(0));
    EXPECT_NEAR(cast(caster, ray).t, 9, 1e-5f);
    EXPECT_TRUE(cast(caster, ray).front);
}

// Mirrored objects keep their fronts (glTF 2.0, 3.7.4).
TEST(RayCaster, MirroredFrontsStayFronts) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(1));
    Mesh box = tiny::box_mesh(Vec3(-1), Vec3(1), white, false);
    tiny::add_object(scene, box, glm::scale(Mat4(1), Vec3(1, -1, 1)));
    const RayCaster caster(scene, 1);
    EXPECT_TRUE(cast(caster, {{5, 0.2f, 0.1f}, {-1, 0, 0}}).front);
    EXPECT_FALSE(cast(caster, {{0, 0.2f, 0.1f}, {-1, 0, 0}}).front);
}

// A ray that starts at the offset from where it arrived does not meet that surface again: rooms of
// size 2 to 560 about the origin and far from it, turned so that no coordinate is exact.
TEST(RayCaster, OffsetIsEnough) {
    for (const float size : {1.0f, 28.0f, 280.0f}) {
        for (const float away : {0.0f, 10.0f}) {
            Scene scene;
            const MaterialId white = tiny::add_material(scene, Rgb(1));
            const Mat4 turn = glm::rotate(Mat4(1), 0.7f, glm::normalize(Vec3(1, 2, 3)));
            const Mat4 place = glm::translate(Mat4(1), Vec3(away * size));
            tiny::add_object(scene, tiny::box_mesh(Vec3(-size), Vec3(size), white, true),
                             place * turn);
            const RayCaster caster(scene, 1);
            std::vector<Ray> rays = random_rays(10'000, Vec3(away * size));
            std::vector<Hit> hits(rays.size());
            caster.intersect(rays, hits);
            Rng rng(9);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_TRUE(hits[i]);
                const Vec3 p = rays[i].origin + hits[i].t * rays[i].direction;
                Vec3 d = random_direction(rng);
                if (glm::dot(d, hits[i].normal) < 0) d = -d;
                rays[i] = {p + caster.offset(p, hits[i].point.object) * hits[i].normal, d};
            }
            std::vector<Hit> next(rays.size());
            caster.intersect(rays, next);
            int again = 0, outside = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                again += next[i] && next[i].point.primitive == hits[i].point.primitive;
                outside += !next[i] || !next[i].front;
            }
            EXPECT_EQ(again, 0) << size << " " << away;
            EXPECT_LE(outside, 10) << size << " " << away;  // started beyond an edge of the room
        }
    }
}

// A blended pane of alpha 0.3 stops 30 % of transport rays, the same ones each time, and every
// layers ray. 20 000 rays: standard deviation 0.0032; bound 5 of them, false alarm 6e-7.
TEST(RayCaster, BlendStopsTheShareOfItsAlpha) {
    Scene scene;
    const MaterialId glass = tiny::add_material(scene, Rgb(1));
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].alpha = 0.3f;
    tiny::add_quad(scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, glass);
    const RayCaster caster(scene, 1);
    Rng rng(3);
    std::vector<Ray> rays(20'000);
    for (Ray& ray : rays) ray = {{rng.uniform(), 0, 1}, {rng.uniform(), rng.uniform(), -1}};
    std::vector<Hit> hits(rays.size()), layers(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    caster.intersect(rays, hits);
    caster.intersect(rays, layers, RayKind::layers);
    caster.occluded(rays, blocked);
    int stopped = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        stopped += bool(hits[i]);
        EXPECT_EQ(bool(hits[i]), blocked[i] != 0);
        EXPECT_TRUE(layers[i]);
        EXPECT_EQ(bool(cast(caster, rays[i])), bool(hits[i]));
    }
    EXPECT_NEAR(double(stopped) / double(rays.size()), 0.3, 0.0162);
}

// Two panes let through the product of what each does. Standard deviation 0.0035; bound 5 of them.
TEST(RayCaster, PanesDecideIndependently) {
    Scene scene;
    const MaterialId glass = tiny::add_material(scene, Rgb(1));
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].alpha = 0.4f;
    for (const float z : {0.0f, -1.0f})
        tiny::add_quad(scene, {-50, -50, z}, {100, 0, 0}, {0, 100, 0}, glass);
    const RayCaster caster(scene, 1);
    Rng rng(4);
    std::vector<Ray> rays(20'000);
    for (Ray& ray : rays) ray = {{0, 0, 1}, {rng.uniform(), rng.uniform(), -1}};
    std::vector<std::uint8_t> blocked(rays.size());
    caster.occluded(rays, blocked);
    double through = 0;
    for (const std::uint8_t b : blocked) through += b == 0;
    EXPECT_NEAR(through / double(rays.size()), 0.36, 0.017);
}

// A masked quad, opaque where its texture's alpha reaches the cutoff, is a hole elsewhere; also on
// a moved instance and among quads and triangles of one mesh.
TEST(RayCaster, MaskHasHoles) {
    Scene scene;
    const MaterialId lace = tiny::add_material(scene, Rgb(1));
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.nearest = true;
    texture.texels = {{255, 255, 255, 0}, {255, 255, 255, 255}};
    scene.textures.push_back(texture);
    scene.materials[0].alpha_mode = AlphaMode::mask;
    scene.materials[0].base_color_texture.texture = TextureId(0);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
    mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {0, 0}};
    mesh.primitives = {tiny::quad(0, 1, 2, 3, lace), tiny::triangle(1, 4, 5, lace)};
    tiny::add_object(scene, mesh, glm::translate(Mat4(1), Vec3(0, 5, 0)));
    const RayCaster caster(scene, 1);
    const auto meets = [&](float x, float y) {
        return bool(cast(caster, {{x, 5 + y, 1}, {0, 0, -1}}));
    };
    EXPECT_FALSE(meets(0.25f, 0.5f));
    EXPECT_TRUE(meets(0.75f, 0.5f));
    EXPECT_TRUE(meets(1.1f, 0.05f));   // the triangle, near where its u is 1
    EXPECT_FALSE(meets(1.9f, 0.05f));  // and far from there
}

}  // namespace
}  // namespace chiaro
