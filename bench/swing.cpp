// What a scene that is edited 30 times a second costs, and what it comes to: a lamp swings, an
// object is dragged, the camera walks, or goes aside and back. Prints one JSON object.
//
// Edits come by the clock, so that a slow cycle has several to follow. When they have ended the
// picture is measured against fresh caches of the scene as it is by then.

#include "apps/open_scene.h"
#include "apps/render_settings.h"
#include "base/error.h"
#include "base/image_difference.h"
#include "figures.h"
#include "run_program.h"
#include "scene/animate.h"
#include "scene/built_in_paths.h"
#include "update/session.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace chiaro {
namespace {

using Json = nlohmann::ordered_json;

struct Swinging {
    std::string what = "object";  // is moved: object, light, dimmed, camera or return
    std::string name;             // of the object or the light
    double seconds = 60;
    double rate = 30;  // edits a second
    double rest = 10;  // seconds after the last edit
    float reach = 0.5f;
    int steps = 20;  // of `return`, each way
};

void add_options(CLI::App& app, Swinging& s) {
    app.add_option("--what", s.what,
                   "object or light: --name swings to and fro; dimmed: its light does; camera: "
                   "along the scene's path; return: the camera goes aside and back")
        ->check(CLI::IsMember({"object", "light", "dimmed", "camera", "return"}));
    app.add_option("--name", s.name, "of the object or the light that is edited");
    app.add_option("--seconds", s.seconds, "for which edits come");
    app.add_option("--rate", s.rate, "edits a second")->check(CLI::PositiveNumber);
    app.add_option("--rest", s.rest, "seconds after the last edit");
    app.add_option("--reach", s.reach, "how far things move [scene units]");
    app.add_option("--steps", s.steps, "of the camera each way");
}

template <typename Id, typename Things>
Id named(const Things& things, const std::string& name) {
    const auto found = std::ranges::find(things, name, [](const auto& t) { return t.name; });
    if (found == things.end())
        throw Error("--name", "the scene has no '" + name + "'", "chiaro info lists what it has");
    return static_cast<Id>(found - things.begin());
}

// The edits of a moment, of a scene as it was at first.
std::vector<Edit> edits_at(const Swinging& s, const Scene& at_first, const Camera& camera,
                           double seconds) {
    // To and fro in 4 seconds, along two axes so that no place comes twice.
    const auto phase = static_cast<float>(seconds * 2 * 3.14159265 / 4);
    const Vec3 by = s.reach * Vec3(std::sin(phase), 0, 0.3f * std::sin(0.7f * phase));
    if (s.what == "camera") {
        std::vector<Edit> edits;
        for (Edit& edit : animate(at_first, at_first.animations.front(), seconds))
            if (const auto* look = std::get_if<SetCamera>(&edit))
                if (look->camera.name == camera.name) edits.push_back(edit);
        return edits;
    }
    if (s.what == "light") {
        const auto light = named<LightId>(at_first.lights, s.name);
        PunctualLight value = at_first.lights[index_of(light)];
        value.position += by;
        return {SetLight{light, value}};
    }
    const auto object = named<ObjectId>(at_first.objects, s.name);
    if (s.what == "dimmed") return {SetEmission{object, Rgb(0.6f + 0.4f * std::sin(phase))}};
    const Mat4& place = at_first.objects[index_of(object)].to_world;
    return {SetTransform{object, glm::translate(Mat4(1), by) * place}};
}

Json spread_of(std::vector<double> ms) {
    if (ms.empty()) return {};
    std::sort(ms.begin(), ms.end());
    const auto at = [&](double part) {
        return ms[static_cast<std::size_t>(part * static_cast<double>(ms.size() - 1))];
    };
    const double mean = std::accumulate(ms.begin(), ms.end(), 0.0) / double(ms.size());
    return {{"mean", mean}, {"median", at(0.5)}, {"p95", at(0.95)}, {"max", ms.back()}};
}

// Milliseconds a cycle by step, of cycles since `before`.
Json steps_of(const Statistics& now, const Statistics& before) {
    const double cycles = std::max(1.0, double(now.cycles) - double(before.cycles));
    Json steps;
    for (std::size_t i = 0; i < kSteps; ++i)
        steps[kStepNames[i]] = 1000 * (now.timings.seconds[i] - before.timings.seconds[i]) / cycles;
    return steps;
}

void run_for(Session& session, double seconds) {
    for (const Stopwatch watch; watch.seconds() < seconds;) session.run();
}

// Edits by the clock. Cycles' milliseconds, and bytes of the cache at 1/6, 1/2 and the end.
Json swing(Session& session, const Swinging& s, const Scene& at_first, const Camera& camera) {
    const Statistics before = session.cycle().statistics();
    const double processor = processor_seconds();
    std::vector<double> ms;
    Json bytes;
    std::vector<double> marks = {s.seconds / 6, s.seconds / 2, s.seconds};
    std::size_t edits = 0;
    const Stopwatch watch;
    while (watch.seconds() < s.seconds) {
        for (; static_cast<double>(edits) <= s.rate * watch.seconds(); ++edits)
            for (const Edit& edit :
                 edits_at(s, at_first, camera, static_cast<double>(edits) / s.rate))
                session.apply(edit);
        const Stopwatch cycle;
        session.run();
        ms.push_back(1000 * cycle.seconds());
        while (!marks.empty() && watch.seconds() >= marks.front()) {
            bytes[fmt::format("{:.0f} s", marks.front())] = session.cycle().bytes();
            marks.erase(marks.begin());
        }
    }
    const Statistics& now = session.cycle().statistics();
    const double cycles = static_cast<double>(ms.size());
    return {{"edits", edits},
            {"cycles", ms.size()},
            {"cycle_ms", spread_of(ms)},
            {"step_ms", steps_of(now, before)},
            {"processor_ms", 1000 * (processor_seconds() - processor) / cycles},
            {"points_a_cycle", double(now.points_shaded - before.points_shaded) / cycles},
            {"bytes", bytes},
            {"resident_bytes", resident_bytes()}};
}

// PSNR of what rests against two fresh caches that have had as long, beside that of a third.
Json rest(Session& session, const Swinging& s, const SessionSettings& settings) {
    std::vector<Image> shown;
    for (int half = 0; half < 2; ++half) {
        run_for(session, s.rest / 2);
        shown.push_back(session.cycle().picture());
    }
    std::vector<Image> fresh;
    std::vector<Image> third;
    for (std::uint64_t seed = 11; seed < 14; ++seed) {
        SessionSettings other = settings;
        other.update.seed = seed;
        Session session_of_seed(session.scene(), session.camera(), other);
        run_for(session_of_seed, s.rest / 2);
        if (seed == 13) third.push_back(session_of_seed.cycle().picture());
        run_for(session_of_seed, s.rest / 2);
        (seed == 13 ? third : fresh).push_back(session_of_seed.cycle().picture());
    }
    Json psnr;
    for (int half = 0; half < 2; ++half) {
        const std::string when = fmt::format("{:.2g} s", s.rest * (half + 1) / 2);
        psnr["edited"][when] = difference(shown[half], fresh[0], fresh[1]).psnr;
        psnr["fresh"][when] = difference(third[half], fresh[0], fresh[1]).psnr;
    }
    return psnr;
}

// Points shaded at each step of a camera that goes aside and comes back the same way.
Json go_and_return(Session& session, const Swinging& s, const Camera& camera) {
    const Vec3 aside = glm::normalize(glm::cross(camera.target - camera.eye, camera.up)) * s.reach;
    Json out = Json::array(), back = Json::array();
    for (int i = 1; i <= 2 * s.steps; ++i) {
        const int place = i <= s.steps ? i : 2 * s.steps - i;
        Camera look = camera;
        look.eye += aside * (static_cast<float>(place) / static_cast<float>(s.steps));
        const std::size_t before = session.cycle().statistics().points_shaded;
        session.apply(SetCamera{look});
        session.run();
        (i <= s.steps ? out : back).push_back(session.cycle().statistics().points_shaded - before);
    }
    return {{"out", out}, {"back", back}};
}

int run(int argc, char** argv) {
    Options options;
    Swinging s;
    CLI::App app("What a scene costs that is edited all the time.");
    add_scene_options(app, options);
    add_view_options(app, options);
    add_render_options(app, options);
    add_options(app, s);
    CLI11_PARSE(app, argc, argv);

    const SessionSettings settings = session_settings(options);
    Scene scene = open_scene(options);
    const Camera camera = choose_camera(scene, options);
    if (s.what == "camera" && scene.animations.empty())
        throw Error("--what", "the scene has no path to walk along", "see chiaro info");
    const Scene at_first = scene;
    Session session(std::move(scene), camera, settings);
    constexpr double kBefore = 3;
    run_for(session, kBefore);

    Json result = {{"scene", options.scene},
                   {"what", s.what},
                   {"name", s.name},
                   {"size", options.size},
                   {"threads", settings.update.threads}};
    if (s.what == "return") {
        result["points_a_step"] = go_and_return(session, s, camera);
    } else {
        result.update(swing(session, s, at_first, camera));
        if (s.rest > 0) result["psnr"] = rest(session, s, settings);
    }
    std::printf("%s\n", result.dump(1).c_str());
    return 0;
}

}  // namespace
}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run);
}
