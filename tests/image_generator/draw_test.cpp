// The picture: irradiance times reflectance, over the background.
#include "image_generator/looking.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

Scene furnished_room() {
    Scene scene;
    add_room(scene, {-3, -2, -4}, {3, 2, 5}, add_material(scene, {0.8f, 0.6f, 0.4f}));
    add_box(scene, {-1, -2, -2}, {0.7f, 0.3f, -1}, add_material(scene, {0.8f, 0.6f, 0.4f}));
    return scene;
}
void light_evenly(ShadingCache& cache, Rgb irradiance) {
    for (std::uint32_t v = 0; v < cache.vertices().size(); ++v)
        cache.store(static_cast<VertexId>(v), 0, irradiance, 0, 1, 1);
    cache.resolve();
}

// A Lambertian of reflectance rho under irradiance E has the radiance rho E / pi, at every pixel
// and whatever the mesh. E is exact in RGB9E5.
TEST(Draw, EvenLightGivesRhoEOverPi) {
    Looking l(furnished_room(), 60, 40);
    IdMap map = l.map(Aov::radiance);
    attach(l.cache, map, 1);
    Rng rng(1);
    for (int i = 0; i < 100; ++i) {
        const auto id =
            static_cast<PatchId>(rng.below(static_cast<std::uint32_t>(l.cache.patches().size())));
        if (l.cache.patch(id).is_leaf()) subdivide_seen(l.cache, map, id, 1);
    }
    light_evenly(l.cache, {100, 200, 50});
    const Rgb expected = Rgb(0.8f, 0.6f, 0.4f) * Rgb(100, 200, 50) / kPi;
    for (const Rgb& pixel : draw(l.cache, map, 1).pixels)
        EXPECT_LE(max_component(glm::abs(pixel - expected)), 1e-4f * 50);
}

// An irradiance picture holds E itself.
TEST(Draw, AnIrradiancePictureHoldsTheIrradiance) {
    Looking l(furnished_room(), 60, 40);
    IdMap map = l.map(Aov::irradiance);
    attach(l.cache, map, 1);
    light_evenly(l.cache, {100, 200, 50});
    for (const Rgb& pixel : draw(l.cache, map, 1).pixels)
        EXPECT_LE(max_component(glm::abs(pixel - Rgb(100, 200, 50))), 1e-4f * 200);
}

// Emission is added to what is reflected.
TEST(Draw, TheBackgroundIsAdded) {
    Scene scene;
    add_wall(scene, 0, -50, 50, add_material(scene, Rgb(0.5f), Rgb(3)));
    Looking l(std::move(scene), 8, 8);
    IdMap map = l.map(Aov::radiance);
    attach(l.cache, map, 1);
    light_evenly(l.cache, Rgb(2));
    for (const Rgb& pixel : draw(l.cache, map, 1).pixels)
        EXPECT_NEAR(pixel.r, 3 + 0.5f * 2 / kPi, 1e-4f);
}

TEST(Draw, NothingIsBlack) {
    Scene scene;
    add_wall(scene, 100, -1, 1, add_material(scene, Rgb(1)));  // behind the camera
    Looking l(std::move(scene), 8, 8);
    IdMap map = l.map(Aov::radiance);
    EXPECT_TRUE(map.fragments.empty());
    attach(l.cache, map, 1);
    for (const Rgb& pixel : draw(l.cache, map, 1).pixels) EXPECT_EQ(pixel, Rgb(0));
}

// The number of threads changes no bit, of the map or of the picture.
TEST(Draw, ThreadsChangeNothing) {
    Looking one(furnished_room(), 60, 40), two(furnished_room(), 60, 40);
    IdMap a = one.map(Aov::radiance, 1), b = two.map(Aov::radiance, 2);
    ASSERT_EQ(a.fragments.size(), b.fragments.size());
    EXPECT_EQ(a.first_of_pixel, b.first_of_pixel);
    EXPECT_EQ(a.background.pixels, b.background.pixels);
    for (std::size_t i = 0; i < a.fragments.size(); ++i) {
        const Fragment &f = a.fragments[i], &g = b.fragments[i];
        EXPECT_TRUE(f.pixel == g.pixel && f.patch == g.patch && f.local == g.local &&
                    f.reflectance == g.reflectance);
    }
    attach(one.cache, a, 1);
    attach(two.cache, b, 1);
    light_evenly(one.cache, {3, 5, 7});
    light_evenly(two.cache, {3, 5, 7});
    EXPECT_EQ(draw(one.cache, a, 1).pixels, draw(two.cache, b, 2).pixels);
}

}  // namespace
}  // namespace chiaro
