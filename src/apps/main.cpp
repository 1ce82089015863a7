// The command line. The only place that catches errors and prints them.

#include "apps/commands.h"
#include "apps/output.h"
#include "base/error.h"
#include "import/fault.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <functional>
#include <new>

namespace chiaro {
namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

int comes_later(const std::string& command) {
    complain(command + " comes in a later version; chiaro render makes pictures now");
    return kFailed;
}

bool names_scene(const std::string& word) {
    const std::string ending = lower_extension(word);
    return word.starts_with("builtin:") || ending == ".gltf" || ending == ".glb" ||
           ending == ".obj";
}

// The command line has no command. A scene alone means to view it.
int without_command(const std::string& word) {
    if (word.empty()) {
        complain(
            "a command is required, as in chiaro render builtin:room -o room.png; "
            "chiaro --help lists them");
    } else if (names_scene(word)) {
        complain("view comes in a later version; chiaro render " + word +
                 " -o picture.png makes a picture now");
        return kFailed;
    } else {
        complain("there is no command or option '" + word + "'; chiaro --help lists what there is");
    }
    return kBadInput;
}

// What the parser found wrong, in our words.
std::string in_our_words(const CLI::ParseError& e) {
    const std::string what = e.what();
    const auto colon = what.find(": "), equals = what.find(" = ");
    const bool convert = dynamic_cast<const CLI::ConversionError*>(&e) != nullptr;
    if (convert && colon != std::string::npos && equals != std::string::npos)
        return what.substr(colon + 2, equals - colon - 2) + ": '" + what.substr(equals + 3) +
               "' is no such number";
    if (dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr && colon != std::string::npos)
        return "not expected here: " + what.substr(colon + 2);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&e) != nullptr && colon != std::string::npos)
        return what.substr(0, colon) + (what.find("At Most 1 ") == std::string::npos
                                            ? ": its value is missing"
                                            : ": is given more than once");
    return what;
}

using Run = std::function<int()>;

// Of commands that run the cache.
void add_scheme_options(CLI::App& command, Options& o) {
    command.add_option("--scheme", o.scheme, "best, or paper: as published in 2002")
        ->capture_default_str();
    command.add_option("--direct-samples", o.direct_samples,
                       "a vertex, in --scheme paper (default: 100)");
    command.add_option("--indirect-samples", o.indirect_samples,
                       "a vertex, in --scheme paper (default: 400)");
    command.add_option("--aov", o.aov, "radiance, or irradiance in lux")->capture_default_str();
    command.add_option("--stats", o.statistics, "write figures of the run as JSON");
}

void add_play_command(CLI::App& app, Options& o, Run& run) {
    CLI::App& play = *app.add_subcommand("play", "timed edits and animations, replayed");
    add_scene_options(play, o);
    play.add_option("-o,--output", o.output,
                    "folder for the pictures that the script asks for: frame_000.png, .exr, ...")
        ->required();
    play.add_option("--script", o.script, "edits (JSON), each made at its time");
    play.add_option("--animation", o.animation, "an animation of the scene, played by its name");
    add_view_options(play, o);
    add_render_options(play, o);
    play.add_flag("--fixed-cycles", o.fixed_cycles,
                  "cycles of a fixed size, each 0.05 s of the script: the same pictures on any "
                  "machine, not in real time");
    play.add_option(
            "--fade-in", o.fade_in,
            "cycles in which new light comes in by nine tenths, so that nothing pops; 0: at "
            "once")
        ->check(CLI::Range(0, 1000));
    add_scheme_options(play, o);
    play.footer(
        "Example:\n  chiaro play builtin:room --animation path --script edits.json -o frames");
    play.callback([&] { run = [&] { return play_command(o); }; });
}

