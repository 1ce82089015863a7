// chiaro trace: light at points or along rays, straight from the sample renderer, as Radiance's
// rtrace.

#include "apps/commands.h"
#include "apps/open_scene.h"
#include "base/error.h"
#include "base/random.h"
#include "sample_renderer/path_renderer.h"
#include "sample_renderer/radiance.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>

namespace chiaro {
namespace {

struct Line {
    Vec3 position;
    Vec3 direction;  // unit
};

// Six finite numbers, the last three no zero vector; nothing for a blank line.
std::optional<Line> parse_line(const std::string& text, std::size_t number) {
    const auto fault = [&](const char* what) {
        return Error("stdin:" + std::to_string(number), what,
                     "give lines of six numbers: x y z and a direction");
    };
    std::array<float, 6> values{};
    std::size_t count = 0;
    const char* next = text.data();
    const char* const end = next + text.size();
    for (;;) {
        while (next != end && (std::isspace(static_cast<unsigned char>(*next)) || *next == '+'))
            ++next;
        if (next == end) break;
        if (count == values.size()) throw fault("more than six numbers");
        const auto [after, error] = std::from_chars(next, end, values[count]);
        if (error != std::errc() || !std::isfinite(values[count])) throw fault("not a number");
        if (after != end && !std::isspace(static_cast<unsigned char>(*after)))
            throw fault("not a number");
        next = after;
        ++count;
    }
    if (count == 0) return std::nullopt;
    if (count < values.size()) throw fault("fewer than six numbers");
    const Vec3 direction(values[3], values[4], values[5]);
    if (!(glm::length(direction) > 0)) throw fault("a direction of no length");
    return Line{Vec3(values[0], values[1], values[2]), glm::normalize(direction)};
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

// Irradiance at the lines' places, or radiance along them; `first` is the first line's number.
std::vector<Rgb> measure(const LitScene& lit, const std::vector<Line>& lines, std::size_t first,
                         const Options& options) {
    const auto [direct, indirect, threads] = effort_of(options);
    std::vector<Rgb> values(lines.size());
    if (!options.irradiance) {
        std::vector<Ray> rays;
        for (const Line& line : lines)
            rays.push_back({line.position, line.direction, 0, kInfinity});
        const std::uint32_t seed =
            hash32(static_cast<std::uint32_t>(options.seed), static_cast<std::uint32_t>(first));
        radiance(lit, rays, {seed, 0, indirect, threads}, values);
        return values;
    }
    std::vector<MeterPlace> places;
    std::vector<ShadeRequest> requests(lines.size());
    std::vector<ShadeResult> results(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        places.push_back({lines[i].position, lines[i].direction});
        requests[i].light = Light::total;
        requests[i].seed =
            hash32(static_cast<std::uint32_t>(options.seed), static_cast<std::uint32_t>(first + i));
        requests[i].samples = direct;
        requests[i].indirect_samples = indirect;
    }
    shade_places(lit, places, requests, threads, results);
    for (std::size_t i = 0; i < lines.size(); ++i) values[i] = results[i].mean;
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
    constexpr std::size_t kLinesAtOnce = 1024;
    check_renderer(options.renderer);
    if (options.lux && !options.irradiance)
        throw Error("--lux", "radiance is not measured in lux", "add -I");
    const Effort effort = effort_of(options);
    const Scene scene = open_scene(options);
    const RayCaster rays(scene, effort.threads);
    const AreaLights area_lights(scene);
    const LitScene lit = make_lit_scene(scene, rays, area_lights);

    std::vector<Line> lines;
    std::string text;
    std::size_t number = 0, done = 0;
    const auto flush = [&] {
        print(measure(lit, lines, done, options), options.lux);
        done += lines.size();
        lines.clear();
    };
    while (std::getline(std::cin, text)) {
        if (const auto line = parse_line(text, ++number)) lines.push_back(*line);
        if (lines.size() == kLinesAtOnce) flush();
    }
    if (!lines.empty()) flush();
    return 0;
}

}  // namespace chiaro
