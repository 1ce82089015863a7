// What is seen in mirrors and glass.
#include "image_generator/looking.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

RayViewSettings one_ray() {
    RayViewSettings settings;
    settings.quality = ViewQuality::one_ray;
    return settings;
}
IdMap map_of(Looking& l, const RayViewSettings& settings = one_ray()) {
    return make_id_map(l.cache, l.caster, l.view, settings, nullptr);
}

// Reflectance, times pi, of the fragments of a pixel that lie on an object of one primitive.
float seen_of(Looking& l, const IdMap& map, int x, int y, ObjectId object) {
    const PatchId root = l.cache.root(object, 0, true);
    const std::uint32_t primitive = l.cache.surface_side(root) / 2;
    float sum = 0;
    for (const Fragment& f : map.at_pixel(static_cast<std::uint32_t>(y * map.width + x)))
        if (l.cache.surface_side(f.patch) / 2 == primitive) sum += f.reflectance.g * kPi;
    return sum;
}

// A room with a box in it and a mirror in the plane z = -3 that reflects 0.9, all single-sided.
Scene mirrored_room() {
    Scene scene;
    add_room(scene, {-3, -2, -3.5f}, {3.1f, 2.2f, 5}, add_material(scene, {0.8f, 0.6f, 0.4f}));
    add_box(scene, {-1, -2, -2}, {0.7f, 0.3f, -1}, add_material(scene, {0.3f, 0.6f, 0.7f}));
    const MaterialId mirror_material = add_glossy(scene, Rgb(0), mirror(Rgb(0.9f)));
    for (Material& m : scene.materials) m.double_sided = false;
    add_quad(scene, {-2.9f, -1.9f, -3}, {5.9f, 0, 0}, {0, 4, 0}, mirror_material);
    return scene;
}

// From behind, the eye's image sees through the mirror what the eye sees in it, left and right
// exchanged and 1 / 0.9 times as bright. Places agree to the rounding of 10 units.
TEST(Mirrors, AFlatMirrorShowsTheViewOfTheMirroredEye) {
    Looking l(mirrored_room(), 41, 31, {0, 0, 2}, {0, 0, -3});
    const IdMap seen = map_of(l);
    l.view = View({.eye = {0, 0, -8}, .target = {0, 0, -3}, .vertical_fov = 90}, 41, 31);
    const IdMap direct = map_of(l);
    int compared = 0;
    // The pixels whose rays meet the mirror before the box and the walls.
    for (int y = 11; y < 20; ++y)
        for (int x = 25; x < 29; ++x) {
            const auto in_mirror = seen.at_pixel(static_cast<std::uint32_t>(y * 41 + x));
            const auto straight = direct.at_pixel(static_cast<std::uint32_t>(y * 41 + 40 - x));
            ASSERT_EQ(in_mirror.size(), 1u);
            ASSERT_EQ(straight.size(), 1u);
            EXPECT_EQ(in_mirror[0].patch, straight[0].patch);
            EXPECT_LT(glm::distance(in_mirror[0].local, straight[0].local), 1e-5f);
            EXPECT_LT(glm::distance(in_mirror[0].reflectance, 0.9f * straight[0].reflectance),
                      1e-6f);
            ++compared;
        }
    EXPECT_EQ(compared, 36);
}

// A mirror of Ks 0.9 has no diffuse light: nothing lies on it, and what lies on what it shows sums
// to 0.9 where the room is closed, at outlines too.
TEST(Mirrors, APictureInAMirrorIsWhole) {
    Looking l(mirrored_room(), 41, 31, {0, 0, 2}, {0, 0, -3});
    for (std::size_t m = 0; m < 2; ++m) l.scene.materials[m].base_color = Rgb(1);
    const IdMap map = map_of(l, {});
    int in_mirror = 0;
    for (int y = 0; y < 31; ++y)
        for (int x = 0; x < 41; ++x) {
            const float sum = kPi * covered(map, x, y).g;
            EXPECT_TRUE(sum > 0.9f - 1e-5f && sum < 1 + 1e-5f) << sum;
            in_mirror += std::abs(sum - 0.9f) < 1e-5f ? 1 : 0;
        }
    EXPECT_GT(in_mirror, 100);
    for (const Fragment& f : map.fragments) EXPECT_NE(l.cache.surface_side(f.patch) / 2, 12u);
}

