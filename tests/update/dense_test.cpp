// Dense meshes are shaded coarser than they are made: in no time at first, and soon nobody sees it.
#include "scene/bisect_edges.h"
#include "shading_cache/interpolate.h"
#include "update/studio.h"

#include <algorithm>

namespace chiaro {
namespace {

using namespace tiny;

// A room of 4 x 4 x 3 m with a lamp of a square metre, and a look across it.
Scene room() {
    Scene scene;
    add_room(scene, Vec3(0), {4, 4, 3}, add_material(scene, Rgb(0.6f)));
    add_quad(scene, {1.5f, 1.5f, 2.9f}, {0, 1, 0}, {1, 0, 0},
             add_material(scene, Rgb(0), Rgb(100)));
    return scene;
}
View from_a_corner() {
    return {
        {.eye = {0.3f, 0.4f, 1.6f}, .target = {3, 2.8f, 0.9f}, .up = {0, 0, 1}, .vertical_fov = 70},
        160,
        120};
}

Scene dense(Scene scene, float longest) {
    bisect_edges(scene, longest);
    return scene;
}

// A place that a picture shows.
struct Spot {
    SurfacePoint where;
    bool front;
    Vec3 position;
    Vec3 normal;  // of the side that is seen
    double lux;   // as the cache shows it
};

Spot spot_at(const Studio& studio, const Fragment& fragment) {
    const ShadingCache& cache = studio.cycle.cache();
    const std::uint32_t side = cache.surface_side(fragment.patch);
    const Vec2 uv = cache.surface_uv(fragment.patch, fragment.local);
    Spot spot;
    spot.where = {ObjectId{0}, side / 2, uv.x, uv.y};
    const auto count = [&](ObjectId object) {
        return studio.scene.mesh_of(studio.scene.objects[index_of(object)]).primitives.size();
    };
    while (spot.where.primitive >= count(spot.where.object)) {
        spot.where.primitive -= static_cast<std::uint32_t>(count(spot.where.object));
        spot.where.object = static_cast<ObjectId>(index_of(spot.where.object) + 1);
    }
    spot.front = side % 2 == 0;
    const auto geometry = surface_geometry(studio.scene, spot.where);
    spot.position = geometry.position;
    spot.normal = spot.front ? geometry.geometric_normal : -geometry.geometric_normal;
    spot.lux = luminance(irradiance_at(cache, fragment.patch, fragment.local));
    return spot;
}

// One in so many of the places that the picture shows.
std::vector<Spot> spots(const Studio& studio, std::size_t one_in) {
    std::vector<Spot> found;
    const auto& fragments = studio.cycle.id_map().fragments;
    for (std::size_t i = 0; i < fragments.size(); i += one_in)
        found.push_back(spot_at(studio, fragments[i]));
    return found;
}
std::vector<Spot> spots_on(const Studio& studio, ObjectId object) {
    auto found = spots(studio, 1);
    std::erase_if(found, [&](const Spot& s) { return s.where.object != object; });
    return found;
}

// Light at spots by traced paths.
std::vector<double> traced_lux(const Studio& studio, const std::vector<Spot>& spots,
                               std::uint32_t samples) {
    std::vector<ShadeRequest> requests;
    for (const Spot& spot : spots)
        requests.push_back({.where = spot.where,
                            .front = spot.front,
                            .light = Light::total,
                            .seed = static_cast<std::uint32_t>(requests.size()),
                            .samples = samples,
                            .indirect_samples = samples});
    std::vector<ShadeResult> results(requests.size());
    PathRenderer path(studio.scene, studio.rays, studio.area_lights, nullptr, 2);
    path.shade(requests, results);
    std::vector<double> lux;
    for (const ShadeResult& result : results) lux.push_back(luminance(result.mean));
    return lux;
}

// Mean |error| over the mean, at spots whose light is known.
double relative_error(const std::vector<Spot>& spots, const std::vector<double>& lux) {
    double error = 0, sum = 0;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        error += std::abs(spots[i].lux - lux[i]);
        sum += lux[i];
    }
    return error / sum;
}

// Seconds of the samples that were spent, by the assumed costs.
double seconds_spent(const Studio& studio) {
    const SampleCosts costs = studio.renderer->typical_costs();
    const auto& samples = studio.cycle.statistics().samples;
    return double(samples[0]) * costs.direct + double(samples[1]) * costs.indirect;
}

// Nearly one vertex to a pixel is in view. A first picture of fixed size may take 0.15 s, a tenth
// more for what is found buried; the mesh's own vertices would take more than three times that.
TEST(Dense, TheFirstPictureKeepsToItsBudget) {
    double seconds[2] = {}, points[2] = {};
    for (const bool coarser : {false, true}) {
        Studio studio(dense(room(), 0.1f), fixed_size(Scheme::best), Truth::path,
                      coarser ? CoarserLevels::up_to_a_tenth : CoarserLevels::none);
        studio.cycle.look_from(from_a_corner());
        studio.run(1);
        seconds[coarser] = seconds_spent(studio);
        points[coarser] = double(studio.points());
        for (const Spot& spot : spots(studio, 1)) ASSERT_GT(spot.lux, 0);
        if (!coarser) continue;
        // It is the truth, not just light: within its noise and that of 256 paths, 4 % together.
        const auto some = spots(studio, 29);
        EXPECT_LT(relative_error(some, traced_lux(studio, some, 256)), 0.06);
    }
    EXPECT_LT(seconds[1], 1.1 * 0.15);
    EXPECT_GT(seconds[0], 3 * 0.15);
    EXPECT_LT(4 * points[1], points[0]);
    RecordProperty("seconds", std::to_string(seconds[1]) + " " + std::to_string(seconds[0]));
    RecordProperty("points", std::to_string(points[1]) + " " + std::to_string(points[0]));
}

// Eight cycles on, a room of 25 000 triangles looks as the same one of 7 quads.
TEST(Dense, ComesToThePictureOfThePlainScene) {
    Image pictures[2];
    for (const bool bisected : {false, true}) {
        Studio studio(bisected ? dense(room(), 0.15f) : room(), fixed_size(Scheme::best),
                      Truth::gather);
        studio.cycle.look_from(from_a_corner());
        studio.run(8);
        pictures[bisected] = studio.cycle.picture();
    }
    const double mean = luminance(mean_of(pictures[0]));
    EXPECT_NEAR(luminance(mean_of(pictures[1])) / mean, 1, 0.005);
    double squares = 0;
    for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i) {
        const double error =
            luminance(pictures[0].pixels[i]) - double(luminance(pictures[1].pixels[i]));
        squares += error * error / double(pictures[0].pixels.size());
    }
    RecordProperty("rmse", std::to_string(std::sqrt(squares) / mean));
    EXPECT_LT(std::sqrt(squares) / mean, 0.02);
}

