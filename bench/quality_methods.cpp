#include "quality_methods.h"

#include "base/error.h"
#include "base/image_difference.h"
#include "base/tone_map.h"
#include "figures.h"
#include "import/image_file.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/reference_renderer.h"
#include "update/make_renderer.h"
#include "update/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_set>

namespace chiaro {
namespace {

using Json = nlohmann::ordered_json;

constexpr Method kMethods[] = {
    {.option = "best",
     .title = "best",
     .cached = true,
     .renderer = RendererName::gather,
     .levels = CoarserLevels::up_to_a_tenth},
    {.option = "roots", .title = "roots", .cached = true, .renderer = RendererName::gather},
    {.option = "traced",
     .title = "best, traced",
     .cached = true,
     .levels = CoarserLevels::up_to_a_tenth},
    {.option = "bidirectional",
     .title = "best, bidirectional",
     .cached = true,
     .renderer = RendererName::bidirectional,
     .levels = CoarserLevels::up_to_a_tenth},
    {.option = "paper", .title = "paper", .cached = true, .scheme = Scheme::paper},
    {.option = "edited",
     .title = "edited",
     .cached = true,
     .renderer = RendererName::gather,
     .edited = true},
    {.option = "path", .title = "path", .cached = false},
};

RayCaster make_rays(const Scene& scene, int threads, Stage::Loading& loading) {
    const std::size_t before = resident_bytes();
    const Stopwatch watch;
    RayCaster rays(scene, threads);
    loading.embree_seconds = watch.seconds();
    loading.embree_bytes = std::max(before, resident_bytes()) - before;
    return rays;
}

AreaLights make_area_lights(const Scene& scene, Stage::Loading& loading) {
    const Stopwatch watch;
    AreaLights lights(scene);
    loading.area_lights_seconds = watch.seconds();
    return lights;
}

// Writes down what is measured at checkpoints, each a fifth later than the one before, and when a
// picture is to be kept.
class Recorder {
public:
    Recorder(const Method& method, const Measuring& measuring)
        : method_(method), measuring_(measuring) {}

    bool due(double seconds) {
        const bool checkpoint = seconds >= next_checkpoint_;
        while (next_checkpoint_ <= seconds) next_checkpoint_ *= 1.2;
        return checkpoint || picture_due(seconds);
    }

    // A picture that is looked at has to be drawn once, which takes `drawing`.
    Json& add(double seconds, double drawing, const Image& picture) {
        const ImageDifference d =
            difference(picture, measuring_.reference.half_1, measuring_.reference.half_2);
        Json row = {{"seconds", seconds + drawing}, {"psnr", d.psnr}, {"relmse", d.relmse}};
        if (rows.empty()) row["first_picture"] = true;
        for (; picture_due(seconds); ++next_picture_) {
            const double time = measuring_.picture_times[next_picture_];
            const std::string name = fmt::format("{}_{}", method_.option, time);
            keep_picture(measuring_, name, picture);
            pictures.push_back({{"name", name}, {"time", time}, {"seconds", seconds + drawing}});
        }
        rows.push_back(std::move(row));
        return rows.back();
    }

    Json rows = Json::array();
    Json pictures = Json::array();

private:
    bool picture_due(double seconds) const {
        return !measuring_.picture_folder.empty() &&
               next_picture_ < measuring_.picture_times.size() &&
               seconds >= measuring_.picture_times[next_picture_];
    }

