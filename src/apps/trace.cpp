// chiaro trace: light at points or along rays, straight from the sample renderer, as Radiance's
// rtrace.

#include "apps/commands.h"
#include "apps/open_scene.h"
#include "base/error.h"
#include "base/random.h"
#include "import/directions.h"
#include "import/load_scene.h"
#include "import/text_lines.h"
#include "sample_renderer/radiance.h"
#include "update/make_renderer.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

namespace chiaro {
namespace {

constexpr std::size_t kLinesAtOnce = 1024;

struct Line {
    Vec3 position;
    Vec3 direction;  // unit
};

// The lines of standard input.
class InputLines {
public:
    // Without its end; nothing where the input ends.
    std::optional<std::string> next() {
        ++number_;
        std::size_t end = bytes_.find('\n', begin_);
        while (end == bytes_.npos && read_more()) end = bytes_.find('\n', begin_);
        if (begin_ == bytes_.size()) return std::nullopt;
        end = std::min(end, bytes_.size());
        std::string line = bytes_.substr(begin_, end - begin_);
        begin_ = std::min(end + 1, bytes_.size());
        return line;
    }

    // Whether who writes the lines may be waiting for us: nothing more has come.
    bool idle() const {
        if (bytes_.find('\n', begin_) != bytes_.npos) return false;
        pollfd input = {STDIN_FILENO, POLLIN, 0};
        return ::poll(&input, 1, 0) == 0;
    }

    std::string where() const { return "stdin:" + std::to_string(number_); }

private:
    bool read_more() {
        constexpr std::size_t kBlock = 1 << 16, kLongestLine = 1 << 20;
        bytes_.erase(0, begin_);
        begin_ = 0;
        const std::size_t kept = bytes_.size();
        if (kept > kLongestLine) throw Error(where(), "a line of more than 1 MiB");
        bytes_.resize(kept + kBlock);
        const ssize_t count = ::read(STDIN_FILENO, bytes_.data() + kept, kBlock);
        bytes_.resize(kept + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (count < 0) throw Error("stdin", "cannot be read: " + std::string(std::strerror(errno)));
        return count > 0;
    }

    std::string bytes_;
    std::size_t begin_ = 0;   // of what has not been given out
    std::size_t number_ = 0;  // of the last line given out, from 1
};

// Six finite numbers, the last three no zero vector; nothing for a blank line.
std::optional<Line> parse_line(std::string_view text, const std::string& where) {
    const auto fault = [&](const char* what) {
        return Error(where, what, "give lines of six numbers: x y z and a direction");
    };
    constexpr std::string_view kBlank = " \t\r\v\f";
    std::array<double, 6> values{};
    std::size_t count = 0;
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
        if (text.empty()) break;
        const std::string_view word = text.substr(0, text.find_first_of(kBlank));
        text.remove_prefix(word.size());
        if (count == values.size()) throw fault("more than six numbers");
        const std::optional<double> value = parse_number(word);
        if (!value || !std::isfinite(*value)) throw fault("not a number");
        values[count++] = *value;
    }
    if (count == 0) return std::nullopt;
    if (count < values.size()) throw fault("fewer than six numbers");
    const Line line = {Vec3(values[0], values[1], values[2]),
                       unit_or_zero({values[3], values[4], values[5]})};
    if (line.direction == Vec3(0)) throw fault("a direction of no length");
    if (!within_reach(line.position)) throw fault("a position with coordinates beyond 1e9");
    return line;
}

struct Effort {
    std::uint32_t direct, indirect;  // samples a line
    int threads;
};

Effort effort_of(const Options& options) {
    return {sample_count("--direct-samples", options.direct_samples, 100),
            sample_count("--indirect-samples", options.indirect_samples, 400),
            thread_count(options)};
}

// Radiance along the lines; `first` is the first one's number.
std::vector<Rgb> measure_radiance(const LitScene& lit, const std::vector<Line>& lines,
                                  std::size_t first, const Options& options) {
    // A ray's random numbers are named by its place in a block of lines: rays that are switched off
    // stand for the lines of the block that are answered already.
    const std::size_t before = first % kLinesAtOnce;
    std::vector<Ray> rays(before, {.t_max = -1});
    for (const Line& line : lines) rays.push_back({line.position, line.direction, 0, kInfinity});
    std::vector<Rgb> values(rays.size());
    const std::uint32_t seed =
        hash32(short_seed(options.seed), static_cast<std::uint32_t>(first - before));
    const Effort effort = effort_of(options);
    radiance(lit, rays, {seed, 0, effort.indirect, effort.threads}, values);
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(before));
    return values;
}

// Irradiance at the lines' places.
std::vector<Rgb> measure_irradiance(SampleRenderer& renderer, const std::vector<Line>& lines,
                                    std::size_t first, const Options& options) {
    const Effort effort = effort_of(options);
    std::vector<ShadeRequest> requests(lines.size());
    std::vector<ShadeResult> results(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        requests[i].place = {lines[i].position, lines[i].direction};
        requests[i].light = Light::total;
        requests[i].seed = hash32(short_seed(options.seed), static_cast<std::uint32_t>(first + i));
        requests[i].samples = effort.direct;
        requests[i].indirect_samples = effort.indirect;
    }
    // What `gather` knows grows from call to call, and when lines come must not show in the
    // answers.
    const std::size_t at_once = renderer.remembers() ? 1 : lines.size();
    for (std::size_t i = 0; i < lines.size(); i += at_once)
        renderer.shade(std::span(requests).subspan(i, at_once),
                       std::span(results).subspan(i, at_once));
    std::vector<Rgb> values;
    for (const ShadeResult& result : results) values.push_back(result.mean);
    return values;
}

void print(const std::vector<Rgb>& values, bool lux) {
    for (const Rgb& v : values) {
        if (lux)
            std::printf("%.9g\n", static_cast<double>(luminance(v)));
        else
            std::printf("%.9g %.9g %.9g\n", static_cast<double>(v.r), static_cast<double>(v.g),
                        static_cast<double>(v.b));
    }
    std::fflush(stdout);
}

}  // namespace

int trace_command(const Options& options) {
    if (!options.irradiance) check_only_path(options);
    const RendererName name = parse_renderer(options.renderer, RendererName::path);
    if (options.lux && !options.irradiance)
        throw Error("--lux", "radiance is not measured in lux", "add -I");
    const Effort effort = effort_of(options);
    Scene scene = open_scene(options);
    apply_edits(scene, options);
    const RayCaster rays(scene, effort.threads, curve_tolerance(options));
    const AreaLights area_lights(scene);
    const LitScene lit = make_lit_scene(scene, rays, area_lights);
    const auto renderer = make_renderer(name, scene, rays, area_lights, nullptr, effort.threads,
                                        short_seed(options.seed));

    std::vector<Line> lines;
    InputLines input;
    std::size_t done = 0;
    const auto flush = [&] {
        print(options.irradiance ? measure_irradiance(*renderer, lines, done, options)
                                 : measure_radiance(lit, lines, done, options),
              options.lux);
        done += lines.size();
        lines.clear();
    };
    while (const auto text = input.next()) {
        if (const auto line = parse_line(*text, input.where())) lines.push_back(*line);
        const bool full = (done + lines.size()) % kLinesAtOnce == 0;
        if (!lines.empty() && (full || input.idle())) flush();
    }
    if (!lines.empty()) flush();
    return 0;
}

}  // namespace chiaro
