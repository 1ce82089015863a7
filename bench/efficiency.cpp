// Efficiency, 1 / (mean squared error x time), of sample renderers at places of a scene: what one
// evaluation of indirect light costs and what it is worth. Prints JSON.
//
// usage: efficiency SCENE RENDERER[,RENDERER...] [--light indirect|direct|total]
//   [--samples N] [--eye ... as chiaro render]
//
// Places are what rays through a grid of the picture's pixels meet. Errors are relative to the
// truth there, two halves of many traced paths (or of --truth, a renderer's name) whose own noise
// cancels in the product. Time is the processor's, of all threads, making the renderer included,
// and with `gather` the filling of its cells: each run starts without any, or with those that
// --before N samples a place leave. --truth-file F keeps the truth for other runs of the same view.

#include "apps/open_scene.h"
#include "base/parallel.h"
#include "base/random.h"
#include "figures.h"
#include "run_program.h"
#include "scene/bsdf.h"
#include "scene/open_sides.h"
#include "update/make_renderer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>

namespace chiaro {
namespace {

constexpr std::uint32_t kFirstSamples = 64;
// Of all light together, samples are of the indirect part, beside a quarter as many of the direct.
constexpr std::uint32_t kIndirectADirect = 4;

struct Settings {
    std::vector<std::string> renderers;
    std::string truth = "path";
    std::string light = "indirect";
    std::string truth_file;
    std::uint32_t samples = 256;
    std::uint32_t before = 0;  // samples a place that are taken first and not counted
    std::uint32_t truth_samples = 1 << 13;
    int across = 24;
    int runs = 4;
};

struct Stage {
    Scene scene;
    RayCaster rays;
    AreaLights area_lights;
    int threads;

    Stage(Scene s, int n) : scene(std::move(s)), rays(scene, n), area_lights(scene), threads(n) {}
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    std::unique_ptr<SampleRenderer> renderer(const std::string& name, std::uint32_t seed) const {
        return make_renderer(parse_renderer(name, RendererName::path), scene, rays, area_lights,
                             nullptr, threads, seed);
    }
};

// One a pixel of a coarse grid, where something diffuse is seen.
std::vector<ShadeRequest> places(const Stage& stage, const View& view, const Settings& settings) {
    std::vector<ShadeRequest> requests;
    const int down = settings.across * view.height() / view.width();
    const float step = static_cast<float>(view.width()) / static_cast<float>(settings.across);
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < settings.across; ++x) {
            const Ray ray = view.ray((static_cast<float>(x) + 0.5f) * step,
                                     (static_cast<float>(y) + 0.5f) * step);
            Hit hit;
            stage.rays.intersect({&ray, 1}, {&hit, 1}, RayKind::camera);
            if (!hit || !has_diffuse(bsdf_at(stage.scene, hit.point, hit.front))) continue;
            ShadeRequest request;
            request.where = hit.point;
            request.front = hit.front;
            request.light = settings.light == "total"    ? Light::total
                            : settings.light == "direct" ? Light::direct
                                                         : Light::indirect;
            requests.push_back(request);
        }
    return requests;
}

// As the best scheme asks: few samples everywhere first, then as many again until all are taken.
std::vector<double> shade(SampleRenderer& renderer, std::vector<ShadeRequest> requests,
                          std::uint32_t samples, std::uint32_t seed) {
    std::vector<ShadeResult> results(requests.size());
    std::vector<double> lux(requests.size(), 0.0);
    for (std::uint32_t done = 0; done < samples;) {
        const std::uint32_t more = std::min(std::max(done, kFirstSamples), samples - done);
        for (std::uint32_t i = 0; i < requests.size(); ++i) {
            const bool both = requests[i].light == Light::total;
            requests[i].first_sample = both ? done / kIndirectADirect : done;
            requests[i].samples = both ? more / kIndirectADirect : more;
            requests[i].indirect_samples = more;
            requests[i].seed = hash32(seed, i);
        }
        renderer.shade(requests, results);
        for (std::size_t i = 0; i < lux.size(); ++i)
            lux[i] += double(luminance(results[i].mean)) * more / samples;
        done += more;
    }
    return lux;
}

// Two halves of the truth, from the file if it holds them; else made, and left there if it is
// named.
std::array<std::vector<double>, 2> truth_of(SampleRenderer& renderer,
                                            const std::vector<ShadeRequest>& requests,
                                            const Settings& settings) {
    std::array<std::vector<double>, 2> halves;
    if (std::ifstream file(settings.truth_file); file) {
        for (std::vector<double>& half : halves) half.resize(requests.size());
        for (std::size_t i = 0; i < requests.size(); ++i) file >> halves[0][i] >> halves[1][i];
        if (!file) throw Error(settings.truth_file, "is not the truth of this view");
        return halves;
    }
    for (std::uint32_t i = 0; i < 2; ++i)
        halves[i] = shade(renderer, requests, settings.truth_samples, 1 + i);
    if (settings.truth_file.empty()) return halves;
    std::ofstream file(settings.truth_file);
    for (std::size_t i = 0; i < requests.size(); ++i)
        file << fmt::format("{:.9g} {:.9g}\n", halves[0][i], halves[1][i]);
    return halves;
}

struct Figures {
    double error = 0;            // mean over places of the squared error over the truth's square
    double error_deviation = 0;  // standard error of that, by runs
    double bias = 0;             // mean error over mean truth
    double seconds = 0;
};

// Renderers have seeds of their own, so that they are independent witnesses.
Figures measure(const Stage& stage, const std::string& name,
                const std::vector<ShadeRequest>& requests,
                const std::array<std::vector<double>, 2>& halves, const Settings& settings) {
    Figures figures;
    double sum = 0, truth = 0, squares = 0;
    for (int run = 0; run < settings.runs; ++run) {
        std::uint32_t seed = hash32(1000 + static_cast<std::uint32_t>(run));
        for (const char c : name) seed = hash32(seed, static_cast<std::uint32_t>(c));
        double start = processor_seconds();
        const auto renderer = stage.renderer(name, seed);
        if (settings.before > 0) {
            shade(*renderer, requests, settings.before, hash32(seed));
            start = processor_seconds();
        }
        const std::vector<double> lux = shade(*renderer, requests, settings.samples, seed);
        figures.seconds += (processor_seconds() - start) / settings.runs;
        double error = 0;
        for (std::size_t i = 0; i < lux.size(); ++i) {
            const double mean = 0.5 * (halves[0][i] + halves[1][i]);
            if (!(mean > 0)) continue;
            error += (lux[i] - halves[0][i]) * (lux[i] - halves[1][i]) / (mean * mean) /
                     double(requests.size());
            sum += lux[i];
            truth += mean;
        }
        figures.error += error / settings.runs;
        squares += error * error / settings.runs;
    }
    figures.error_deviation = std::sqrt(std::max(squares - figures.error * figures.error, 0.0) /
                                        std::max(settings.runs - 1, 1));
    figures.bias = sum / truth - 1;
    return figures;
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> words(1);
    for (const char c : text) {
        if (c == ',')
            words.emplace_back();
        else
            words.back() += c;
    }
    return words;
}

}  // namespace

