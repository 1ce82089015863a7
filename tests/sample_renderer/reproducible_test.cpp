// What the seam promises: the same bits in any batch and on any number of threads, samples that
// continue, variances that are honest, and points in solids that say so.
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace chiaro {
namespace {

using tiny::Meter;
using tiny::Truth;

// `gather` remembers what it was asked before: its promise is tested in gather_test.cpp.
constexpr Truth kForgetful[] = {Truth::path, Truth::bidirectional, Truth::caustic};

std::vector<ShadeRequest> many_requests(const Meter& meter, std::size_t count) {
    std::vector<ShadeRequest> requests;
    Rng rng(1);
    while (requests.size() < count) {
        const Vec3 d(rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() - 0.2f);
        const Hit hit = meter.look({2.78f, 2.7f, 0.2f}, d);
        if (!hit) continue;
        const Light lights[] = {Light::direct, Light::indirect, Light::total};
        requests.push_back({.where = hit.point,
                            .front = hit.front,
                            .light = lights[requests.size() % 3],
                            .seed = rng.next(),
                            .first_sample = 4 * rng.below(8),
                            .samples = 4 * (1 + rng.below(20)),
                            .indirect_samples = 4 * (1 + rng.below(40))});
    }
    return requests;
}

bool same_bits(const std::vector<ShadeResult>& a, const std::vector<ShadeResult>& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(),
                      [](const ShadeResult& x, const ShadeResult& y) {
                          return std::memcmp(&x.mean, &y.mean, sizeof(Rgb)) == 0 &&
                                 std::memcmp(&x.variance, &y.variance, sizeof(Rgb)) == 0 &&
                                 x.buried == y.buried;
                      });
}

void expect_same_bits_anyhow(Meter& meter) {
    std::vector<ShadeRequest> requests = many_requests(meter, 301);
    requests[17].samples = 5000;  // more than one wave
    const auto all = meter.shade(requests, 1);
    EXPECT_TRUE(same_bits(all, meter.shade(requests, 2)));
    EXPECT_TRUE(same_bits(all, meter.shade(requests, 4)));

    std::vector<ShadeResult> pieces;
    for (std::size_t first = 0; first < requests.size();) {
        const std::size_t count = std::min<std::size_t>(1 + first % 7, requests.size() - first);
        const std::vector<ShadeRequest> piece(requests.begin() + first,
                                              requests.begin() + first + count);
        for (const ShadeResult& result : meter.shade(piece, 2)) pieces.push_back(result);
        first += count;
    }
    EXPECT_TRUE(same_bits(all, pieces));
}

TEST(Reproducible, AnyThreadsAnyBatch) {
    for (const Truth by : kForgetful) {
        Meter meter(tiny::cornell_box(), by);
        expect_same_bits_anyhow(meter);
    }
}

// Lights of every kind, more of them than are asked one by one, and panes in their way.
Scene lights_and_panes() {
    Scene scene = tiny::cornell_box();
    Rng rng(2);
    for (int i = 0; i < 40; ++i) {
        const Vec3 place(5 * rng.uniform(), 5 * rng.uniform(), 5 * rng.uniform());
        scene.lights.push_back(tiny::point_light(place, Rgb(1, 2, 1)));
        if (i % 2 == 0) scene.lights.back().kind = LightKind::spot;
        if (i < 18) scene.lights.push_back(tiny::sun(place - Vec3(2.5f, 6, 1), Rgb(1)));
    }
    for (int i = 1; i < 4; ++i) {
        const MaterialId pane = tiny::add_material(scene, Rgb(0.5f));
        scene.materials[index_of(pane)].alpha_mode = AlphaMode::blend;
        scene.materials[index_of(pane)].alpha = 0.3f;
        scene.materials[index_of(pane)].double_sided = false;
        tiny::add_quad(scene, {0, 1.3f * float(i), 0.5f}, {5, 0, 0}, {0, 0.3f, 4}, pane);
    }
    return scene;
}

TEST(Reproducible, AnyThreadsAnyBatchWithLightsAndPanes) {
    for (const Truth by : kForgetful) {
        Meter meter(lights_and_panes(), by);
        expect_same_bits_anyhow(meter);
    }
}

// Direct light is one code: what one renderer says of it all say, to the last bit, and what is true
// of one's is true of all.
TEST(Reproducible, DirectLightIsTheSameOfAllRenderers) {
    Scene scene = lights_and_panes();
    scene.environment.sky = {1, 2, 3};
    Meter path(scene);
    std::vector<ShadeRequest> requests = many_requests(path, 100);
    for (ShadeRequest& request : requests) request.light = Light::direct;
    const auto expected = path.shade(requests);
    for (const Truth by : tiny::kTruths)
        EXPECT_TRUE(same_bits(expected, Meter(scene, by).shade(requests))) << int(by);
}

// [0, 32) and [32, 64), averaged, are [0, 64); of `total` both parts continue.
TEST(Reproducible, SamplesContinue) {
    for (const Truth by : kForgetful) {
        Meter meter(tiny::cornell_box(), by);
        for (ShadeRequest request : many_requests(meter, 90)) {
            request.first_sample = 0;
            request.samples = 64;
            request.indirect_samples = 256;
            ShadeRequest first = request, second = request;
            first.samples = second.samples = second.first_sample = 32;
            first.indirect_samples = second.indirect_samples = 128;
            const auto results = meter.shade({request, first, second});
            const Rgb halves = 0.5f * (results[1].mean + results[2].mean);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(halves[c], results[0].mean[c], 1e-5f * (1 + results[0].mean[c]));
        }
    }
}

TEST(Reproducible, SeedsDiffer) {
    Meter meter(tiny::cornell_box());
    ShadeRequest request = many_requests(meter, 2)[1];
    ShadeRequest other = request;
    ++other.seed;
    const auto results = meter.shade({request, other});
    EXPECT_NE(results[0].mean, results[1].mean);
}

// Estimated over actual variance of the mean after `batches` of 64 samples, over 600 seeds, at a
// few places and of each kind of light. Batches continue one another and are merged as independent
// ones, as the Shading Cache does it.
std::vector<double> variance_ratios(Meter& meter, std::span<const Light> lights,
                                    std::uint32_t batches) {
    constexpr std::uint32_t kSeeds = 600;
    const double part = 1.0 / batches;
    const Vec3 looks[] = {{0.1f, -1, 0.6f}, {1, 0.1f, 0.7f}, {-0.2f, 0.2f, 1}};
    std::vector<double> ratios;
    for (const Vec3 look : looks) {
        const Hit hit = meter.look({2.78f, 2.7f, 0.2f}, look);
        for (const Light light : lights) {
            std::vector<ShadeRequest> requests;
            for (std::uint32_t seed = 0; seed < kSeeds; ++seed)
                for (std::uint32_t batch = 0; batch < batches; ++batch)
                    requests.push_back({.where = hit.point,
                                        .front = hit.front,
                                        .light = light,
                                        .seed = seed,
                                        .first_sample = 64 * batch,
                                        .samples = 64,
                                        .indirect_samples = 64});
            const auto results = meter.shade(requests);
            double mean = 0, squares = 0, estimated = 0;
            for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
                double of_seed = 0;
                for (std::uint32_t batch = 0; batch < batches; ++batch) {
                    const ShadeResult& r = results[seed * batches + batch];
                    of_seed += part * r.mean.g;
                    estimated += part * part * r.variance.g / kSeeds;
                }
                mean += of_seed / kSeeds;
                squares += of_seed * of_seed / kSeeds;
            }
            const double actual = (squares - mean * mean) * kSeeds / (kSeeds - 1);
            if (actual > 1e-6 * mean * mean) ratios.push_back(estimated / actual);
        }
    }
    return ratios;
}

