// The weights of all the ways in which two walks can find one path sum to 1.
#include "sample_renderer/ball.h"
#include "sample_renderer/join.h"
#include "sample_renderer/meter.h"
#include "sample_renderer/walk.h"

#include <gtest/gtest.h>

namespace chiaro::tiny {
namespace {

// A path from the eye's end by the surfaces at `hits` to the one light of its scene.
struct FoundPath {
    std::vector<Hit> hits;
    std::vector<bool> deltas;  // by hit: it scatters the path as a delta
    std::optional<Hit> lamp;   // of an area light, a parallelogram
    std::optional<Vec3> sky;   // toward the environment,
    Vec2 sky_numbers = {};     // as these choose it at the last hit
};

// Leads walks along a path that is there already.
struct Guide {
    const LitScene& lit;
    Emitters emitters;

    explicit Guide(const LitScene& l) : lit(l), emitters(l) {}

    Vec3 place(const Hit& hit) const { return surface_position(lit.scene, hit.point); }

    PathVertex arrive_at(const Walk& walk, Hit hit) const {
        const Vec3 direction = walk.parallel ? walk.emission->ray.direction
                                             : glm::normalize(place(hit) - walk.position);
        hit.front = glm::dot(hit.normal, direction) < 0;
        return arrive(lit, walk, {walk.position, direction}, hit, describe(lit, hit));
    }

    // From a vertex to the next; nothing where its deltas lead elsewhere.
    std::optional<PathVertex> step(const PathVertex& v, bool delta, const Hit& next) const {
        const Vec3 to = glm::normalize(place(next) - v.place.position);
        const Toward there = toward(v, to);
        WalkStep taken = {.direction = to, .pdf = there.pdf, .pdf_back = there.pdf_back};
        Rng rng(1);
        for (int tries = 0; delta; ++tries) {
            const auto found = sample_step(v, rng.uniform(), {rng.uniform(), rng.uniform()});
            if (tries == 1000) return std::nullopt;
            if (!found || !found->delta || glm::distance(found->direction, to) > 1e-3f) continue;
            taken = *found;
            break;
        }
        if (!delta && !(there.pdf > 0 && max_component(there.carried) > 0)) return std::nullopt;
        return arrive_at({.throughput = Rgb(1),
                          .pdf = taken.pdf,
                          .trail = going_on(v.trail, taken.pdf_back, delta),
                          .position = v.place.position,
                          .normal = v.place.geometric_normal,
                          .transport = v.transport},
                         next);
    }

    // The first vertices of a walk from `start` by these hits, as far as it gets.
    std::vector<PathVertex> lead(const PathVertex& start, bool delta, std::span<const Hit> hits,
                                 const std::vector<bool>& deltas) const {
        std::vector<PathVertex> vertices = {start};
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const auto next = step(vertices.back(), delta, hits[i]);
            if (!next) break;
            vertices.push_back(*next);
            delta = deltas[i];
        }
        return vertices;
    }

    // The light, as next event estimation at a vertex finds it.
    std::optional<LightSample> sample(const Receiver& place, const FoundPath& path) const {
        const Vec2 spot = path.lamp ? Vec2(path.lamp->point.u, path.lamp->point.v) : Vec2(0);
        std::optional<LightSample> found;
        emitters.sample_each_kind(lit, place, {0.5f, spot, path.sky_numbers},
                                  [&](const LightSample& light) { found = light; });
        const bool elsewhere =
            path.sky && found && glm::distance(found->to_light, *path.sky) > 1e-4f;
        return elsewhere ? std::nullopt : found;
    }

