// Renderers tell the same of the same scenes: those that are unbiased within their noise, `gather`
// within its published bias.
#include "import/load_scene.h"
#include "sample_renderer/caustic_renderer.h"
#include "sample_renderer/gather_renderer.h"
#include "sample_renderer/meter.h"
#include "scene/built_in.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

namespace chiaro::tiny {
namespace {

constexpr int kRuns = 8;
constexpr double kMostNoise = 0.03;  // of a renderer's mean, relative
constexpr int kAcross = 12;          // places that the picture shows, by a grid of 12 x 9

struct Setting {
    const char* scene;
    Camera camera;
};

// Views of docs/overview.md and of the scenes' own descriptions.
const Setting kSettings[] = {
    {"cornell", {.eye = {2.78f, 2.73f, -8}, .target = {2.78f, 2.73f, 0}, .vertical_fov = 39.3f}},
    {"room", {.eye = {5.9f, 1.75f, 4.4f}, .target = {2.7f, 0.9f, 1.2f}, .vertical_fov = 55}},
    {"cornell_mcguire/CornellBox-Water.obj", {.eye = {0, 1, 2.7f}, .target = {0, 1, 0}}},
    {"cornell_mcguire/CornellBox-Mirror.obj", {.eye = {0, 1, 2.7f}, .target = {0, 1, 0}}},
    {"cornell_mcguire/CornellBox-Sphere.obj", {.eye = {0, 1, 2.7f}, .target = {0, 1, 0}}},
    {"occluded_box_lumen/occluded.obj", {.eye = {0.7f, 0.5f, 15.5f}, .target = {0.7f, 0.5f, 0}}}};

std::optional<Scene> find_scene(const std::string& name) {
    if (auto scene = built_in_scene(name)) return scene;
    const std::filesystem::path file = std::filesystem::path(CHIARO_SCENES) / name;
    if (!std::filesystem::exists(file)) return std::nullopt;
    return load_scene(file);
}

std::vector<ShadeRequest> places_in_view(const Meter& meter, const Camera& camera) {
    const View view(camera, kAcross, kAcross * 3 / 4);
    std::vector<ShadeRequest> requests;
    for (int y = 0; y < view.height(); ++y)
        for (int x = 0; x < view.width(); ++x) {
            const Ray ray = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            Hit hit;
            meter.caster.intersect({&ray, 1}, {&hit, 1}, RayKind::camera);
            if (!hit) continue;
            ShadeRequest request;
            request.where = hit.point;
            request.front = hit.front;
            request.light = Light::indirect;
            requests.push_back(request);
        }
    return requests;
}

// Mean over the places, in each of several runs.
struct Told {
    double mean = 0, deviation = 0;  // of the runs' mean
};

Told tell(SampleRenderer& renderer, std::vector<ShadeRequest> requests, std::uint32_t samples,
          std::uint32_t seed) {
    double sum = 0, squares = 0;
    for (std::uint32_t run = 0; run < kRuns; ++run) {
        for (std::uint32_t i = 0; i < requests.size(); ++i) {
            requests[i].samples = samples;
            requests[i].seed = hash32(hash32(seed, run), i);
        }
        std::vector<ShadeResult> results(requests.size());
        renderer.shade(requests, results);
        double mean = 0;
        for (const ShadeResult& r : results)
            mean += double(luminance(r.mean)) / double(requests.size());
        sum += mean / kRuns;
        squares += mean * mean / kRuns;
    }
    return {sum, std::sqrt(std::max(squares - sum * sum, 0.0) / (kRuns - 1))};
}

class Agreement : public testing::TestWithParam<Setting> {};

// Student's t of 14 degrees of freedom passes 6.3 once in 50,000 times; six pairs and six scenes:
// false alarm below 1e-3.
TEST_P(Agreement, OfAllRenderers) {
    const Setting& setting = GetParam();
    auto scene = find_scene(setting.scene);
    if (!scene) GTEST_SKIP() << setting.scene << " is absent";
    const Meter meter(std::move(*scene));
    const auto requests = places_in_view(meter, setting.camera);
    ASSERT_GT(requests.size(), 60u);

    PathRenderer path(meter.scene, meter.caster, meter.area_lights, nullptr, 2);
    BidirectionalRenderer bidirectional(meter.scene, meter.caster, meter.area_lights, nullptr, 2);
    CausticRenderer caustic(meter.scene, meter.caster, meter.area_lights, nullptr, 2);
    GatherRenderer gather(meter.scene, meter.caster, meter.area_lights, nullptr, 2);
    tell(gather, requests, 256, 5);  // cells that the places ask for
    struct Witness {
        const char* name;
        Told told;
        double bias;
    };
    const std::array<Witness, 4> all = {
        {{"path", tell(path, requests, 2048, 1), 0},
         {"bidirectional", tell(bidirectional, requests, 512, 2), 0},
         {"caustic", tell(caustic, requests, 1024, 3), 0},
         {"gather", tell(gather, requests, 2048, 4), kGatherBias}}};
    for (const Witness& w : all) {
        EXPECT_LT(w.told.deviation, kMostNoise * w.told.mean) << w.name << " tells nothing";
        std::printf("%s: %s %g +- %.2f %%\n", setting.scene, w.name, w.told.mean,
                    100 * w.told.deviation / w.told.mean);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Witness &a = all[i], &b = all[j];
            const double noise = 6.3 * std::hypot(a.told.deviation, b.told.deviation);
            EXPECT_NEAR(a.told.mean, b.told.mean, noise + (a.bias + b.bias) * a.told.mean)
                << setting.scene << ": " << a.name << " and " << b.name;
        }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, testing::ValuesIn(kSettings));

}  // namespace
}  // namespace chiaro::tiny
