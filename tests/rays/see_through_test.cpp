// Surfaces that rays pass: blended, masked, and single-sided ones from behind.
#include "rays/casting.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

using tiny::cast;

Scene panes(std::initializer_list<float> heights, float alpha) {
    Scene scene;
    const MaterialId glass = tiny::add_material(scene, Rgb(1));
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].alpha = alpha;
    for (const float z : heights)
        tiny::add_quad(scene, {-50, -50, z}, {100, 0, 0}, {0, 100, 0}, glass);
    return scene;
}

std::vector<Ray> rays_down(std::size_t count, std::uint64_t seed) {
    Rng rng(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) ray = {{rng.uniform(), 0, 1}, {rng.uniform(), rng.uniform(), -1}};
    return rays;
}

double part_stopped(const RayCaster& caster, std::span<const Ray> rays) {
    std::vector<Hit> hits(rays.size());
    caster.intersect(rays, hits);
    double stopped = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        stopped += bool(hits[i]);
        EXPECT_EQ(bool(cast(caster, rays[i])), bool(hits[i]));  // the same ones each time
    }
    return stopped / static_cast<double>(rays.size());
}

// A blended pane of alpha 0.3 stops 30 % of transport rays; two panes let through the product of
// what each does. 20 000 rays: standard deviation 0.0032 and 0.0034; bound 5 of them, false alarm
// 6e-7.
TEST(SeeThrough, BlendStopsTheShareOfItsAlpha) {
    const Scene one = panes({0}, 0.3f), two = panes({0, -1}, 0.4f);
    EXPECT_NEAR(part_stopped(RayCaster(one, 1), rays_down(20'000, 3)), 0.3, 0.0162);
    EXPECT_NEAR(part_stopped(RayCaster(two, 1), rays_down(20'000, 4)), 0.64, 0.0170);
}

// Light through blended panes is the product of what each leaves, along every single ray, whether
// they lie apart or in one place; through anything opaque there is none.
TEST(SeeThrough, TransmittanceIsTheProductOfWhatPanesLeave) {
    for (const float second : {-1.0f, 0.0f}) {
        Scene scene = panes({0, second}, 0.4f);
        const std::vector<Ray> rays = rays_down(1000, 5);
        std::vector<Rgb> through(rays.size());
        RayCaster(scene, 1).transmittance(rays, through);
        for (const Rgb& t : through) EXPECT_NEAR(t.g, 0.36f, 1e-6f);

        scene.materials[0].alpha = 1;
        RayCaster(scene, 1).transmittance(rays, through);
        for (const Rgb& t : through) EXPECT_EQ(t, Rgb(0));
    }
    Scene blocked = panes({0, -1}, 0.4f);
    tiny::add_quad(blocked, {-50, -50, -2}, {100, 0, 0}, {0, 100, 0},
                   tiny::add_material(blocked, Rgb(1)));
    std::vector<Rgb> through(100);
    RayCaster(blocked, 1).transmittance(rays_down(100, 5), through);
    for (const Rgb& t : through) EXPECT_EQ(t, Rgb(0));
}

// A surface counts once a ray, also where its primitives meet and Embree tells of each: on the
// diagonal of a quad, on the edge of two triangles, and at a corner that eight share.
TEST(SeeThrough, SeamsOfASurfaceCountOnce) {
    Scene scene;
    const MaterialId glass = tiny::add_material(scene, Rgb(1));
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].alpha = 0.4f;
    Mesh fan;
    fan.positions = {{0, 0, 0},  {1, 0, 0},   {1, 1, 0},  {0, 1, 0}, {-1, 1, 0},
                     {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}};
    for (std::uint32_t i = 0; i < 8; ++i)
        fan.primitives.push_back(tiny::triangle(0, 1 + i, 1 + (i + 1) % 8, glass));
    tiny::add_object(scene, fan);
    tiny::add_quad(scene, {-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, glass);
    const RayCaster caster(scene, 1);
    std::vector<Ray> rays;
    for (int i = -9; i <= 9; ++i) {
        const float x = 0.1f * static_cast<float>(i);
        for (const Vec2 p : {Vec2(x, 0), Vec2(0, x), Vec2(x, x), Vec2(x, -x), Vec2(0)}) {
            rays.push_back({{p, 3}, {0, 0, -1}});  // along the axis, each to its place
            rays.push_back({{0, 0, 3}, Vec3(p, 0) - Vec3(0, 0, 3)});  // from one lamp
        }
    }
    std::vector<Rgb> through(rays.size());
    caster.transmittance(rays, through);
    std::vector<LayerHit> layers;
    caster.intersect_layers(rays, layers);
    EXPECT_EQ(layers.size(), 2 * rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
        EXPECT_NEAR(through[i].g, 0.36f, 1e-6f) << rays[i].origin.x << " " << rays[i].direction.x;
}

// Layers come front to back, ray by ray, also those in one place, up to the surface that stops the
// ray; behind it there is nothing.
TEST(SeeThrough, LayersAreFrontToBack) {
    Scene scene = panes({0, -1, 0.5f, -1, -5}, 0.4f);
    const MaterialId wall = tiny::add_material(scene, Rgb(1));
    tiny::add_quad(scene, {-50, -50, -2}, {100, 0, 0}, {0, 100, 0}, wall);
    const RayCaster caster(scene, 1);
    const std::vector<Ray> rays = rays_down(33, 6);
    std::vector<LayerHit> layers;
    caster.intersect_layers(rays, layers);
    ASSERT_EQ(layers.size(), 5 * rays.size());
    for (std::uint32_t i = 0; i < layers.size(); ++i) {
        EXPECT_EQ(layers[i].ray, i / 5);
        const std::uint32_t expected[] = {2, 0, 1, 3, 5};  // objects
        EXPECT_EQ(layers[i].hit.point.object, ObjectId(expected[i % 5]));
        const float t[] = {0.5f, 1, 2, 2, 3};
        EXPECT_NEAR(layers[i].hit.t, t[i % 5], 1e-5f);
    }
}

// Of forty panes the nearest 32 show.
TEST(SeeThrough, TheNearestLayersShow) {
    Scene scene;
    const MaterialId glass = tiny::add_material(scene, Rgb(1));
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].alpha = 0.1f;
    for (int i = 0; i < 40; ++i)
        tiny::add_quad(scene, {-9, -9, -float((i * 7) % 40)}, {18, 0, 0}, {0, 18, 0}, glass);
    std::vector<LayerHit> layers;
    const Ray ray = {{0.1f, 0.2f, 1}, {0, 0, -1}};
    RayCaster(scene, 1).intersect_layers({&ray, 1}, layers);
    ASSERT_EQ(layers.size(), kMostLayers);
    for (std::uint32_t i = 0; i < kMostLayers; ++i)
        EXPECT_NEAR(layers[i].hit.t, 1 + float(i), 1e-4f);
}

// Two single-sided faces back to back, as a file without double-sided materials has a sheet: the
// camera sees the one that faces it, from either side and whichever it meets first, also on a
// mirrored object. To all other rays either stops.
TEST(SeeThrough, CameraSeesTheFrontOfCoincidentFaces) {
    for (const float mirror : {1.0f, -1.0f}) {
        Scene scene;
        const MaterialId paper = tiny::add_material(scene, Rgb(1));
        scene.materials[0].double_sided = false;
        Mesh sheet;
        sheet.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        sheet.primitives = {tiny::quad(0, 1, 2, 3, paper), tiny::quad(3, 2, 1, 0, paper)};
        tiny::add_object(scene, sheet, glm::scale(Mat4(1), Vec3(mirror, 1, 1)));
        const RayCaster caster(scene, 1);
        Rng rng(7);
        for (int i = 0; i < 200; ++i) {
            const float z = i % 2 == 0 ? 1.0f : -1.0f;
            const Ray ray = {{rng.uniform() - 0.5f, rng.uniform() - 0.5f, z}, {0, 0, -z}};
            const Hit hit = cast(caster, ray, RayKind::camera);
            ASSERT_TRUE(hit);
            EXPECT_TRUE(hit.front);
            EXPECT_EQ(hit.normal.z, z);
            std::vector<LayerHit> layers;
            caster.intersect_layers({&ray, 1}, layers);
            ASSERT_EQ(layers.size(), 1u);
            EXPECT_EQ(layers[0].hit.point.primitive, hit.point.primitive);
            EXPECT_TRUE(cast(caster, ray));
        }
    }
}

// A masked quad, opaque where its texture's alpha reaches the cutoff, is a hole elsewhere; also on
// a moved instance and among quads and triangles of one mesh.
TEST(SeeThrough, MaskHasHoles) {
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
