// Irradiance points a second of the renderers, beside Embree's own rate: exactly the rays that a
// renderer sent, in the same packets with the same flags, cast again by Embree alone. Prints JSON.
//
// One thread. Renderer and replay take turns every few points, and both are timed by the thread's
// own processor time, so that other programs disturb neither much and both alike.

#include "apps/options.h"
#include "base/random.h"
#include "figures.h"
#include "furnished_box.h"
#include "rays/ray_caster.h"
#include "run_program.h"
#include "spread.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace chiaro {
namespace {

constexpr std::uint32_t kDirectSamples = 100;
constexpr std::uint32_t kIndirectSamples = 400;
constexpr std::size_t kPointsATurn = 10;

struct Settings {
    std::vector<int> quads = {2000, 50'000, 500'000};
    std::vector<std::string> renderers = {"path", "caustic", "bidirectional", "gather"};
    int points = 300;
    int repetitions = 11;
};

// Points spread evenly over the area of all surfaces, on their fronts.
std::vector<ShadeRequest> spread_points(const Scene& scene, int count, std::uint32_t seed) {
    std::vector<SurfacePoint> primitives;
    std::vector<double> area_up_to;
    double area = 0;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const auto id = static_cast<ObjectId>(o);
        const auto n =
            static_cast<std::uint32_t>(scene.mesh_of(scene.objects[o]).primitives.size());
        for (std::uint32_t p = 0; p < n; ++p) {
            area += primitive_area(scene, id, p);
            primitives.push_back({id, p});
            area_up_to.push_back(area);
        }
    }
    Rng rng(seed);
    std::vector<ShadeRequest> requests;
    for (int i = 0; i < count; ++i) {
        const auto found =
            std::upper_bound(area_up_to.begin(), area_up_to.end(), area * rng.uniform());
        const auto index = std::min<std::size_t>(found - area_up_to.begin(), primitives.size() - 1);
        ShadeRequest request;
        request.where = primitives[index];
        request.where.u = rng.uniform();
        request.where.v = rng.uniform();
        request.light = Light::total;
        request.seed = hash32(seed, static_cast<std::uint32_t>(i));
        request.samples = kDirectSamples;
        request.indirect_samples = kIndirectSamples;
        requests.push_back(request);
    }
    return requests;
}

// The requests a few at a time, after(turn) following each; returns the renderer's seconds.
template <typename After>
double shade_in_turns(SampleRenderer& renderer, std::span<const ShadeRequest> requests,
                      const After& after) {
    std::vector<ShadeResult> results(kPointsATurn);
    double seconds = 0;
    for (std::size_t first = 0; first < requests.size(); first += kPointsATurn) {
        const std::size_t count = std::min(kPointsATurn, requests.size() - first);
        const double start = thread_seconds();
        renderer.shade(requests.subspan(first, count), std::span(results).first(count));
        seconds += thread_seconds() - start;
        after(first / kPointsATurn);
    }
    return seconds;
}

// Every repetition begins with a new renderer that has shaded other points first, so that one which
// remembers sends the same rays each time, and not a beginner's.
nlohmann::ordered_json measure(const Scene& scene, RayCaster& caster, const std::string& name,
                               const Settings& settings) {
    const AreaLights area_lights(scene);
    const OpenSides open_sides(scene);
    const auto before = spread_points(scene, settings.points, 1);
    const auto requests = spread_points(scene, settings.points, 2);
    const auto prepared_renderer = [&] {
        auto renderer = make_renderer(parse_renderer(name, RendererName::path), scene, caster,
                                      area_lights, &open_sides, 1);
        shade_in_turns(*renderer, before, [](std::size_t) {});
        return renderer;
    };

    RayLog log;
    std::vector<std::size_t> turn_ends;
    const auto recorded = prepared_renderer();
    caster.record(&log);
    shade_in_turns(*recorded, requests,
                   [&](std::size_t) { turn_ends.push_back(log.packets.size()); });
    caster.record(nullptr);

    std::vector<double> renderer_rates, embree_rates, ratios;
    const std::span<const LoggedPacket> packets(log.packets);
    for (int i = 0; i < settings.repetitions; ++i) {
        const auto renderer = prepared_renderer();
        double embree_seconds = 0;
        const double seconds = shade_in_turns(*renderer, requests, [&](std::size_t turn) {
            const std::size_t first = turn == 0 ? 0 : turn_ends[turn - 1];
            embree_seconds += replay(caster, packets.subspan(first, turn_ends[turn] - first));
        });
        renderer_rates.push_back(settings.points / seconds);
        embree_rates.push_back(settings.points / embree_seconds);
        ratios.push_back(embree_seconds / seconds);
    }
    nlohmann::ordered_json result;
    result["renderer"] = name;
    result["rays_a_point"] = static_cast<double>(log.rays()) / settings.points;
    result["lanes_used"] =
        static_cast<double>(log.rays()) / (16.0 * static_cast<double>(packets.size()));
    result["points_a_second"] = spread_of(renderer_rates);
    result["embree_points_a_second"] = spread_of(embree_rates);
    result["ratio"] = spread_of(ratios);
    return result;
}

std::size_t quad_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Object& object : scene.objects) count += scene.mesh_of(object).quad_count;
    return count;
}

}  // namespace

int run(int argc, char** argv) {
    Settings settings;
    CLI::App app("Irradiance points a second of 100 + 400 samples, beside Embree's own rate.");
    app.add_option("--quads", settings.quads, "sizes of the scenes")->delimiter(',');
    app.add_option("--renderers", settings.renderers, "by name")->delimiter(',');
    app.add_option("--points", settings.points, "a repetition");
    app.add_option("--repetitions", settings.repetitions, "whose median counts");
    CLI11_PARSE(app, argc, argv);

    nlohmann::ordered_json rows = nlohmann::json::array();
    for (const int quads : settings.quads) {
        const Scene scene = make_furnished_box(quads);
        RayCaster caster(scene, 1);
        for (const std::string& renderer : settings.renderers) {
            rows.push_back(measure(scene, caster, renderer, settings));
            rows.back()["quads"] = quad_count(scene);
            const auto& row = rows.back();
            fmt::print(stderr, "{:7} quads, {:10} {:6.0f} points/s of {:6.0f}: {:.3f}\n",
                       row["quads"].get<std::size_t>(), renderer,
                       row["points_a_second"]["median"].get<double>(),
                       row["embree_points_a_second"]["median"].get<double>(),
                       row["ratio"]["median"].get<double>());
        }
    }
    nlohmann::ordered_json result;
    result["direct_samples"] = kDirectSamples;
    result["indirect_samples"] = kIndirectSamples;
    result["points"] = settings.points;
    result["repetitions"] = settings.repetitions;
    result["rows"] = rows;
    std::printf("%s\n", result.dump(1).c_str());
    return 0;
}

}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run);
}