    // What a walk from the light to the last hit begins with.
    Emission emission(const Receiver& place, const FoundPath& path) const {
        Emission e = {.start = 0, .normal = Vec3(0)};
        if (path.sky) {
            const MetLight met = emitters.met_sky(lit, lit_place(place), *path.sky);
            e.from = LightSource::sky;
            e.normal = e.ray.direction = -*path.sky;
            e.start = met.end.walk;
            e.direction = met.pdf_back;
            return e;
        }
        if (path.lamp) {
            e.from = LightSource::area;
            e.position = this->place(*path.lamp);
            const Vec3 w = glm::normalize(e.position - place.position);
            const MetLight met = emitters.met(lit, lit_place(place), w, *path.lamp);
            e.normal = path.lamp->normal;
            e.object = path.lamp->point.object;
            e.index = path.lamp->point.primitive;
            e.start = met.end.walk;
            e.direction = met.pdf_back;
            return e;
        }
        const PunctualLight& light = lit.scene.lights[0];
        e.from = light.kind == LightKind::directional ? LightSource::sun : LightSource::lamp;
        e.position = light.position;
        e.ray.direction = light.direction;
        const auto found = sample(place, path);
        if (!found) return e;
        const Vec3 between = light.position - place.position;
        e.start = found->start * Emitters::chosen(lit, place, e);
        e.direction = found->direction * (e.parallel() ? 1 : glm::dot(between, between));
        return e;
    }
};

using Weights = std::vector<float>;

// A walk from the eye, which has these vertices, meets the light.
void add_meeting(const Guide& guide, const PathVertex& last, const FoundPath& path, Weights& all) {
    if (!path.lamp && !path.sky) return;
    const Vec3 to =
        path.sky ? *path.sky : glm::normalize(guide.place(*path.lamp) - last.place.position);
    const bool same_side = glm::dot(last.place.geometric_normal, to) > 0;
    const LitPlace place = lit_place(same_side ? last.place : other_side(last.place));
    if (path.lamp) {
        if (const auto lamp = guide.step(last, path.deltas.back(), *path.lamp))
            all.push_back(weight_of_met_light(
                lamp->trail, guide.emitters.met(guide.lit, place, to, *path.lamp)));
        return;
    }
    const Toward there = toward(last, to);
    if (!(there.pdf > 0)) return;
    const Walk walk = {.pdf = there.pdf,
                       .trail = going_on(last.trail, there.pdf_back, false),
                       .normal = last.place.geometric_normal};
    all.push_back(
        weight_of_met_light(trail_at_sky(walk, to), guide.emitters.met_sky(guide.lit, place, to)));
}

// It is joined to a light sample.
void add_light_samples(const Guide& guide, const PathVertex& last, const FoundPath& path,
                       Weights& all) {
    if (path.deltas.back()) return;
    for (const Receiver& place : {last.place, other_side(last.place)})
        if (const auto light = guide.sample(place, path))
            if (const auto found = join(last, place, *light)) all.push_back(found->weight);
}

// It is joined to a walk from the light, which starts on either side of the last surface.
void add_walks(const Guide& guide, std::span<const PathVertex> eye, const FoundPath& path,
               Weights& all) {
    const std::size_t n = path.hits.size();
    const std::vector<Hit> hits(path.hits.rbegin(), path.hits.rend());
    const std::vector<bool> deltas(path.deltas.rbegin(), path.deltas.rend());
    for (const Receiver& place : {eye[n].place, other_side(eye[n].place)}) {
        const Emission emission = guide.emission(place, path);
        const Vec3 way =
            emission.parallel() ? -emission.ray.direction : emission.position - place.position;
        if (!(emission.start > 0) || glm::dot(way, place.geometric_normal) <= 0) continue;
        const PathVertex first = guide.arrive_at(walk_from_light(emission), hits[0]);
        auto light = guide.lead(first, deltas[0], std::span(hits).subspan(1),
                                {deltas.begin() + 1, deltas.end()});
        for (std::size_t i = 0; i < light.size(); ++i) {
            const std::size_t e = n - 1 - i;
            if (deltas[i] || (e > 0 && path.deltas[e - 1])) continue;
            light[i].throughput = Rgb(1);
            if (const auto found = join(eye[e], light[i])) all.push_back(found->weight);
        }
    }
}

// Weights of all ways to find a path; none where it carries no light.
Weights weights_of(const Guide& guide, const PathVertex& end, const FoundPath& path) {
    Weights all;
    const auto eye = guide.lead(end, false, path.hits, path.deltas);
    if (eye.size() != path.hits.size() + 1) return all;
    add_meeting(guide, eye.back(), path, all);
    add_light_samples(guide, eye.back(), path, all);
    add_walks(guide, eye, path, all);
    return all;
}

// Paths that walks from the eye find: they end where they meet the lamp, or after some steps at a
// random point of it.
std::optional<FoundPath> find_path(const Meter& meter, const PathVertex& end, Rng& rng) {
    FoundPath path;
    PathVertex vertex = end;
    while (path.hits.size() < 6) {
        const auto step = sample_step(vertex, rng.uniform(), {rng.uniform(), rng.uniform()});
        if (!step) return std::nullopt;
        if (!path.hits.empty()) path.deltas.push_back(step->delta);
        const Ray ray = {origin_toward(vertex.place, step->direction), step->direction};
        const Hit hit = meter.look(ray.origin, ray.direction);
        if (!hit) return std::nullopt;
        if (emission(meter.scene, hit.point, hit.front) != Rgb(0)) {
            if (path.hits.empty()) return std::nullopt;
            path.lamp = hit;
            return path;
        }
        path.hits.push_back(hit);
        const Walk walk = {.throughput = Rgb(1), .pdf = step->pdf, .normal = Vec3(0)};
        vertex = arrive(meter.lit, walk, ray, hit, describe(meter.lit, hit));
        if (rng.uniform() > 0.4f || is_delta_only(vertex.bsdf)) continue;
        path.deltas.push_back(false);
        if (!meter.lit.environment.empty()) {
            path.sky_numbers = {rng.uniform(), rng.uniform()};
            const LitPlace place = lit_place(vertex.place);
            path.sky = meter.lit.environment.sample(place, path.sky_numbers)->direction;
            return path;
        }
        if (meter.area_lights.empty()) return path;
        const auto view =
            view_area_light(meter.lit, vertex.place, 0.5f, {rng.uniform(), rng.uniform()});
        if (!view) return std::nullopt;
        path.lamp = Hit{view->sample.point, 1, true, view->sample.normal};
        return path;
    }
    return std::nullopt;
}

// A room of plastic with a ball of that material, whose normals are interpolated, and a block of
// another; nothing shines yet.
Scene room(const Gloss& ball, const Gloss& block) {
    Scene scene;
    add_room(scene, {-2, -2, 0}, {2, 2, 3}, add_glossy(scene, Rgb(0.6f), plastic(0.4f)));
    add_ball(scene, {0.6f, 0.5f, 1}, 0.6f, add_glossy(scene, Rgb(0.9f), ball));
    add_box(scene, {-1.4f, -0.8f, 0.3f}, {-0.4f, 0.6f, 1.1f}, add_glossy(scene, Rgb(0.9f), block));
    return scene;
}

void light_up(Scene& scene, LightSource light) {
    switch (light) {
        case LightSource::area:
            add_quad(scene, {-0.6f, -0.5f, 2.6f}, {0, 1, 0}, {1.2f, 0, 0},
                     add_material(scene, Rgb(0), Rgb(10)));
            scene.materials.back().emits_backward = true;
            break;
        case LightSource::lamp:
            scene.lights.push_back(point_light({-0.5f, 1, 2.5f}, Rgb(10)));
            break;
        case LightSource::sun:
            scene.lights.push_back(sun({0.2f, 0.3f, -1}, Rgb(10)));
            break;
        case LightSource::sky:
            scene.environment.sky = Rgb(10);
    }
}

struct Ways {
    int paths = 0, ways = 0;
    double worst = 0;  // of the errors of the sums
};

Ways check_paths(const Meter& meter) {
    const Guide guide(meter.lit);
    const Vec3 up(0, 0, 1), place(0.1f, 1.4f, 0);
    const PathVertex end = eye_end({place, place + 1e-4f * up, up, up});
    Ways all;
    Rng rng(7);
    for (int i = 0; i < 3000; ++i) {
        const auto path = find_path(meter, end, rng);
        if (!path) continue;
        const Weights weights = weights_of(guide, end, *path);
        if (weights.empty()) continue;
        double sum = 0;
        for (const float weight : weights) sum += double(weight);
        ++all.paths;
        all.ways += int(weights.size());
        all.worst = std::max(all.worst, std::abs(sum - 1));
    }
    return all;
}

// Over lights of every kind, and about a ball of any material, whose normals lean, and a block.
// What is left are rounding errors where vertices are close.
TEST(MisWeight, AllWaysToFindAPathSumToOne) {
    const Gloss balls[] = {metal(0),        metal(0.4f),        plastic(0),       plastic(0.3f),
                           glass(0, false), glass(0.4f, false), glass(0.4f, true)};
    for (const Gloss& ball : balls)
        for (const LightSource light :
             {LightSource::area, LightSource::lamp, LightSource::sun, LightSource::sky}) {
            Scene scene = room(ball, ball.transmission > 0 ? metal(0.3f) : glass(0, false));
            light_up(scene, light);
            const Meter meter(std::move(scene));
            const Ways found = check_paths(meter);
            EXPECT_LT(found.worst, 0.01) << int(light) << " " << ball.roughness;
            EXPECT_GT(found.paths, 300);
            EXPECT_GT(found.ways, 2 * found.paths);
        }
}

}  // namespace
}  // namespace chiaro::tiny
