#include "apps/options.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "import/image_file.h"
#include "import/load_scene.h"
#include "import/text_lines.h"
#include "scene/built_in.h"

#include <charconv>
#include <cmath>

namespace chiaro {
namespace {

// The whole number that all of `text` is, if it is one.
template <typename T>
std::optional<T> parse_whole(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

PictureSize parse_size(const std::string& text) {
    constexpr int kMost = kMaxImageSide;
    const auto x = text.find('x');
    if (x != std::string::npos) {
        const auto width = parse_whole<int>(std::string_view(text).substr(0, x));
        const auto height = parse_whole<int>(std::string_view(text).substr(x + 1));
        if (width && height && *width > 0 && *height > 0 && *width <= kMost && *height <= kMost &&
            std::uint64_t(*width) * *height <= kMaxPicturePixels)
            return {*width, *height};
    }
    throw Error("--size", "'" + text + "' is no picture size",
                "give width x height of 2^25 pixels at most, as 800x600");
}

glm::dvec3 parse_vector(const std::string& option, const std::string& text) {
    glm::dvec3 v(0);
    std::string_view rest = text;
    for (int i = 0; i < 3; ++i) {
        const auto comma = i < 2 ? rest.find(',') : rest.size();
        const auto number =
            comma == std::string_view::npos ? std::nullopt : parse_number(rest.substr(0, comma));
        if (!number || !std::isfinite(*number))
            throw Error(option, "'" + text + "' is not three numbers", "give x,y,z, as 0,1.6,4");
        v[i] = *number;
        rest = rest.substr(std::min(comma + 1, rest.size()));
    }
    return v;
}

Rgb parse_sky(const std::string& text) {
    const glm::dvec3 sky = parse_vector("--sky", text);
    if (glm::any(glm::lessThan(sky, glm::dvec3(0))))
        throw Error("--sky", "'" + text + "' has a channel below 0");
    if (glm::any(glm::greaterThan(sky, glm::dvec3(kBrightest))))
        throw Error("--sky", "'" + text + "' is brighter than 1e15 cd/m2");
    return Rgb(sky);
}

Scheme parse_scheme(const std::string& text) {
    if (text == "best") return Scheme::best;
    if (text == "paper") return Scheme::paper;
    throw Error("--scheme", "there is no scheme '" + text + "'", "choose best or paper");
}

Aov parse_aov(const std::string& text) {
    if (text == "radiance") return Aov::radiance;
    if (text == "irradiance") return Aov::irradiance;
    throw Error("--aov", "there is no '" + text + "'", "choose radiance or irradiance");
}

RendererName parse_renderer(const std::string& text, RendererName otherwise) {
    if (text.empty()) return otherwise;
    if (text == "path") return RendererName::path;
    if (text == "gather") return RendererName::gather;
    if (text == "caustic") return RendererName::caustic;
    if (text == "bidirectional") return RendererName::bidirectional;
    throw Error("--renderer", "there is no renderer '" + text + "'",
                "choose gather, path, bidirectional or caustic");
}

void check_only_path(const Options& options) {
    if (parse_renderer(options.renderer, RendererName::path) != RendererName::path)
        throw Error("--renderer", "this command has path alone", "use path");
}

void check_time(const Options& options) {
    if (options.time && !(*options.time >= 0 && std::isfinite(*options.time)))
        throw Error("--time", "it must be a number of seconds, 0 or more");
}

std::uint32_t sample_count(const char* option, std::optional<int> value, std::uint32_t otherwise) {
    if (!value) return otherwise;
    if (*value < 1 || *value > 1 << 24)
        throw Error(option, std::to_string(*value) + " is no number of samples",
                    "give 1 to 16777216");
    // Replicates of the sequence are of equal length.
    return (static_cast<std::uint32_t>(*value) + kReplicates - 1) / kReplicates * kReplicates;
}

float curve_tolerance(const Options& options) {
    if (!(options.curve_error >= 1e-6f && options.curve_error <= 0.1f))
        throw Error("--curve-error", "it must lie between 0.000001 and 0.1");
    return options.curve_error;
}

int thread_count(const Options& options) {
    if (options.threads < 0 || options.threads > 1024)
        throw Error("--threads", std::to_string(options.threads) + " is no number of threads",
                    "give 1 to 1024, or 0 for all");
    return options.threads > 0 ? options.threads : hardware_threads();
}

CLI::Validator whole_number() {
    return {[](std::string& text) {
                return parse_whole<std::uint64_t>(text) ? std::string()
                                                        : "'" + text + "' is no such number";
            },
            ""};
}

void add_scene_options(CLI::App& command, Options& o) {
    std::string kinds = "a .gltf, .glb, .obj or .bpt file";
    for (const std::string& name : built_in_names()) kinds += ", builtin:" + name;
    command.add_option("SCENE", o.scene, kinds)->required();
    command.add_option("--up", o.up, "the vertical of a file that is not y-up, as 0,0,1");
    command.add_option("--scale", o.scale, "multiplies all lengths of the scene");
    command.add_flag("--subdivide", o.subdivide,
                     "take polygons as cages of Catmull-Clark surfaces");
    command.add_option("--curve-error", o.curve_error,
                       "how far curved surfaces may be off, as light meets them, in parts of "
                       "their object's size (default: 0.00025)");
    command.add_option("--environment", o.environment,
                       "light from all around: an equirectangular .hdr or .exr picture in cd/m2");
    command.add_option("--sky", o.sky, "the same light from everywhere, as 1,1,1 [cd/m2]");
    command.add_option("--edits", o.edits,
                       "a script of edits (JSON), all of which are made at the start");
}

void add_view_options(CLI::App& command, Options& o) {
    command.add_option("--size", o.size, "picture size in pixels")->capture_default_str();
    command.add_option("--camera", o.camera, "a camera of the scene, by name or by number from 0");
    command.add_option("--eye", o.eye, "look from here, x,y,z");
    command.add_option("--target", o.target, "look toward here, x,y,z");
    command.add_option("--vfov", o.vertical_fov, "vertical field of view in degrees");
    command.add_option("--exposure", o.exposure,
                       "for .png: radiance is multiplied by 2^EV (default: by the median)");
}

void add_render_options(CLI::App& command, Options& o) {
    command.add_option(
        "--renderer", o.renderer,
        "sample renderer: gather, path, bidirectional or caustic (default: gather; with --scheme "
        "paper, path)");
    command.add_option("--threads", o.threads, "threads to use (default: all)");
    command.add_option("--seed", o.seed, "of all random numbers")
        ->capture_default_str()
        ->check(whole_number());
}

}  // namespace chiaro