// An edge seen in a mirror covers its part of a pixel, within 1/16.
TEST(Mirrors, OutlinesInMirrorsAreBlendedInProportion) {
    for (int step = 0; step <= 10; ++step) {
        const float part = static_cast<float>(step) / 10;
        Scene scene;
        add_wall(scene, 0, -50, 50, add_glossy(scene, Rgb(0), mirror(Rgb(1))));
        // Behind the eye at z = 4: in the mirror 20 units away, where a pixel is 8/3 wide.
        const float edge = (2 * part - 1) * 4 / 3;
        add_wall(scene, 16, -90, edge, add_material(scene, Rgb(1)), -90, 80);
        Looking l(std::move(scene), 15, 15);
        EXPECT_NEAR(kPi * covered(map_of(l, {}), 7, 7).g, part, 1.0f / 16) << part;
    }
}

// A lamp in a mirror is as bright as the mirror reflects.
TEST(Mirrors, ShowEmission) {
    Scene scene;
    add_wall(scene, 0, -50, 50, add_glossy(scene, Rgb(0), mirror({0.9f, 0.5f, 0.1f})));
    add_wall(scene, 16, -50, 50, add_material(scene, Rgb(0), Rgb(10)));
    Looking l(std::move(scene), 15, 15);
    l.scene.materials[1].emits_backward = true;
    const Rgb shown = map_of(l, {}).background.at(3, 4);
    EXPECT_LT(glm::distance(shown, Rgb(9, 5, 1)), 1e-4f);
}

// As the sky in one.
TEST(Mirrors, ShowTheEnvironment) {
    Scene scene;
    scene.environment.sky = Rgb(10);
    add_wall(scene, 0, -50, 50, add_glossy(scene, Rgb(0), mirror({0.9f, 0.5f, 0.1f})));
    Looking l(std::move(scene), 15, 15);
    for (const Rgb& shown : map_of(l, {}).background.pixels)
        EXPECT_LT(glm::distance(shown, Rgb(9, 5, 1)), 1e-4f);
}

// Layers in a mirror are composited as those before the eye: 1/4, 3/16, and the wall 9/16.
TEST(Mirrors, BlendedSurfacesInMirrorsAreComposited) {
    Scene scene;
    add_wall(scene, 0, -50, 50, add_glossy(scene, Rgb(0), mirror(Rgb(1))));
    const MaterialId sheet = add_material(scene, Rgb(1));
    scene.materials[index_of(sheet)].alpha_mode = AlphaMode::blend;
    scene.materials[index_of(sheet)].alpha = 0.25f;
    for (const float z : {5.0f, 6.0f}) add_wall(scene, z, -50, 50, sheet);
    const ObjectId wall = add_wall(scene, 7, -50, 50, add_material(scene, Rgb(1)));
    Looking l(std::move(scene), 15, 15);
    const IdMap map = map_of(l);
    EXPECT_NEAR(seen_of(l, map, 7, 7, ObjectId{1}), 0.25f, 1e-5f);
    EXPECT_NEAR(seen_of(l, map, 7, 7, ObjectId{2}), 3.0f / 16, 1e-5f);
    EXPECT_NEAR(seen_of(l, map, 7, 7, wall), 9.0f / 16, 1e-5f);
}