TEST(Dense, TheSameBitsOnAnyNumberOfThreads) {
    Image pictures[2];
    for (const int threads : {1, 2}) {
        UpdateSettings settings = fixed_size(Scheme::best, Aov::radiance);
        settings.threads = threads;
        Studio studio(dense(room(), 0.1f), settings);
        studio.cycle.look_from(from_a_corner());
        studio.run(3);
        pictures[threads - 1] = studio.cycle.picture();
    }
    EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
}

// Window blinds: slats of 5 cm x 2 m, nearly all in the dark. The sun falls through two slits of
// 3 cm, far less than a coarsest cell of 50 cm, so that most coarse vertices agree on darkness. All
// is black: light is 1000 lux x cosine or none.
struct Blinds {
    Scene scene;
    ObjectId slats;

    Blinds() {
        const MaterialId black = add_material(scene, Rgb(0));
        add_quad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 0, 4}, black);
        Mesh slat;
        for (int i = 0; i < 12; ++i) {
            const float z = 0.05f * float(i);
            add_to(slat, {-1, -0.14f, z}, {2, 0, 0}, {0, 0.04f, 0.03f}, black);
        }
        Mesh board;
        for (int i = 0; i < 3; ++i)
            add_to(board, {-1.515f + float(i), -0.6f, -1}, {0.97f, 0, 0}, {0, 0, 3}, black);
        Scene fine;
        fine.materials = scene.materials;
        add_object(fine, std::move(slat));
        bisect_edges(fine, 0.01f);
        slats = add_object(scene, std::move(fine.meshes[0]));
        add_object(scene, std::move(board));
        scene.lights.push_back(sun({0, 1, -0.4f}, Rgb(1000)));
    }
    static void add_to(Mesh& mesh, Vec3 corner, Vec3 u, Vec3 v, MaterialId material) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3 p : {corner, corner + u, corner + u + v, corner + v})
            mesh.positions.push_back(p);
        mesh.primitives.push_back(quad(first, first + 1, first + 2, first + 3, material));
    }
};

