// What levels coarser than the mesh cost at load: seconds and bytes of making the graphs of all
// meshes, beside Embree's own build for the same scene, by the number of triangles. Prints JSON.
//
// The two take turns, and so do numbers of threads, so that other programs disturb all alike. Bytes
// of the graphs are those of their arrays, Embree's by how much more of the program is in memory.

#include "figures.h"
#include "furnished_box.h"
#include "rays/ray_caster.h"
#include "run_program.h"
#include "scene/bisect_edges.h"
#include "scene/built_in.h"
#include "scene/shapes.h"
#include "shading_cache/mesh_graph.h"
#include "spread.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>

namespace chiaro {
namespace {

struct Settings {
    std::vector<int> triangles = {10'000,  30'000,    100'000,   300'000,
                                  500'000, 1'000'000, 2'000'000, 5'000'000};
    std::vector<std::string> scenes = {"ring", "furnished", "room"};
    std::vector<int> threads = {1, 2};
    int repetitions = 5;
};

// The inside of a bumpy ring: one curved mesh with smooth normals, closed.
Scene make_ring(int triangles) {
    const auto wall = [](float u, float v) {
        // The seams' two sides are the same points to the last bit.
        const float round = 2 * kPi * (u - std::floor(u)), across = 2 * kPi * (v - std::floor(v));
        const float radius = 1 + 0.06f * std::sin(23 * round) * std::sin(7 * across);
        const float from_axis = 4 + radius * std::cos(across);
        return Vec3(from_axis * std::cos(round), radius * std::sin(across),
                    from_axis * std::sin(round));
    };
    const int rows = std::max(3, static_cast<int>(std::sqrt(static_cast<float>(triangles) / 8)));
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(sheet(4 * rows, rows, wall));
    scene.objects.push_back({.mesh = MeshId{0}});
    return scene;
}

// The built-in room with its edges halved until there are about as many triangles.
Scene make_dense_room(int triangles) {
    const Scene plain = make_room();
    Scene scene = plain;
    float longest = bounds(plain).diagonal() / 20;
    for (int attempt = 0; attempt < 4; ++attempt) {
        scene = plain;
        bisect_edges(scene, longest);
        const auto ratio =
            static_cast<float>(triangle_count(scene)) / static_cast<float>(triangles);
        if (std::abs(ratio - 1) < 0.1f) break;
        longest *= std::sqrt(ratio);
    }
    return scene;
}

Scene make_scene(const std::string& name, int triangles) {
    if (name == "ring") return make_ring(triangles);
    if (name == "furnished") return make_furnished_box(triangles / 2);
    return make_dense_room(triangles);
}

// Repetitions of one step of loading.
struct Step {
    std::vector<double> seconds, processor_seconds, bytes;

    // Calls `make`, which returns what is loaded, and `bytes_of` with that.
    void repeat(const auto& make, const auto& bytes_of) {
        const double before = chiaro::processor_seconds();
        const Stopwatch watch;
        const auto made = make();
        seconds.push_back(watch.seconds());
        processor_seconds.push_back(chiaro::processor_seconds() - before);
        bytes.push_back(static_cast<double>(bytes_of(made)));
    }
    nlohmann::ordered_json json() const {
        return {{"seconds", spread_of(seconds)},
                {"processor_seconds", spread_of(processor_seconds)},
                {"bytes", spread_of(bytes)}};
    }
};

void build_embree(const Scene& scene, int threads, Step& step) {
    const std::size_t before = resident_bytes();
    step.repeat([&] { return RayCaster(scene, threads); },
                [&](const RayCaster&) { return std::max(before, resident_bytes()) - before; });
}

void make_graphs(const Scene& scene, CoarserLevels levels, int threads, Step& step) {
    step.repeat([&] { return MeshGraphs(scene, levels, threads); },
                [](const MeshGraphs& graphs) { return graphs.bytes(); });
}

struct Steps {
    Step embree, graphs, mesh_vertices;
};

nlohmann::ordered_json measure(const std::string& name, int triangles, const Settings& settings) {
    const Scene scene = make_scene(name, triangles);
    std::vector<Steps> of_threads(settings.threads.size());
    for (int repetition = 0; repetition < settings.repetitions; ++repetition)
        for (std::size_t i = 0; i < of_threads.size(); ++i) {
            const int threads = settings.threads[i];
            build_embree(scene, threads, of_threads[i].embree);
            make_graphs(scene, CoarserLevels::up_to_a_tenth, threads, of_threads[i].graphs);
            make_graphs(scene, CoarserLevels::none, threads, of_threads[i].mesh_vertices);
        }
    nlohmann::ordered_json rows = nlohmann::json::array();
    for (std::size_t i = 0; i < of_threads.size(); ++i)
        rows.push_back({{"scene", name},
                        {"meshes", scene.meshes.size()},
                        {"triangles", triangle_count(scene)},
                        {"threads", settings.threads[i]},
                        {"embree", of_threads[i].embree.json()},
                        {"graphs", of_threads[i].graphs.json()},
                        {"graphs_without_levels", of_threads[i].mesh_vertices.json()}});
    return rows;
}

}  // namespace

int run(int argc, char** argv) {
    Settings settings;
    CLI::App app("Seconds and bytes of loading a scene's meshes, beside Embree's own.");
    app.add_option("--triangles", settings.triangles, "about how many")
        ->delimiter(',')
        ->check(CLI::PositiveNumber);
    app.add_option("--scenes", settings.scenes,
                   "ring (one smooth mesh), furnished (60 flat-shaded ones), room (built-in, edges "
                   "halved)")
        ->delimiter(',')
        ->check(CLI::IsMember({"ring", "furnished", "room"}));
    app.add_option("--threads", settings.threads, "numbers of them")
        ->delimiter(',')
        ->check(CLI::PositiveNumber);
    app.add_option("--repetitions", settings.repetitions, "whose median counts")
        ->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);

    // What the libraries make once is not counted.
    const Scene small = make_cornell_box();
    RayCaster(small, settings.threads.back());
    nlohmann::ordered_json rows = nlohmann::json::array();
    for (const std::string& name : settings.scenes)
        for (const int triangles : settings.triangles)
            for (auto& row : measure(name, triangles, settings)) {
                const auto seconds = [&](const char* step) {
                    return row[step]["seconds"]["median"].get<double>();
                };
                fmt::print(stderr, "{:9} {:8} triangles, {} threads: {:.3f} s, Embree {:.3f} s\n",
                           name, row["triangles"].get<std::size_t>(), row["threads"].get<int>(),
                           seconds("graphs"), seconds("embree"));
                rows.push_back(std::move(row));
            }
    nlohmann::ordered_json result;
    result["repetitions"] = settings.repetitions;
    result["rows"] = rows;
    std::printf("%s\n", result.dump(1).c_str());
    return 0;
}

}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run);
}