// A single-sided face, invisible to the camera from behind, has a back in a mirror; seen straight
// through a pane it has none.
TEST(Mirrors, SingleSidedFacesHaveBacksInMirrorsButNotBehindPanes) {
    for (const bool pane : {false, true}) {
        Scene scene;
        const MaterialId first = add_glossy(scene, Rgb(1), pane ? glass(0, true) : mirror(Rgb(1)));
        scene.materials[0].base_color = pane ? Rgb(1) : Rgb(0);
        add_wall(scene, 0, -50, 50, first);
        const float away = pane ? -1.0f : 1.0f;
        const MaterialId sheet = add_material(scene, Rgb(1));
        scene.materials[index_of(sheet)].double_sided = false;
        const float z = pane ? -2.0f : 6.0f;
        // Its front is away from whoever looks.
        const Vec3 up(0, 91.7f, 0);
        const ObjectId face = add_quad(scene, {-50 * away, -50, z}, {100 * away, 0, 0}, up, sheet);
        Looking l(std::move(scene), 15, 15);
        EXPECT_NEAR(seen_of(l, map_of(l), 7, 7, face), pane ? 0 : 1, 1e-5f);
    }
}

// Two mirrors face each other and reflect all: chains end after 16 surfaces, of which 15 show a
// little diffuse light and the last too.
TEST(Mirrors, ChainsEnd) {
    Scene scene;
    const MaterialId mirror_material = add_glossy(scene, Rgb(0.1f), mirror(Rgb(1)));
    scene.materials[0].base_color = Rgb(0.1f);
    scene.materials[0].gloss.specular = Rgb(0.99f);
    add_wall(scene, 0, -50, 50, mirror_material);
    add_wall(scene, 6, -50, 50, mirror_material);
    Looking l(std::move(scene), 15, 15);
    EXPECT_EQ(map_of(l).at_pixel(7 * 15 + 7).size(), 16u);
}

// A clear pane of index 1.5 at normal incidence reflects 2 R / (1 + R), R = 0.04, and lets the rest
// through straight on; a tinted one lets less of some colours through.
TEST(Glass, APaneShowsBothItsSides) {
    for (const Rgb tint : {Rgb(1), Rgb(1, 0.5f, 0)}) {
        Scene scene;
        add_wall(scene, 0, -50, 50, add_glossy(scene, tint, glass(0, true)));
        const ObjectId behind = add_wall(scene, -3, -50, 50, add_material(scene, Rgb(1)));
        const ObjectId before = add_wall(scene, 9, -50, 50, add_material(scene, Rgb(1)));
        Looking l(std::move(scene), 15, 15);
        const IdMap map = map_of(l);
        const float r = 0.04f, t = 1 - r, c = tint.g;  // absorption within, at every crossing
        EXPECT_NEAR(seen_of(l, map, 7, 7, behind), t * t * c / (1 - r * r * c * c), 2e-3f);
        EXPECT_NEAR(seen_of(l, map, 7, 7, before), r + t * t * c * c * r / (1 - r * r * c * c),
                    2e-3f);
        for (const Fragment& f : map.at_pixel(7 * 15 + 7)) {
            EXPECT_NEAR(f.local.x, 0.5f, 1e-5f);
            if (tint.g < 1 && l.cache.surface_side(f.patch) / 2 == 1) {
                EXPECT_EQ(f.reflectance.b, 0);
            }
        }
    }
}

// A slab of thickness d shifts what is behind it: at the angle a, by d (tan a - tan b) along it,
// sin b = sin a / 1.5. Rays start 5e-4 off surfaces of this size.
TEST(Glass, ASlabShiftsThePicture) {
    Scene scene;
    add_box(scene, {-50, -50, -1}, {50, 50, 0}, add_glossy(scene, Rgb(1), glass(0, false)));
    const ObjectId wall = add_wall(scene, -3, -60, 40, add_material(scene, Rgb(1)), -50, 50);
    Looking l(std::move(scene), 15, 15);
    const IdMap map = map_of(l);
    for (int x = 0; x < 15; ++x) {
        float most = 0, place = 0;
        for (const Fragment& f : map.at_pixel(static_cast<std::uint32_t>(7 * 15 + x)))
            if (l.cache.surface_side(f.patch) / 2 == 6 && f.reflectance.g > most) {
                most = f.reflectance.g;
                place = 100 * f.local.x - 60;
            }
        const float tangent = (static_cast<float>(x) - 7) * 2 / 15;
        const float sine = tangent / std::sqrt(1 + tangent * tangent) / 1.5f;
        const float within = sine / std::sqrt(1 - sine * sine);
        EXPECT_NEAR(place, 6 * tangent + within, 5e-4f);
    }
    // Straight on: 0.96 at each face, and what goes to and fro within, once.
    EXPECT_NEAR(seen_of(l, map, 7, 7, wall), 0.96f * 0.96f * (1 + 0.04f * 0.04f), 2e-4f);
}

