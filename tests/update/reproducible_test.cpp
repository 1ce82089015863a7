// One seed, one picture: in cycles of a fixed size nothing depends on threads or on time.
#include "scene/built_in.h"
#include "update/studio.h"

namespace chiaro {
namespace {

using tiny::fixed_size;
using tiny::Studio;

Image picture(Scheme scheme, int threads, std::uint64_t seed, tiny::Truth by = tiny::Truth::path) {
    UpdateSettings settings = fixed_size(scheme, Aov::radiance);
    settings.threads = threads;
    settings.seed = seed;
    settings.direct_samples = settings.indirect_samples = 16;
    Scene scene = make_cornell_box();
    const Camera camera = scene.cameras.front();
    Studio studio(std::move(scene), settings, by);
    studio.cycle.look_from({camera, 64, 48});
    studio.run(6);
    return studio.cycle.picture();
}

class Reproducible : public testing::TestWithParam<Scheme> {};

TEST_P(Reproducible, TheSameBitsOnAnyNumberOfThreads) {
    const Image one = picture(GetParam(), 1, 5);
    EXPECT_EQ(one.pixels, picture(GetParam(), 2, 5).pixels);
    EXPECT_EQ(one.pixels, picture(GetParam(), 3, 5).pixels);
}

// So it is where rays end in cells, which threads fill.
TEST(GatherReproducible, TheSameBitsOnAnyNumberOfThreads) {
    const Image one = picture(Scheme::best, 1, 5, tiny::Truth::gather);
    EXPECT_EQ(one.pixels, picture(Scheme::best, 3, 5, tiny::Truth::gather).pixels);
}

// Another seed draws other samples: nearly no pixel has the same bits.
TEST_P(Reproducible, AnotherSeedGivesAnotherPicture) {
    const Image five = picture(GetParam(), 2, 5), six = picture(GetParam(), 2, 6);
    int equal = 0, shaded = 0;
    for (std::size_t i = 0; i < five.pixels.size(); ++i) {
        if (five.pixels[i] == Rgb(0)) continue;
        ++shaded;
        equal += five.pixels[i] == six.pixels[i] ? 1 : 0;
    }
    EXPECT_LT(equal, shaded / 20);
}

INSTANTIATE_TEST_SUITE_P(Update, Reproducible, testing::Values(Scheme::best, Scheme::paper),
                         tiny::scheme_name);

}  // namespace
}  // namespace chiaro
