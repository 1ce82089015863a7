// The first picture decides whether people stay: after one cycle it covers the whole view.
#include "scene/built_in.h"
#include "update/studio.h"

namespace chiaro {
namespace {

using tiny::fixed_size;
using tiny::Studio;

class FirstPicture : public testing::TestWithParam<const char*> {};

// Everything in these rooms gets light, so whatever is no background shows some. (The paper's
// scheme begins with the corners of the roots: a face whose corners are all covered is black until
// divided.)
TEST_P(FirstPicture, CoversTheView) {
    Scene scene = *built_in_scene(GetParam());
    const Camera camera = scene.cameras.front();
    Studio studio(std::move(scene), fixed_size(Scheme::best, Aov::radiance));
    studio.cycle.look_from({camera, 160, 120});
    studio.cycle.run();
    const Image picture = studio.cycle.picture();
    const IdMap& map = studio.cycle.id_map();
    std::size_t black = 0, surface = 0;
    for (std::uint32_t i = 0; i < picture.pixels.size(); ++i) {
        if (map.at_pixel(i).empty()) continue;
        ++surface;
        black += luminance(picture.pixels[i]) > 0 ? 0 : 1;
    }
    EXPECT_GT(surface, picture.pixels.size() / 3);
    EXPECT_EQ(black, 0u) << "of " << surface;
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, FirstPicture, testing::Values("cornell", "room"),
                         [](const auto& which) { return std::string(which.param); });

// The first picture of the best scheme costs about what its budget says: a fixed one of 0.15 s of
// work in fixed cycles, whatever the size of the picture.
TEST(FirstPicture, CostDoesNotGrowWithThePicture) {
    std::size_t points[2] = {};
    for (int i = 0; i < 2; ++i) {
        Scene scene = make_cornell_box();
        const Camera camera = scene.cameras.front();
        Studio studio(std::move(scene), fixed_size(Scheme::best));
        studio.cycle.look_from({camera, 160 << i, 120 << i});
        studio.cycle.run();
        points[i] = studio.points();
    }
    EXPECT_NEAR(double(points[1]) / double(points[0]), 1, 0.5);
}

// A view that rests is refined for a moment, and then its outlines are smoothed: with cycles timed
// as users have them, which no other test here is.
TEST(FirstPicture, OutlinesAreSmoothedInAMoment) {
    Scene scene = make_cornell_box();
    const Camera camera = scene.cameras.front();
    UpdateSettings settings = fixed_size(Scheme::best);
    settings.fixed_size = false;
    settings.cycle_seconds = 0.005;
    Studio studio(std::move(scene), settings);
    studio.cycle.look_from({camera, 160, 120});
    studio.cycle.run();
    const std::size_t one_a_pixel = studio.cycle.id_map().fragments.size();
    EXPECT_LE(one_a_pixel, 160u * 120);
    // A moment is half a second at most.
    const double first = studio.cycle.statistics().seconds;
    while (studio.cycle.id_map().fragments.size() == one_a_pixel &&
           studio.cycle.statistics().seconds < first + 60)
        studio.cycle.run();
    EXPECT_GT(studio.cycle.id_map().fragments.size(), one_a_pixel + 100);
    EXPECT_GE(studio.cycle.statistics().cycles, 2u);
}

// A ground of 2000 km under an eye at 1.7 m is divided as far as places on it can be told apart.
TEST(FirstPicture, AGroundWithoutEnd) {
    Scene scene;
    const MaterialId grey = tiny::add_material(scene, Rgb(0.5f));
    tiny::add_quad(scene, {-1e6f, -1e6f, 0}, {2e6f, 0, 0}, {0, 2e6f, 0}, grey);
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = Rgb(1000);
    sun.direction = {0, 0, -1};
    scene.lights.push_back(sun);
    for (const Scheme scheme : {Scheme::best, Scheme::paper}) {
        Studio studio(scene, fixed_size(scheme));
        Camera camera;
        camera.eye = {0, 0, 1.7f};
        camera.target = {1, 0, 1.7f};
        camera.up = {0, 0, 1};
        studio.cycle.look_from({camera, 160, 120});
        studio.run(60);
        const Image picture = studio.cycle.picture();
        for (int y = 90; y < 120; ++y)
            EXPECT_NEAR(luminance(picture.at(80, y)), 1000, 10) << y;  // lux, everywhere
    }
}

}  // namespace
}  // namespace chiaro