void add_picture_commands(CLI::App& app, Options& o, Run& run) {
    CLI::App& render = *app.add_subcommand("render", "a converging picture from the Shading Cache");
    add_scene_options(render, o);
    render.add_option("-o,--output", o.output, "picture to write: .png tone-mapped, .exr linear")
        ->required();
    add_view_options(render, o);
    add_render_options(render, o);
    render.add_option("--time", o.time, "seconds of wall time after loading (default: 10)");
    render
        .add_option("--samples", o.samples,
                    "points to shade instead: the same picture on any number of threads")
        ->check(whole_number());
    add_scheme_options(render, o);
    render.footer(
        "Examples:\n  chiaro render builtin:room -o room.png --time 10\n"
        "  chiaro render kitchen.obj -o kitchen.exr --eye 7.6,-4.2,1.4 --target 12,4.7,0.1 --up "
        "0,0,1 --vfov 60");
    render.callback([&] { run = [&] { return render_command(o); }; });

    add_play_command(app, o, run);

    CLI::App& reference =
        *app.add_subcommand("reference", "the same picture by path tracing each pixel");
    add_scene_options(reference, o);
    reference
        .add_option("-o,--output", o.output, "picture to write: .exr linear, .png tone-mapped")
        ->required();
    add_view_options(reference, o);
    add_render_options(reference, o);
    reference.add_option("--spp", o.spp, "paths a pixel (default: 64)");
    reference.add_option("--time", o.time, "or seconds of wall time after loading");
    reference.footer("Example:\n  chiaro reference builtin:cornell -o truth.exr --spp 256");
    reference.callback([&] { run = [&] { return reference_command(o); }; });
}

void add_measuring_commands(CLI::App& app, Options& o, Run& run) {
    CLI::App& trace =
        *app.add_subcommand("trace", "light at points: lines `x y z nx ny nz` in, `r g b` out");
    add_scene_options(trace, o);
    add_render_options(trace, o);
    trace.add_flag("-I", o.irradiance,
                   "irradiance at points; without it, radiance along rays x y z dx dy dz");
    trace.add_flag("--lux", o.lux, "with -I: illuminance alone, one number a line");
    trace.add_option("--direct-samples", o.direct_samples, "a point (default: 100)");
    trace.add_option("--indirect-samples", o.indirect_samples,
                     "a point, or paths a ray (default: 400)");
    trace.footer("Example:\n  echo 2.78 0 2 0 1 0 | chiaro trace -I --lux builtin:cornell");
    trace.callback([&] { run = [&] { return trace_command(o); }; });

    CLI::App& diff = *app.add_subcommand("diff", "error of picture A against picture B, as JSON");
    diff.add_option("A", o.picture_a, "picture, .exr or .png")->required();
    diff.add_option("B", o.picture_b, "reference, .exr or .png")->required();
    diff.footer("Example:\n  chiaro diff room.exr truth.exr");
    diff.callback([&] { run = [&] { return diff_command(o); }; });

    CLI::App& info = *app.add_subcommand("info", "what a scene holds");
    add_scene_options(info, o);
    info.add_flag("--json", o.json, "as JSON");
    info.footer("Example:\n  chiaro info builtin:room --json");
    info.callback([&] { run = [&] { return info_command(o); }; });
}

void add_later_commands(CLI::App& app, Run& run) {
    for (const char* name : {"view", "compare", "worker"}) {
        CLI::App& later = *app.add_subcommand(name, "comes in a later version");
        later.allow_extras();
        later.callback([name, &run] { run = [name] { return comes_later(name); }; });
    }
}

int run_command_line(int argc, char** argv) {
    Options options;
    Run run;
    CLI::App app("Chiaro: lighting design with global illumination that follows your hand.");
    app.name("chiaro");
    app.set_version_flag("--version", std::string("chiaro ") + CHIARO_VERSION);
    app.require_subcommand(1);
    add_picture_commands(app, options, run);
    add_measuring_commands(app, options, run);
    add_later_commands(app, run);
    app.footer(
        "Example:\n  chiaro render builtin:room -o room.png\nchiaro COMMAND --help tells of a "
        "command's options.");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        const auto commands = app.get_subcommands();
        if (commands.empty()) return without_command(argc > 1 ? argv[1] : "");
        complain(in_our_words(e) + "; chiaro " + commands.front()->get_name() +
                 " --help lists what there is");
        return kBadInput;
    }
    const int status = run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw Error("standard output", "cannot be written: " + std::string(std::strerror(errno)));
    return status;
}

}  // namespace
}  // namespace chiaro

int main(int argc, char** argv) {
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
        std::fprintf(
            stderr, "chiaro: this processor lacks AVX2; any x86-64 made since about 2015 has it\n");
        return chiaro::kFailed;
    }
    try {
        return chiaro::run_command_line(argc, argv);
    } catch (const chiaro::Error& e) {
        chiaro::complain(e.what());
        return chiaro::kBadInput;
    } catch (const std::bad_alloc&) {
        chiaro::complain("not enough memory");
    } catch (const std::exception& e) {
        chiaro::complain(e.what());
    }
    return chiaro::kFailed;
}
