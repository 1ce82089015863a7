// chiaro play: timed edits and animations, replayed on the update loop.

#include "apps/commands.h"
#include "apps/open_scene.h"
#include "apps/output.h"
#include "apps/render_settings.h"
#include "base/error.h"
#include "import/image_file.h"
#include "import/output_file.h"
#include "import/resolve_edits.h"
#include "scene/animate.h"
#include "update/session.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace chiaro {
namespace {

// How long a script is looked at that asks for no pictures: after its last edit [s].
constexpr double kSecondsAfterLast = 2;

// What a cycle of fixed size stands for [s].
constexpr double kFixedCycle = 0.05;

// Each picture is written both tone-mapped and as it is.
constexpr const char* kEndings[] = {".png", ".exr"};

// What happens when, in seconds from the start.
struct Timeline {
    struct Moment {
        double time;
        Edit edit;
    };
    std::vector<Moment> edits;   // by time
    std::vector<double> frames;  // by time
    const Animation* animation = nullptr;
};

const Animation& named_animation(const Scene& scene, const std::string& name) {
    std::string known;
    for (const Animation& animation : scene.animations) {
        if (animation.name == name) return animation;
        known += (known.empty() ? "" : ", ") + animation.name;
    }
    throw Error("--animation", "the scene has no animation '" + name + "'",
                known.empty() ? "it has none" : "it has " + known);
}

Timeline make_timeline(const Options& options, const Scene& scene, const Camera& camera) {
    Timeline timeline;
    if (!options.animation.empty()) timeline.animation = &named_animation(scene, options.animation);
    double end = timeline.animation ? timeline.animation->duration : 0.0;
    if (!options.script.empty()) {
        const EditScript script = read_edits(options.script);
        EditResolver resolver(scene, camera);
        for (const TimedEdit& timed : script.edits)
            for (Edit& edit : resolver.resolve(timed.edit, timed.where)) {
                timeline.edits.push_back({timed.time, std::move(edit)});
                end = std::max(end, timed.time + kSecondsAfterLast);
            }
        timeline.frames = script.frames;
    }
    if (timeline.frames.empty()) timeline.frames.push_back(end);
    std::sort(timeline.frames.begin(), timeline.frames.end());
    return timeline;
}

// Applies what is due; edits are made in their order, animation is that of the moment.
class Player {
public:
    /// `at_first`: the scene before it is played.
    Player(Session& session, const Timeline& timeline, const Scene& at_first, std::string camera)
        : session_(session), timeline_(timeline), at_first_(at_first), camera_(std::move(camera)) {}

    void advance(double now) {
        while (next_ < timeline_.edits.size() && timeline_.edits[next_].time <= now)
            session_.apply(timeline_.edits[next_++].edit);
        if (!timeline_.animation) return;
        for (const Edit& edit : animate(at_first_, *timeline_.animation, now)) {
            const auto* camera = std::get_if<SetCamera>(&edit);
            if (!camera || camera->camera.name == camera_) session_.apply(edit);
        }
    }

private:
    Session& session_;
    const Timeline& timeline_;
    const Scene& at_first_;
    std::string camera_;  // that is looked through
    std::size_t next_ = 0;
};

std::string frame_path(const Options& options, std::size_t number, const char* ending) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%03zu%s", number, ending);
    return (std::filesystem::path(options.output) / name).string();
}

void save_frame(const Options& options, std::size_t number, const Image& picture) {
    for (const char* ending : kEndings)
        save_picture(frame_path(options, number, ending), options, picture);
}

void check_folder(const Options& options, std::size_t frames) {
    std::error_code failed;
    std::filesystem::create_directories(options.output, failed);
    if (failed || !std::filesystem::is_directory(options.output))
        throw Error("-o", "'" + options.output + "' is no folder and cannot be made one",
                    "name a folder for the pictures");
    for (std::size_t i = 0; i < frames; ++i)
        for (const char* ending : kEndings) check_writable(frame_path(options, i, ending));
    if (!options.statistics.empty()) check_replaceable(options.statistics);
}

FrameFigures figures_of(const UpdateCycle& cycle, double time, double seconds) {
    return {time, seconds, cycle.statistics().points_shaded, cycle.stale(), cycle.bytes()};
}

// Plays until the last picture that is wanted. Time is what a clock shows or, in cycles of fixed
// size, what they stand for.
RunFigures play(Session& session, Player& player, const Timeline& timeline,
                const Options& options) {
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] { return seconds_since(start); };
    const auto now = [&] {
        return options.fixed_cycles
                   ? kFixedCycle * static_cast<double>(session.cycle().statistics().cycles)
                   : elapsed();
    };
    ProgressBar bar;
    RunFigures figures;
    std::optional<FadeIn> fade;
    if (options.fade_in > 0) fade.emplace(options.fade_in);
    while (figures.frames.size() < timeline.frames.size() && !interrupted()) {
        player.advance(now());
        session.run();
        if (fade) fade->advance(session.cycle().cache(), session.threads());
        if (session.cycle().statistics().cycles == 1) figures.first_picture_seconds = elapsed();
        while (figures.frames.size() < timeline.frames.size() &&
               timeline.frames[figures.frames.size()] <= now()) {
            const double time = timeline.frames[figures.frames.size()];
            save_frame(options, figures.frames.size(),
                       session.cycle().picture(fade ? &*fade : nullptr));
            figures.frames.push_back(figures_of(session.cycle(), time, elapsed()));
        }
        bar.show(timeline.frames.back() > 0 ? now() / timeline.frames.back() : 1,
                 std::to_string(session.cycle().statistics().points_shaded) + " points");
    }
    figures.seconds = elapsed();
    return figures;
}

}  // namespace

int play_command(const Options& options) {
    if (options.script.empty() && options.animation.empty())
        throw Error("play", "nothing is to be played", "give --script FILE or --animation NAME");
    SessionSettings settings = session_settings(options);
    settings.update.fixed_size = options.fixed_cycles;
    Scene scene = open_scene(options);
    Camera camera = choose_camera(scene, options);
    apply_edits(scene, camera, options);
    add_headlamp_if_dark(scene, camera);

    const Scene at_first = scene;
    const Timeline timeline = make_timeline(options, at_first, camera);
    check_folder(options, timeline.frames.size());

    Session session(std::move(scene), camera, settings);
    Player player(session, timeline, at_first, camera.name);
    catch_interrupts();
    const RunFigures figures = play(session, player, timeline, options);
    if (!options.statistics.empty())
        replace_file(options.statistics, statistics_json(session.cycle(), figures));
    return 0;
}

}  // namespace chiaro