// What is lit is found sooner than by evaluating vertices at random, which leaves 0.19.
TEST(Dense, WindowBlindsInTheDarkAreFoundToBeLit) {
    const Blinds blinds;
    Studio studio(blinds.scene, fixed_size(Scheme::best));
    studio.cycle.look_from(
        {{.eye = {0, -0.55f, 0.8f}, .target = {0, 0, 0.3f}, .up = {0, 0, 1}, .vertical_fov = 60},
         320,
         240});
    const auto error = [&] {
        const auto seen = spots_on(studio, blinds.slats);
        return relative_error(seen, traced_lux(studio, seen, 4));
    };
    studio.run(1);
    const double first = error();
    studio.run(9);
    const double tenth = error();
    RecordProperty("errors", std::to_string(first) + " " + std::to_string(tenth));
    EXPECT_GT(first, 0.3);
    EXPECT_LT(tenth, 0.17);
}

// A table top 25 mm thick and a leg of 5 x 5 cm that stands on air beside it, in a black world with
// a lamp of 100 cd: light is known everywhere, and where a face is turned away it is none. Coarsest
// cells are 57 cm.
void expect_thin_things_lit(bool from_above) {
    Scene scene;
    const MaterialId black = add_material(scene, Rgb(0));
    const ObjectId top = add_box(scene, {-0.5f, -0.3f, 0.7f}, {0.5f, 0.3f, 0.725f}, black);
    const ObjectId leg = add_box(scene, {0.55f, -0.25f, 0.75f}, {0.6f, -0.2f, 1.2f}, black);
    bisect_edges(scene, 0.012f);
    add_quad(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, black);
    const Vec3 lamp(-1.3f, -0.9f, 1.5f);
    scene.lights.push_back(point_light(lamp, Rgb(100)));
    Studio studio(std::move(scene), fixed_size(Scheme::best));
    studio.cycle.look_from({{.eye = {-0.3f, -0.7f, from_above ? 1.3f : 0.05f},
                             .target = {-0.1f, 0, 0.7f},
                             .up = {0, 0, 1},
                             .vertical_fov = 65},
                            160,
                            120});
    for (const int cycles : {1, 19}) {
        studio.run(cycles);
        int turned_away = 0, lit = 0, off = 0;  // by more than 5 %
        double worst = 0, sum = 0;
        for (const ObjectId object : {top, leg})
            for (const Spot& spot : spots_on(studio, object)) {
                const Vec3 to_lamp = lamp - spot.position;
                const double cosine = glm::dot(glm::normalize(to_lamp), spot.normal);
                if (cosine < 0) {
                    EXPECT_EQ(spot.lux, 0);
                    ++turned_away;
                } else {
                    const double lux = 100 * cosine / glm::dot(to_lamp, to_lamp);
                    const double error = std::abs(spot.lux / lux - 1);
                    worst = std::max(worst, error);
                    off += error > 0.05 ? 1 : 0;
                    sum += error;
                    ++lit;
                }
            }
        EXPECT_GT(from_above ? lit : turned_away, 3000);
        EXPECT_GT(lit, 100);
        // At first, what is hidden is sampled beside its place, where light falls off steeply.
        EXPECT_LT(sum / lit, cycles == 1 ? 0.02 : 0.005);
        EXPECT_LT(worst, cycles == 1 ? 0.5 : 0.05);
        EXPECT_LT(off, cycles == 1 ? lit / 20 : 1);
    }
}
TEST(Dense, ThinThingsAreLitOnTopOnly) {
    expect_thin_things_lit(true);
}
TEST(Dense, ThinThingsAreDarkBelow) {
    expect_thin_things_lit(false);
}

