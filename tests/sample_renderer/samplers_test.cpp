// Every sampler of this folder draws with the chances and densities that it states, and what is
// uniform is. By chi^2, each false alarm below 1e-6 (scene/chi_squared.h); of walks from lights see
// emitters_test.cpp, of surfaces and environments the tests of scene.
#include "base/weighted_choice.h"
#include "sample_renderer/aimed_rays.h"
#include "sample_renderer/meter.h"
#include "scene/chi_squared.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using tiny::Meter;

// A choice of unequal weights, one of them 0, and what is left of the number, in tenths.
TEST(Samplers, AWeightedChoiceHasItsChancesAndLeavesAUniformNumber) {
    const std::vector<double> weights = {1, 20, 0, 5, 0.01, 7};
    const WeightedChoice choice(weights);
    constexpr int kSamples = 200'000;
    std::vector<double> counts(60, 0.0), expected;
    Rng rng(1);
    for (int i = 0; i < kSamples; ++i) {
        const WeightedChoice::Choice chosen = choice.choose(rng.uniform());
        EXPECT_EQ(chosen.probability, choice.probability(chosen.index));
        counts[10 * chosen.index + int(10 * chosen.rest)] += 1;
    }
    for (std::uint32_t i = 0; i < 6; ++i)
        expected.insert(expected.end(), 10, kSamples * double(choice.probability(i)) / 10);
    expect_counts(counts, expected, "weighted choice");
    EXPECT_NEAR(choice.probability(1), 20 / 33.01, 1e-6);
}

// Their rims lie between rings of cells.
TEST(Samplers, ConesAreEven) {
    for (const int rings : {16, 6, 2}) {
        const float rim = std::cos(kPi * float(rings) / SphereCells::kRings);
        Rng rng(2);
        expect_density([&](Vec3 w) { return w.z > rim ? pdf_cone(rim) : 0.0f; },
                       [&] {
                           const float x = rng.uniform();
                           return std::optional(square_to_cone({x, rng.uniform()}, rim));
                       },
                       "cone of " + std::to_string(rim));
    }
}

// About shading normals that lean from the real plane, one by one and eight at a time.
TEST(Samplers, ReceivedDirectionsFollowTheirCosine) {
    for (const float lean : {0.0f, 0.7f, 1.4f}) {
        const Receiver receiver = {
            Vec3(0), Vec3(0), {0, 0, 1}, {std::sin(lean), 0, std::cos(lean)}};
        const auto density = [&](Vec3 w) { return pdf_receiving_cosine(receiver, w); };
        const std::string name = "lean " + std::to_string(lean);
        Rng rng(3);
        const auto one = [&] {
            const float x = rng.uniform();
            return std::optional(sample_receiving_cosine(receiver, Vec2(x, rng.uniform())));
        };
        expect_density(density, one, name, 64);

        Lanes3 numbers, directions;
        int lane = kLanes;
        const auto eight = [&] {
            if (lane == kLanes) {
                for (int i = 0; i < kLanes; ++i) numbers.set(i, {rng.uniform(), rng.uniform(), 0});
                const Vec3x8 u = numbers.all();
                directions =
                    Lanes3(sample_receiving_cosine(everywhere(receiver), Vec2x8{u.x, u.y}));
                lane = 0;
            }
            return std::optional(directions.lane(lane++));
        };
        expect_density(density, eight, name + ", eight", 64);
    }
}

// Of five suns one is below the horizon and one grazes.
TEST(Samplers, SunsAreChosenWithTheChanceStated) {
    Scene scene;
    scene.lights = {tiny::sun({0, 0, -1}, Rgb(1)), tiny::sun({0.6f, 0, -0.8f}, {20, 1, 1}),
                    tiny::sun({0, 0, 1}, Rgb(1000)), tiny::sun({1, 0, -0.01f}, Rgb(3)),
                    tiny::sun({-0.6f, 0.6f, -0.6f}, {0, 0, 9})};
    const Meter meter(scene);
    const Vec3 up(0, 0, 1);
    const Receiver receiver = {Vec3(0), {0, 0, 1e-5f}, up, up};
    constexpr int kSamples = 100'000;
    std::vector<double> counts(5, 0.0), expected;
    Rng rng(4);
    for (int i = 0; i < kSamples; ++i) {
        const auto chosen = choose_sun(meter.lit, receiver, rng.uniform());
        ASSERT_TRUE(chosen);
        EXPECT_FLOAT_EQ(chosen->probability, sun_chance(meter.lit, receiver, chosen->light));
        counts[chosen->light] += 1;
    }
    for (std::uint32_t i = 0; i < 5; ++i)
        expected.push_back(kSamples * double(sun_chance(meter.lit, receiver, i)));
    expect_counts(counts, expected, "suns");
    EXPECT_EQ(counts[2], 0);
}

