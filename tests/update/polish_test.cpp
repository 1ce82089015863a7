// What polish shows comes to the truth while the view rests.
#include "sample_renderer/reference_renderer.h"
#include "update/session.h"
#include "update/studio.h"

namespace chiaro {
namespace {

using namespace tiny;

enum class Lamp { panel, point };

// A room whose walls differ, on a floor that is nothing but polish.
Scene room(const Gloss& gloss, Lamp lamp) {
    Scene scene;
    const MaterialId white = add_material(scene, Rgb(0.7f));
    const MaterialId red = add_material(scene, {0.7f, 0.1f, 0.05f});
    const MaterialId floor = add_glossy(scene, Rgb(0.8f * gloss.metallic), gloss);
    add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, floor);
    add_quad(scene, {-2, 3, -2}, {4, 0, 0}, {0, 0, 4}, white);
    add_quad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, white);
    add_quad(scene, {2, 0, 2}, {-4, 0, 0}, {0, 3, 0}, white);
    add_quad(scene, {-2, 0, 2}, {0, 0, -4}, {0, 3, 0}, red);
    add_quad(scene, {2, 0, -2}, {0, 0, 4}, {0, 3, 0}, red);
    if (lamp == Lamp::point)
        scene.lights.push_back(point_light({0.3f, 2.5f, -0.2f}, Rgb(20)));
    else
        add_quad(scene, {-0.5f, 2.9f, -0.5f}, {1, 0, 0}, {0, 0, 1},
                 add_material(scene, Rgb(0), Rgb(50)));
    return scene;
}

// Of the floor alone.
View view_of_floor() {
    return {{.eye = {0, 1.5f, 1.9f}, .target = {0, 0, 0}, .vertical_fov = 30}, 12, 9};
}

// Two pictures of the truth: of their products with an error their own noise drops out.
struct Truths {
    Image a, b;

    explicit Truths(const Studio& studio) : a(picture(studio, 7)), b(picture(studio, 8)) {}
    static Image picture(const Studio& studio, std::uint32_t seed) {
        ReferenceRenderer reference(make_lit_scene(studio.scene, studio.rays, studio.area_lights),
                                    view_of_floor(), {seed, 2});
        reference.add_pass(2048);
        return reference.image();
    }
    // Mean squared error over the squared mean.
    double error(const Image& picture) const {
        double sum = 0;
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            const double seen = luminance(picture.pixels[i]);
            sum += (seen - luminance(a.pixels[i])) * (seen - luminance(b.pixels[i]));
        }
        const double mean = luminance(mean_of(a));
        return sum / static_cast<double>(picture.pixels.size()) / (mean * mean);
    }
};

// The first look takes 16 rays and 16 samples of the lamp, a pass as many again, and half to three
// quarters of all passes count: with four times the passes the squared error of independent samples
// is 0.17 to 0.38 of what it was, of a sequence less. The truth's noise leaves 2e-4 of it unknown.
TEST(Polish, ItsErrorFallsWithTheWorkWhileTheViewRests) {
    struct Case {
        Lamp lamp;
        Gloss gloss;
    };
    for (const Case& c : {Case{Lamp::panel, metal(0.2f)}, Case{Lamp::point, metal(0.2f)}}) {
        Studio studio(room(c.gloss, c.lamp), fixed_size(Scheme::best, Aov::radiance));
        const Truths truths(studio);
        studio.cycle.look_from(view_of_floor());
        studio.run(12);
        const double early = truths.error(studio.cycle.picture());
        studio.run(36);
        const double late = truths.error(studio.cycle.picture());
        EXPECT_LT(late, early / 2) << int(c.lamp);
        // And of what the map alone shows of the same cache.
        const Image first_look = draw(studio.cycle.cache(), studio.cycle.id_map(), 2);
        EXPECT_LT(late, truths.error(first_look) / 2) << int(c.lamp);
    }
}