int run_efficiency(int argc, char** argv) {
    CLI::App app("efficiency of sample renderers");
    Options options;
    Settings settings;
    std::string renderers = "path,gather";
    add_scene_options(app, options);
    add_view_options(app, options);
    app.add_option("--renderers", renderers);
    app.add_option("--truth", settings.truth);
    app.add_option("--light", settings.light);
    app.add_option("--samples", settings.samples);
    app.add_option("--truth-samples", settings.truth_samples);
    app.add_option("--truth-file", settings.truth_file);
    app.add_option("--before", settings.before);
    app.add_option("--across", settings.across);
    app.add_option("--runs", settings.runs);
    app.add_option("--threads", options.threads);
    CLI11_PARSE(app, argc, argv);

    Stage stage(open_scene(options), thread_count(options));
    const PictureSize size = parse_size(options.size);
    const View view(choose_camera(stage.scene, options), size.width, size.height);
    const auto requests = places(stage, view, settings);
    const auto truth = stage.renderer(settings.truth, 0);
    const auto halves = truth_of(*truth, requests, settings);

    fmt::print("{{\"scene\": \"{}\", \"places\": {}, \"samples\": {}, \"renderers\": {{",
               options.scene, requests.size(), settings.samples);
    const char* comma = "";
    for (const std::string& name : split(renderers)) {
        const Figures f = measure(stage, name, requests, halves, settings);
        fmt::print(
            "{}\n  \"{}\": {{\"relative_mse\": {:.3e}, \"relative_mse_deviation\": {:.1e}, "
            "\"bias\": {:.4f}, \"seconds\": {:.4f}, "
            "\"efficiency\": {:.4g}}}",
            comma, name, f.error, f.error_deviation, f.bias, f.seconds, 1 / (f.error * f.seconds));
        comma = ",";
    }
    fmt::print("\n}}}}\n");
    return 0;
}

}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run_efficiency);
}
