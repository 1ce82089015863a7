// What the command line says (the contract is in docs/command_line.md).
#pragma once

#include "rays/ray_caster.h"
#include "scene/camera.h"
#include "update/make_renderer.h"
#include "update/update_cycle.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace chiaro {

/// Options that commands share, as typed; read further by the functions below.
struct Options {
    std::string scene;
    std::string output;
    std::string size = "800x600";
    std::string camera;
    std::string eye, target, up;
    std::optional<float> vertical_fov;
    std::string renderer;  // empty: what suits the command and the scheme
    std::string scheme = "best";
    std::string aov = "radiance";
    std::optional<int> direct_samples, indirect_samples;
    int threads = 0;  // 0: as many as the machine has
    std::uint64_t seed = 1;
    std::string statistics;
    std::optional<float> exposure;
    float scale = 1;
    bool subdivide = false;
    float curve_error = kCurveTolerance;
    std::string environment, sky;
    std::string edits;
    std::string script, animation;  // play
    bool fixed_cycles = false;
    int fade_in = 0;  // frames

    std::optional<double> time;            // seconds after loading
    std::optional<std::uint64_t> samples;  // points shaded
    std::optional<int> spp;
    bool irradiance = false;  // trace -I
    bool lux = false;
    bool json = false;
    std::string picture_a, picture_b;
};

struct PictureSize {
    int width;
    int height;
};

/// Readers of single options. Each throws an Error that names the option, what is wrong with the
/// text, and what would be right.
PictureSize parse_size(const std::string& text);
glm::dvec3 parse_vector(const std::string& option, const std::string& text);
/// Radiance [cd/m2 a channel] of --sky.
Rgb parse_sky(const std::string& text);
Scheme parse_scheme(const std::string& text);
Aov parse_aov(const std::string& text);
/// `otherwise` where nothing was asked for.
RendererName parse_renderer(const std::string& text, RendererName otherwise);
/// For commands that only have `path`.
void check_only_path(const Options& options);
void check_time(const Options& options);
std::uint32_t sample_count(const char* option, std::optional<int> value, std::uint32_t otherwise);

/// How far bicubic patches may be from the truth, in parts of their object's size.
float curve_tolerance(const Options& options);

/// Threads to use: what was asked for, or all that the machine has.
int thread_count(const Options& options);

/// Refuses what is no whole number of 64 bits: CLI11 would take negative numbers round to large
/// ones, and larger ones down to the largest.
CLI::Validator whole_number();

void add_scene_options(CLI::App& command, Options& options);
void add_view_options(CLI::App& command, Options& options);
void add_render_options(CLI::App& command, Options& options);

}  // namespace chiaro