    const Method& method_;
    const Measuring& measuring_;
    double next_checkpoint_ = 0.02;
    std::size_t next_picture_ = 0;
};

// Triangles that the view shows any of; a quad is two.
std::size_t visible_triangles(const ShadingCache& cache) {
    std::unordered_set<std::uint32_t> primitives;
    std::size_t count = 0;
    for (const Patch& patch : cache.patches()) {
        if (!patch.is_root() || patch.fragment_count == 0) continue;
        const std::uint32_t primitive = patch.parent / 2;  // whichever side is seen
        if (primitives.insert(primitive).second) count += patch.is_quad() ? 2 : 1;
    }
    return count;
}

Json seconds_by_step(const Timings& timings, const Timings& before = {}) {
    Json steps;
    for (std::size_t i = 0; i < kSteps; ++i)
        steps[kStepNames[i]] = timings.seconds[i] - before.seconds[i];
    return steps;
}

Json measure_cache(const Method& method, const Measuring& measuring) {
    Stage& stage = measuring.stage;
    OpenSides open_sides(stage.scene);
    const auto renderer = make_renderer(method.renderer, stage.scene, stage.rays, stage.area_lights,
                                        &open_sides, stage.threads);
    Recorder recorder(method, measuring);
    Json loading, steps;
    Stopwatch watch;
    const MeshGraphs graphs(stage.scene, method.levels, stage.threads);
    loading["graphs_seconds"] = watch.seconds();
    loading["graphs_bytes"] = graphs.bytes();

    double spent = 0;
    std::optional<Timings> halfway;
    watch.restart();
    UpdateCycle cycle(stage.rays, graphs, *renderer, open_sides,
                      {.scheme = method.scheme, .threads = stage.threads});
    cycle.look_from(stage.view);
    for (bool first = true; first || spent < measuring.seconds; first = false) {
        cycle.run();
        spent += watch.seconds();
        if (first) {
            loading["visible_triangles"] = visible_triangles(cycle.cache());
            steps = seconds_by_step(cycle.statistics().timings);
        }
        if (!halfway && spent >= measuring.seconds / 2) halfway = cycle.statistics().timings;
        if (recorder.due(spent) || first) {
            watch.restart();
            const Image picture = cycle.picture();
            Json& row = recorder.add(spent, watch.seconds(), picture);
            row["bytes_per_patch"] = static_cast<double>(cycle.bytes()) /
                                     static_cast<double>(cycle.cache().patches().size());
            row["points"] = cycle.statistics().points_shaded;
        }
        watch.restart();
    }
    const auto points = static_cast<double>(cycle.statistics().points_shaded);
    recorder.rows.front()["share_of_points"] =
        recorder.rows.front()["points"].get<double>() / std::max(1.0, points);
    return {{"loading", loading},
            {"first_picture_seconds", steps},
            {"second_half_seconds", seconds_by_step(cycle.statistics().timings, *halfway)},
            {"pictures", recorder.pictures},
            {"rows", recorder.rows}};
}

// Of all points that were shaded before the edits, those that stay as they are is what counts.
Json count_stale(const ShadingCache& cache) {
    Json counts = Json::array();
    for (int c = 0; c < cache.channels(); ++c) {
        std::size_t evaluated = 0, stale = 0;
        for (std::size_t i = 0; i < cache.vertices().size(); ++i)
            if (const Estimate* e = cache.estimate(static_cast<VertexId>(i), c)) {
                ++evaluated;
                stale += e->stale;
            }
        counts.push_back({{"evaluated", evaluated}, {"stale", stale}});
    }
    return counts;
}

// The time that an edit takes counts.
Json measure_edited(const Method& method, const Measuring& measuring) {
    check(measuring.before != nullptr, "measure_edited: there is nothing before the edits");
    const Before& before = *measuring.before;
    const View& view = measuring.stage.view;
    Session session(before.scene, before.camera,
                    {.update = {.scheme = method.scheme, .threads = measuring.stage.threads},
                     .renderer = method.renderer,
                     .width = view.width(),
                     .height = view.height()});
    while (session.cycle().statistics().seconds < before.seconds) session.run();

    Recorder recorder(method, measuring);
    Json stale = {{"before", count_stale(session.cycle().cache())}};
    double spent = 0;
    Stopwatch watch;
    for (const Edit& edit : before.edits) session.apply(edit);
    for (bool first = true; first || spent < measuring.seconds; first = false) {
        session.run();
        spent += watch.seconds();
        if (first) stale["after_a_cycle"] = count_stale(session.cycle().cache());
        if (recorder.due(spent) || first) {
            watch.restart();
            const Image picture = session.cycle().picture();
            Json& row = recorder.add(spent, watch.seconds(), picture);
            row["stale"] = session.cycle().stale();
            row["points"] = session.cycle().statistics().points_shaded;
        }
        watch.restart();
    }
    stale["in_the_end"] = count_stale(session.cycle().cache());
    return {{"loading", Json::object()},
            {"stale", stale},
            {"pictures", recorder.pictures},
            {"rows", recorder.rows}};
}

Json measure_path_tracing(const Method& method, const Measuring& measuring) {
    const Stage& stage = measuring.stage;
    Recorder recorder(method, measuring);
    double spent = 0;
    Stopwatch watch;
    ReferenceRenderer renderer(make_lit_scene(stage.scene, stage.rays, stage.area_lights),
                               stage.view, {77, stage.threads});
    while (spent < measuring.path_seconds) {
        renderer.add_pass(1);
        spent += watch.seconds();
        if (recorder.due(spent) || renderer.samples() <= 4)
            recorder.add(spent, 0, renderer.image())["spp"] = renderer.samples();
        watch.restart();
    }
    return {{"loading", Json::object()}, {"pictures", recorder.pictures}, {"rows", recorder.rows}};
}

}  // namespace

Stage::Stage(Scene s, const View& v, int n)
    : scene(std::move(s)),
      rays(make_rays(scene, n, loading)),
      area_lights(make_area_lights(scene, loading)),
      view(v),
      threads(n) {}

const Method& method_of(const std::string& option) {
    std::string known;
    for (const Method& method : kMethods) {
        if (method.option == option) return method;
        known += (known.empty() ? "" : ", ") + std::string(method.option);
    }
    throw Error("--methods", "there is no method '" + option + "'", "there are " + known);
}

void keep_picture(const Measuring& measuring, const std::string& name, const Image& linear) {
    write_png(measuring.picture_folder + "/" + name + ".png",
              tone_mapped(linear, measuring.exposure));
}

Json measure(const Method& method, const Measuring& measuring) {
    if (method.edited) return measure_edited(method, measuring);
    return method.cached ? measure_cache(method, measuring)
                         : measure_path_tracing(method, measuring);
}

}  // namespace chiaro