// A ceiling of 1600 small squares over a polished floor, both lit by a wall alone that a spot
// shines on. Of the floor few pixels are seen, so that passes alone find most squares.
Scene ceiling_in_polish() {
    Scene scene;
    const MaterialId wall = add_material(scene, Rgb(0.6f));
    const MaterialId white = add_material(scene, Rgb(0.7f));
    const MaterialId floor = add_glossy(scene, Rgb(0.8f), metal(0.2f));
    add_quad(scene, {-4, 0, -4}, {8, 0, 0}, {0, 3, 0}, wall);
    add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, floor);
    Mesh ceiling;
    constexpr int kAcross = 40;
    for (int j = 0; j <= kAcross; ++j)
        for (int i = 0; i <= kAcross; ++i)
            ceiling.positions.emplace_back(0.2f * float(i) - 4, 3, 0.2f * float(j) - 4);
    for (std::uint32_t j = 0; j < kAcross; ++j)
        for (std::uint32_t i = 0; i < kAcross; ++i) {
            const std::uint32_t a = j * (kAcross + 1) + i, b = a + kAcross + 1;
            ceiling.primitives.push_back(quad(a, a + 1, b + 1, b, white));
        }
    add_object(scene, ceiling);
    PunctualLight spot = point_light({0, 1.5f, -2}, Rgb(1000));
    spot.kind = LightKind::spot;
    spot.outer_cone = 0.6f;
    scene.lights.push_back(spot);
    return scene;
}

// An edit is followed by what polish shows of surfaces out of view too: once the wall is painted
// ten times as dark, the floor comes to show what it does in a fresh session, within the noise (20
// %).
TEST(Polish, WhatItShowsFollowsEdits) {
    SessionSettings settings;
    settings.update = fixed_size(Scheme::best, Aov::radiance);
    settings.width = 4;
    settings.height = 3;
    const Camera camera = {.eye = {0, 1.5f, 1.9f}, .target = {0, 0, 0}, .vertical_fov = 30};
    const auto mean_after = [&](Session& session, int cycles) {
        for (int i = 0; i < cycles; ++i) session.run();
        return luminance(mean_of(session.cycle().picture()));
    };
    Session session(ceiling_in_polish(), camera, settings);
    const float before = mean_after(session, 120);
    Material dark = session.scene().material(MaterialId{0});
    dark.base_color = Rgb(0.06f);
    session.apply(SetMaterial{MaterialId{0}, dark});
    const float after = mean_after(session, 120);
    Session fresh(session.scene(), camera, settings);
    const float truth = mean_after(fresh, 120);
    EXPECT_LT(truth, before / 8);
    EXPECT_NEAR(after, truth, 0.2f * truth);
}

// Passes add nothing and lose nothing, at outlines neither: a white box that is all polish vanishes
// in an even sky. Directions that lead into the box are thrown away, so that a ray is 0.1 off; 300
// pixels of 16 rays or more leave 0.002 of their mean, and a pixel 0.03.
TEST(Polish, WhitePolishVanishesInAnEvenSky) {
    Scene scene;
    scene.environment.sky = {1, 2, 0};
    add_box(scene, Vec3(-1), Vec3(1), add_glossy(scene, Rgb(1), metal(0.2f)));
    Studio studio(std::move(scene), fixed_size(Scheme::best, Aov::radiance));
    studio.cycle.look_from(View({.eye = {3, 4, 5}, .target = {0, 0, 0}}, 32, 24));
    studio.run(24);
    const Image picture = studio.cycle.picture();
    EXPECT_NE(picture.pixels, draw(studio.cycle.cache(), studio.cycle.id_map(), 1).pixels);
    float worst = 0;
    for (const Rgb& p : picture.pixels) {
        worst = std::max({worst, std::abs(p.r - 1), std::abs(p.g / 2 - 1)});
        EXPECT_EQ(p.b, 0);
    }
    EXPECT_LT(worst, 0.1f);
    EXPECT_NEAR(mean_of(picture).r, 1, 0.005);
}

// Passes are decided by count where cycles have a fixed size.
TEST(Polish, TheSameBitsOnAnyNumberOfThreads) {
    const auto picture = [](Scheme scheme, int threads) {
        UpdateSettings settings = fixed_size(scheme, Aov::radiance);
        settings.threads = threads;
        settings.direct_samples = settings.indirect_samples = 16;
        Studio studio(room(plastic(0.2f), Lamp::panel), settings);
        studio.cycle.look_from(view_of_floor());
        studio.run(16);
        const Image shown = studio.cycle.picture();
        EXPECT_NE(shown.pixels, draw(studio.cycle.cache(), studio.cycle.id_map(), 1).pixels);
        return shown;
    };
    for (const Scheme scheme : {Scheme::best, Scheme::paper})
        EXPECT_EQ(picture(scheme, 1).pixels, picture(scheme, 2).pixels);
}

}  // namespace
}  // namespace chiaro