// A variance is right on average, and that of a merge is no smaller than the truth: parts of one
// sequence are spread better than independent ones, up to 2.6 times here. Standard error of a ratio
// 0.08, of the largest 0.25; bounds at least 5 of them, false alarm 6e-7 a ratio.
TEST(Reproducible, VarianceIsHonest) {
    const Light lights[] = {Light::direct, Light::indirect, Light::total};
    Meter joined(tiny::cornell_box(), Truth::bidirectional);
    for (const double ratio : variance_ratios(joined, std::span(lights).subspan(1, 1), 1))
        EXPECT_NEAR(ratio, 1, 0.45);
    Meter meter(tiny::cornell_box());
    const auto one = variance_ratios(meter, lights, 1);
    EXPECT_EQ(one.size(), 9u);
    for (const double ratio : one) EXPECT_NEAR(ratio, 1, 0.45);
    const auto merged = variance_ratios(meter, lights, 8);
    EXPECT_EQ(merged.size(), 9u);
    for (const double ratio : merged) {
        EXPECT_GT(ratio, 0.6);
        EXPECT_LT(ratio, 4);
    }
}

// Under a box whose outside was seen, a point of the floor is buried; beside it, it is not, and
// without the knowledge nothing is.
void expect_buried(Truth by) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(0.8f));
    tiny::add_room(scene, Vec3(-2), Vec3(2), white);
    tiny::add_box(scene, {-1, -1, -2.1f}, {0, 0, -1}, white);
    scene.lights.push_back(tiny::point_light({1, 1, 1}, Rgb(100)));
    Meter meter(scene, by);
    const auto floor_point = [&](Vec2 where) {
        // Face 0 of the room is z = -2 with u along y and v along x, wound inward: find it by
        // search.
        const Hit hit = meter.look({where.x, where.y, -1.999f}, {0, 0, -1});
        return hit.point;
    };
    const SurfacePoint under = floor_point({-0.5f, -0.5f});
    const SurfacePoint beside = floor_point({0.5f, 0.5f});
    ASSERT_EQ(under.object, ObjectId(0));
    const auto buried = [&](SurfacePoint where, Light light) {
        return meter
            .shade({{.where = where, .light = light, .samples = 64, .indirect_samples = 64}})[0]
            .buried;
    };
    for (const Light light : {Light::direct, Light::indirect, Light::total})
        EXPECT_FALSE(buried(under, light));
    for (std::uint32_t p = 0; p < 6; ++p)
        if (p != 0) meter.open_sides.mark(ObjectId(1), p, true);  // all but its hidden bottom
    for (std::uint32_t p = 0; p < 6; ++p) meter.open_sides.mark(ObjectId(0), p, true);
    for (const Light light : {Light::direct, Light::indirect, Light::total}) {
        EXPECT_TRUE(buried(under, light)) << int(light);
        EXPECT_FALSE(buried(beside, light)) << int(light);
    }
}

TEST(Buried, InsideABoxWhoseOutsideWasSeen) {
    for (const Truth by : tiny::kTruths) expect_buried(by);
}

// The far side of a room's wall is open to rays that go nowhere: not buried, and dark.
TEST(Buried, OutsideInTheVoidIsNot) {
    Meter meter(tiny::cornell_box());
    const Hit hit = meter.look({2.78f, 2.7f, 0.2f}, {0, -1, 0.3f});
    ShadeRequest request = {
        .where = hit.point, .front = !hit.front, .light = Light::indirect, .samples = 64};
    const ShadeResult result = meter.shade({request})[0];
    EXPECT_EQ(result.mean, Rgb(0));
    EXPECT_FALSE(result.buried);
}

}  // namespace
}  // namespace chiaro
