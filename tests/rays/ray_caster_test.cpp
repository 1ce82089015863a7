#include "rays/ray_caster.h"

#include "rays/casting.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

using tiny::cast;
using tiny::random_direction;
using tiny::random_rays;

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
        std::vector<Rgb> through(n);
        caster.intersect({rays.data(), n}, hits);
        caster.transmittance({rays.data(), n}, through);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(hits[i].point.primitive, all[i].point.primitive);
            EXPECT_NEAR(hits[i].t, all[i].t, 1e-5f);
            EXPECT_EQ(through[i], Rgb(0));
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
    Rgb through[6];
    caster.intersect(rays, hits);
    caster.transmittance(rays, through);
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(bool(hits[i]), expected[i]) << i;
        EXPECT_EQ(through[i], Rgb(expected[i] ? 0.0f : 1.0f)) << i;
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

// Normals are of unit length and no ray breaks down however small or large the object is made: the
// squares of these normals are no floats.
TEST(RayCaster, AnySizeHasUnitNormals) {
    for (const float size : {1e-13f, 1e-10f, 1e-5f, 1e8f}) {
        Scene scene;
        const MaterialId white = tiny::add_material(scene, Rgb(1));
        const Mat4 turn = glm::rotate(Mat4(1), 0.7f, glm::normalize(Vec3(1, 2, 3)));
        const Mat4 scale = glm::scale(Mat4(1), Vec3(size));
        tiny::add_object(scene, tiny::box_mesh(Vec3(-1), Vec3(1), white, true), turn * scale);
        const RayCaster caster(scene, 1);
        const std::vector<Ray> rays = random_rays(100, Vec3(0));
        std::vector<Hit> hits(rays.size());
        caster.intersect(rays, hits);
        for (const Hit& hit : hits) {
            ASSERT_TRUE(hit);
            EXPECT_NEAR(glm::length(hit.normal), 1, 1e-5f) << size;
            EXPECT_TRUE(hit.front);
        }
    }
}

// A ray that starts at the offset from the surface point where another arrived does not meet that
// surface again: boxes of size 0.2 to 560 about the origin and far from it, turned so that no
// coordinate is exact; met from inside, and from as far as 3000 of their sizes, where the other
// ray's own length says little of the place.
TEST(RayCaster, OffsetIsEnough) {
    struct Case {
        float size, away, eye;
    };
    for (const auto& [size, away, eye] :
         {Case{1, 0, 0}, Case{28, 0, 0}, Case{280, 0, 0}, Case{1, 10, 0}, Case{280, 2800, 0},
          Case{0.1f, 0, 30}, Case{0.1f, 0, 300}, Case{0.1f, 5, 300}, Case{1, 0, 3000}}) {
        Scene scene;
        const MaterialId white = tiny::add_material(scene, Rgb(1));
        const Mat4 turn = glm::rotate(Mat4(1), 0.7f, glm::normalize(Vec3(1, 2, 3)));
        const Mat4 place = glm::translate(Mat4(1), Vec3(away));
        const bool inside = eye == 0;
        tiny::add_object(scene, tiny::box_mesh(Vec3(-size), Vec3(size), white, inside),
                         place * turn);
        const RayCaster caster(scene, 1);
        std::vector<Ray> rays = random_rays(10'000, Vec3(away));
        for (Ray& ray : rays)
            if (!inside) ray = {Vec3(away) - eye * ray.direction, ray.direction};
        std::vector<Hit> hits(rays.size());
        caster.intersect(rays, hits);
        Rng rng(9);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_TRUE(hits[i]);
            const Vec3 p = surface_position(scene, hits[i].point);
            Vec3 d = random_direction(rng);
            if (glm::dot(d, hits[i].normal) < 0) d = -d;
            rays[i] = {p + caster.offset(p, hits[i].point.object) * hits[i].normal, d};
        }
        std::vector<Hit> next(rays.size());
        caster.intersect(rays, next);
        int again = 0, through = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            again += next[i] && next[i].point.primitive == hits[i].point.primitive;
            through += inside ? !next[i] || !next[i].front : bool(next[i]);
        }
        EXPECT_EQ(again, 0) << size << " " << away << " " << eye;
        EXPECT_LE(through, 10) << size << " " << away << " " << eye;  // started beyond an edge
    }
}

// A primitive is flat if its normals are the geometric one, on whichever side: shading normals then
// need no interpolation. A third of a degree is not flat.
TEST(RayCaster, FlatPrimitivesHaveOneNormal) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(1));
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.primitives = {tiny::quad(0, 1, 2, 3, white)};
    const auto flat = [&](std::vector<Vec3> normals, float raised = 0) {
        Scene one = scene;
        Mesh m = mesh;
        m.positions[2].z = raised;
        m.normals = std::move(normals);
        tiny::add_object(one, m);
        return cast(RayCaster(one, 1), {{0.5f, 0.25f, 1}, {0, 0, -1}}).flat;
    };
    const Vec3 up(0, 0, 1);
    EXPECT_TRUE(flat({}));
    EXPECT_TRUE(flat({up, up, up, up}));
    EXPECT_TRUE(flat({-up, 2.0f * up, up, up}));
    EXPECT_FALSE(flat({up, up, glm::normalize(Vec3(0.006f, 0, 1)), up}));
    EXPECT_FALSE(flat({up, up, up, up}, 0.01f));  // a bent quad has two normals
}

}  // namespace
}  // namespace chiaro