// Boxes stand on every other vertex of the coarsest level of a floor. What these know is nothing;
// the next level is asked instead.
TEST(Dense, BuriedVerticesLeaveNoBlackPlaces) {
    Scene scene = dense(room(), 0.1f);
    const MeshGraphs graphs(scene, CoarserLevels::up_to_a_tenth, 1);
    const MeshGraph& graph = graphs.of(MeshId{0});
    const MaterialId grey = add_material(scene, Rgb(0.4f));
    int coarsest = 0;
    for (std::uint32_t v = 0; v < graph.vertex_count(); ++v) {
        if (!graph.parents_of(MeshVertexId{v}).empty()) continue;
        const Mesh& mesh = scene.meshes[0];
        const MeshCorner at = corner_at(mesh, graph.corner_of_vertex[v]);
        const Vec3 p = mesh.positions[mesh.primitives[at.primitive].corners[at.corner]];
        if (p.z > 0 || std::min({p.x, p.y, 4 - p.x, 4 - p.y}) < 0.15f) continue;
        if (++coarsest % 2 == 0)
            add_box(scene, p - Vec3(0.1f, 0.1f, 0.02f), p + Vec3(0.1f, 0.1f, 0.12f), grey);
    }
    EXPECT_GT(coarsest, 20);
    Studio studio(std::move(scene), fixed_size(Scheme::best));
    studio.cycle.look_from(
        {{.eye = {0.3f, 0.4f, 2.6f}, .target = {2, 2, 0}, .up = {0, 0, 1}, .vertical_fov = 70},
         160,
         120});
    for (const int cycles : {1, 4}) {
        studio.run(cycles);
        // Specks may wait for their turn.
        const auto all = spots(studio, 1);
        const auto black = std::ranges::count_if(all, [](const Spot& s) { return !(s.lux > 0); });
        EXPECT_LE(black, cycles == 1 ? static_cast<std::ptrdiff_t>(all.size() / 500) : 0);
        auto on_floor = spots(studio, 31);
        std::erase_if(on_floor, [](const Spot& s) {
            return s.where.object != ObjectId{0} || s.position.z > 1e-3f;
        });
        const auto lux = traced_lux(studio, on_floor, 256);
        double mean = 0;
        for (const double y : lux) mean += y / double(lux.size());
        int dark = 0;
        for (std::size_t i = 0; i < lux.size(); ++i) dark += on_floor[i].lux < 0.6 * lux[i] ? 1 : 0;
        EXPECT_EQ(dark, 0) << "of " << lux.size();
        EXPECT_LT(relative_error(on_floor, lux), 0.07);
    }
}

// The floor of a lit room goes on outside, where there is next to no light. Vertices there that
// speak for the floor inside are not buried, but nobody sees them. (Where they are asked, 26 places
// are dark.)
TEST(Dense, WhatIsHiddenDarkensNothingThatIsSeen) {
    Scene scene;
    const MaterialId grey = add_material(scene, Rgb(0.5f));
    add_quad(scene, Vec3(0), {24, 0, 0}, {0, 24, 0}, grey);
    bisect_edges(scene, 0.15f);
    for (const float x : {8.3f, 15.6f}) {
        add_box(scene, {x, 8.3f, -0.1f}, {x + 0.1f, 15.7f, 3}, grey);
        add_box(scene, {8.3f, x, -0.1f}, {15.7f, x + 0.1f, 3}, grey);
    }
    add_box(scene, {8.3f, 8.3f, 3}, {15.7f, 15.7f, 3.1f}, grey);
    add_quad(scene, {11, 11, 2.9f}, {0, 2, 0}, {2, 0, 0}, add_material(scene, Rgb(0), Rgb(50)));
    scene.environment.sky = Rgb(0.05f);
    Studio studio(std::move(scene), fixed_size(Scheme::best));
    studio.cycle.look_from(
        {{.eye = {8.7f, 8.7f, 2.2f}, .target = {12, 12, 0}, .up = {0, 0, 1}, .vertical_fov = 70},
         160,
         120});
    studio.run(1);
    auto on_floor = spots(studio, 7);
    std::erase_if(on_floor, [](const Spot& s) { return s.where.object != ObjectId{0}; });
    ASSERT_GT(on_floor.size(), 500u);
    const auto lux = traced_lux(studio, on_floor, 256);
    int dark = 0;
    for (std::size_t i = 0; i < lux.size(); ++i) dark += on_floor[i].lux < 0.8 * lux[i] ? 1 : 0;
    EXPECT_EQ(dark, 0) << "of " << lux.size();
    RecordProperty("error", std::to_string(relative_error(on_floor, lux)));
    EXPECT_LT(relative_error(on_floor, lux), 0.035);
}

}  // namespace
}  // namespace chiaro