// Light that meets the long face of a right-angled prism from within, at 45 degrees, is reflected
// whole: the eye sees what lies below, less what the two short faces reflect and not once more, and
// nothing beyond.
TEST(Glass, APrismReflectsTotally) {
    Scene scene;
    const MaterialId clear = add_glossy(scene, Rgb(1), glass(0, false));
    Mesh prism;
    for (const float x : {-1.0f, 1.0f})
        for (const Vec2 p : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1)})
            prism.positions.push_back({x, p.y, p.x});
    prism.primitives = {triangle(0, 1, 2, clear), triangle(3, 5, 4, clear), quad(0, 3, 4, 1, clear),
                        quad(1, 4, 5, 2, clear), quad(2, 5, 3, 0, clear)};
    add_object(scene, std::move(prism));
    const ObjectId beyond = add_wall(scene, -9, -50, 50, add_material(scene, Rgb(1)));
    const ObjectId below =
        add_quad(scene, {-50, -4, 50}, {100, 0, 0}, {0, 0, -100}, add_material(scene, Rgb(1)));
    Looking l(std::move(scene), 15, 15);
    const IdMap map = map_of(l);
    EXPECT_EQ(seen_of(l, map, 7, 7, beyond), 0);
    EXPECT_NEAR(seen_of(l, map, 7, 7, below), 0.96f * 0.96f * (1 + 0.04f * 0.04f), 2e-4f);
}

// An irradiance picture shows light on surfaces, whatever they are made of.
TEST(Mirrors, IrradianceShowsSurfacesThemselves) {
    Looking l(mirrored_room(), 41, 31, {0, 0, 2}, {0, 0, -3});
    RayViewSettings settings = one_ray();
    settings.aov = Aov::irradiance;
    const IdMap map = map_of(l, settings);
    EXPECT_EQ(map.fragments.size(), 41u * 31);
    EXPECT_EQ(covered(map, 26, 15), Rgb(1));
}

// What a mirror shows is textured as what the eye sees: cells finer than a pixel become grey.
TEST(Mirrors, TexturesInMirrorsAreAveraged) {
    Scene scene;
    Texture texture;
    texture.width = texture.height = 2;
    const std::array<std::uint8_t, 4> black = {0, 0, 0, 255}, white = {255, 255, 255, 255};
    texture.texels = {black, white, white, black};
    texture.nearest = true;
    scene.textures.push_back(texture);
    const MaterialId checks = add_material(scene, Rgb(1));
    scene.materials[0].base_color_texture.texture = TextureId{0};
    Mesh mesh;
    mesh.positions = {{-40, -39.3f, 16}, {40, -39.3f, 16}, {40, 42.1f, 16}, {-40, 42.1f, 16}};
    for (const Vec3 p : mesh.positions) mesh.uvs[0].push_back(0.75f * Vec2(p));
    mesh.primitives = {quad(0, 1, 2, 3, checks)};
    add_object(scene, std::move(mesh));
    add_wall(scene, 0, -50, 50, add_glossy(scene, Rgb(0), mirror(Rgb(1))));
    Looking l(std::move(scene), 16, 16);
    const IdMap map = map_of(l, {});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_NEAR(kPi * covered(map, x, y).g, 0.5f, 0.15f);
}