// Aimed at a ceiling, at a triangle on a wall and at one that faces away from the place, from
// which no light comes.
TEST(Samplers, AimedRaysFollowTheDensityOfWhatTheyAreAimedAt) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(1));
    tiny::add_quad(scene, {-2, -1, 1}, {0, 3, 0.5f}, {3, 0, 0}, white);
    Mesh mesh;
    mesh.positions = {{2, -1, 0.1f}, {2, 1, 0.1f}, {2, 0, 0.9f}};
    mesh.primitives = {tiny::triangle(0, 2, 1, white)};
    tiny::add_object(scene, mesh);
    tiny::add_quad(scene, {-2.5f, -1, 0.1f}, {0, 0, 1}, {0, 1, 0}, white);
    const Meter meter(scene);
    const SampledSurfaces surfaces(meter.scene, [](ObjectId object, std::uint32_t) {
        return SurfaceWeight{float(1 + int(object)), false};
    });
    const Aims aims = {surfaces, 4};
    const Vec3 up(0, 0, 1);
    const Receiver receiver = {Vec3(0), Vec3(0), up, up};

    // Of 16 samples a seed, four a replicate, four aim.
    PathWave wave;
    std::vector<Target> targets;
    std::uint32_t seed = 0;
    std::size_t next = 4;
    const auto draw = [&]() -> std::optional<Vec3> {
        if (next == 4) {
            wave.clear();
            const SampleRun run = {receiver, ++seed, 0, 16};
            add_aimed_rays(aims, {&run, 1}, wave, targets);
            EXPECT_LE(wave.rays.size(), 4u);
            next = 0;
        }
        return next++ < wave.rays.size() ? std::optional(wave.rays[next - 1].direction)
                                         : std::nullopt;
    };
    const auto density = [&](Vec3 w) {
        if (!(w.z > 0)) return 0.0f;
        const Hit hit = meter.look(receiver.origin, w);
        if (!hit) return 0.0f;
        const auto [object, primitive, u, v] = hit.point;
        return surfaces.pdf(lit_place(receiver), {object, primitive}) * hit.t * hit.t /
               std::abs(glm::dot(hit.normal, w));
    };
    expect_density(density, draw, "aimed rays", 48);
}

// Counts of pairs in 16 x 16 cells of the unit square, by `kPairs` calls of pair(i).
template <typename Pair>
void expect_even_pairs(const Pair& pair, const std::string& name) {
    constexpr int kPairs = 50'000;
    std::vector<double> counts(256, 0.0);
    for (std::uint32_t i = 0; i < kPairs; ++i) {
        const Vec2 p = pair(i);
        ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << name;
        counts[16 * int(16 * p.x) + int(16 * p.y)] += 1;
    }
    expect_counts(counts, std::vector<double>(256, kPairs / 256.0), name);
}

// One sample's numbers over seeds: of paths, of lights beside one another, of what few samples do.
TEST(Samplers, NumbersOfASequenceAreUniformOverSeeds) {
    for (const std::uint32_t sample : {0u, 7u, 5001u}) {
        for (const int d : {0, 2, 4})
            expect_even_pairs([&](std::uint32_t seed) { return Sequence(seed).pair(sample, d); },
                              "dimension " + std::to_string(d));
        expect_even_pairs(
            [&](std::uint32_t seed) {
                return Sequence(seed).rotated_pair(sample, kFirstLightPlace, kFirstSkyRotation);
            },
            "sky");
        expect_even_pairs(
            [&](std::uint32_t seed) {
                return Sequence(seed).sparse_pair(sample % kReplicates, sample / kReplicates,
                                                  kFirstLightPlace);
            },
            "sparse");
    }
}

// And a path's numbers after its first hit, whose eight are those of one by one.
TEST(Samplers, NumbersOfABounceAreUniformOverPaths) {
    for (const std::uint32_t bounce : {1u, 2u, 50u}) {
        expect_even_pairs([&](std::uint32_t key) { return BounceNumbers(key, bounce).next_pair(); },
                          "bounce");
        for (std::uint32_t key = 0; key < 100; ++key) {
            BounceNumbers one(key, bounce);
            BounceNumbers8 eight(Word8(key), bounce);
            for (int i = 0; i < 4; ++i) {
                float lanes[kLanes];
                eight.next().store(lanes);
                EXPECT_EQ(lanes[i], one.next());
            }
        }
    }
}

// One of each block of seven takes the turn, any of them as often.
TEST(Samplers, AnyOfABlockTakesTheTurn) {
    constexpr std::uint32_t kSeeds = 20'000, kEvery = 7;
    std::vector<double> counts(kEvery, 0.0);
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        int taken = 0;
        for (std::uint32_t i = 0; i < kEvery; ++i)
            if (takes_turn(seed, 1, 3 * kEvery + i, kEvery)) {
                counts[i] += 1;
                ++taken;
            }
        ASSERT_EQ(taken, 1);
    }
    expect_counts(counts, std::vector<double>(kEvery, double(kSeeds) / kEvery), "turns");
}

}  // namespace
}  // namespace chiaro
