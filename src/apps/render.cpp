// chiaro render: the Shading Cache without a window.

#include "apps/commands.h"
#include "apps/open_scene.h"
#include "apps/output.h"
#include "apps/render_settings.h"
#include "base/error.h"
#include "import/output_file.h"

#include <chrono>
#include <cmath>
#include <cstdio>

namespace chiaro {
namespace {

constexpr double kDefaultSeconds = 10;

void check_budget(const Options& options) {
    check_time(options);
    constexpr std::uint64_t kMostPoints = 1'000'000'000'000;
    if (options.samples && (*options.samples == 0 || *options.samples > kMostPoints))
        throw Error("--samples", "it must lie between 1 and 1000000000000");
}

// Cycles until the budget is spent or the user has seen enough.
RunFigures run_cycles(UpdateCycle& cycle, const Options& options) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    const double seconds = options.time.value_or(options.samples ? INFINITY : kDefaultSeconds);

    ProgressBar bar;
    RunFigures figures;
    std::size_t idle_cycles = 0;
    do {
        const std::size_t before = cycle.statistics().points_shaded;
        cycle.run();
        if (cycle.statistics().cycles == 1) figures.first_picture_seconds = elapsed();
        const std::size_t points = cycle.statistics().points_shaded;
        double part = std::isfinite(seconds) && seconds > 0 ? elapsed() / seconds : 0;
        if (options.samples)
            part =
                std::max(part, static_cast<double>(points) / static_cast<double>(*options.samples));
        bar.show(part, std::to_string(points) + " points, " +
                           std::to_string(cycle.cache().patches().size()) + " patches");
        // Nothing in view needs shading: more cycles would change nothing.
        idle_cycles = points == before ? idle_cycles + 1 : 0;
        if (idle_cycles == 8 && options.samples) break;
    } while (!interrupted() && elapsed() < seconds &&
             (!options.samples || cycle.statistics().points_shaded < *options.samples));
    figures.seconds = elapsed();
    return figures;
}

}  // namespace

int render_command(const Options& options) {
    check_outputs(options);
    check_budget(options);
    SessionSettings settings = session_settings(options);
    settings.update.fixed_size = options.samples.has_value();
    Scene scene = open_scene(options);
    Camera camera = choose_camera(scene, options);
    apply_edits(scene, camera, options);
    add_headlamp_if_dark(scene, camera);

    Session session(std::move(scene), camera, settings);
    catch_interrupts();
    const RunFigures figures = run_cycles(session.cycle(), options);
    save_picture(options.output, options, session.cycle().picture());
    if (!options.statistics.empty())
        replace_file(options.statistics, statistics_json(session.cycle(), figures));
    return 0;
}

}  // namespace chiaro