// The number of threads changes no bit.
TEST(Mirrors, ThreadsChangeNothing) {
    Scene scene = mirrored_room();
    add_box(scene, {1, -2, -2}, {2, 0, -1}, add_glossy(scene, Rgb(1), glass(0, false)));
    add_box(scene, {1, 0, -2}, {2, 1, -1}, add_glossy(scene, Rgb(1), metal(0.2f)));
    Looking l(std::move(scene), 41, 31, {0, 0, 2}, {0, 0, -3});
    RayViewSettings settings;
    const IdMap one = map_of(l, settings);
    settings.threads = 2;
    const IdMap two = map_of(l, settings);
    ASSERT_EQ(one.fragments.size(), two.fragments.size());
    EXPECT_EQ(one.background.pixels, two.background.pixels);
    for (std::size_t i = 0; i < one.fragments.size(); ++i) {
        EXPECT_EQ(one.fragments[i].local, two.fragments[i].local);
        EXPECT_EQ(one.fragments[i].reflectance, two.fragments[i].reflectance);
    }
}

// Rough metal that absorbs nothing shows white surroundings white: what lies on what it shows sums
// to
// 1. A direction weighs at most 3 and over the picture there are 15000: an error of 0.02 would be
// more than 4 deviations at the worst. What it shows of lights is left to light samples.
TEST(Polish, IsWhiteInWhiteSurroundings) {
    for (const float roughness : {0.1f, 0.3f, 0.6f}) {
        Scene scene;
        add_room(scene, Vec3(-9), Vec3(9), add_material(scene, Rgb(1), Rgb(1)));
        add_wall(scene, 0, -5, 5, add_glossy(scene, Rgb(1), metal(roughness)), -5, 5);
        Looking l(std::move(scene), 31, 31);
        const IdMap map = map_of(l, {});
        double sum = 0;
        for (const Fragment& f : map.fragments) sum += f.reflectance.g * kPi;
        EXPECT_NEAR(sum / (31 * 31), 1, 0.02) << roughness;
        for (const Rgb& pixel : map.background.pixels) EXPECT_EQ(pixel, Rgb(0));
        float glints = 0;
        for (const Glint& glint : map.glints) glints += glint.weight.g;
        EXPECT_NEAR(glints, 31 * 31, 0.1f);
    }
}

// Facets wide enough for the cache have its glossy radiance: all of the pixel, and no rays. So have
// they behind a pane, less what it takes; but not in a mirror.
TEST(Polish, WideFacetsShowTheCachesGlossyRadiance) {
    RayViewSettings settings;
    settings.cached_facets = 0.2f;
    for (const bool pane : {false, true}) {
        Scene scene;
        add_wall(scene, 0, -50, 50, add_glossy(scene, Rgb(1), plastic(0.5f)));
        if (pane) add_wall(scene, 1, -50, 50, add_glossy(scene, Rgb(1), glass(0, true)));
        Looking l(std::move(scene), 15, 15);
        const IdMap map = map_of(l, settings);
        const float through = pane ? 0.96f / 1.04f : 1;
        int glossy = 0;
        for (const Fragment& f : map.at_pixel(7 * 15 + 7)) {
            if (f.gloss == Rgb(0)) continue;
            EXPECT_NEAR(f.gloss.g, through, 1e-3f);
            ++glossy;
        }
        EXPECT_EQ(glossy, 1);
        EXPECT_TRUE(map.glints.empty() || pane);
    }
    Scene scene;
    add_wall(scene, 0, -50, 50, add_glossy(scene, Rgb(1), mirror(Rgb(1))));
    add_wall(scene, 6, -50, 50, add_glossy(scene, Rgb(1), metal(0.5f)));
    scene.materials[0].base_color = Rgb(0);
    Looking l(std::move(scene), 15, 15);
    const IdMap map = map_of(l, settings);
    for (const Fragment& f : map.fragments) EXPECT_EQ(f.gloss, Rgb(0));
    EXPECT_FALSE(map.glints.empty());
}

}  // namespace
}  // namespace chiaro
