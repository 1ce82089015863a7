#include "sample_renderer/path_wave.h"

#include "sample_renderer/diffuse_bounce.h"
#include "sample_renderer/path_bounce.h"

#include <algorithm>

namespace chiaro {

void ShadowBatch::clear() {
    rays.clear();
    values.clear();
    slots.clear();
    second_rays.clear();
    second_of.clear();
}

void ShadowBatch::add(const LightConnection& connection, Rgb value, std::uint32_t slot) {
    if (connection.second_ray) {
        second_rays.push_back(*connection.second_ray);
        second_of.push_back(static_cast<std::uint32_t>(rays.size()));
    }
    rays.push_back(connection.shadow_ray);
    values.push_back(value);
    slots.push_back(slot);
}

void ShadowBatch::add(const LightConnections8& connections, const Vec3x8& origin,
                      const Vec3x8& value, std::span<const std::uint32_t, kLanes> lane_slots) {
    const Vec3x8& direction = connections.shadow_direction;
    Float8 words[kLanes] = {origin.x,    origin.y,    origin.z, direction.x,
                            direction.y, direction.z, 0.0f,     1.0f};
    Ray lane_rays[kLanes];
    store_words(words, lane_rays);
    const Lanes3 lane_values(value);
    for_each_lane(connections.found, [&](int lane) {
        rays.push_back(lane_rays[lane]);
        values.push_back(lane_values.lane(lane));
        slots.push_back(lane_slots[lane]);
    });
}

void ShadowBatch::settle(const RayCaster& caster, std::span<Rgb> sums) {
    through.resize(std::max(rays.size(), second_rays.size()));
    caster.transmittance(second_rays, std::span(through).first(second_rays.size()));
    for (std::size_t i = 0; i < second_rays.size(); ++i) values[second_of[i]] *= through[i];
    caster.transmittance(rays, std::span(through).first(rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) sums[slots[i]] += through[i] * values[i];
    clear();
}

void PathWave::clear() {
    rays.clear();
    paths.clear();
    shadows.clear();
}

void PathWave::add(const Ray& ray, const Path& path) {
    rays.push_back(ray);
    paths.push_back(path);
}

namespace {

// A wave whose rays have been cast: what they find, and where their paths go on from there.
struct Step {
    const LitScene& lit;
    PathWave& wave;
    std::uint32_t bounce;
    FirstEmission first_emission;
    std::span<Rgb> sums;
    const EndsAt* ends_at;
};

void add_environment(const Step& step, const Path& path, const Ray& ray) {
    if (path.first == 0)
        step.sums[path.slot] += met_environment(step.lit, path, ray);
    else if (step.first_emission == FirstEmission::counted)
        step.sums[path.slot] += path.throughput * step.lit.environment.radiance(ray.direction);
}

void add_emission(const Step& step, const Path& path, const Ray& ray, const Hit& hit) {
    if (path.first == 0)
        step.sums[path.slot] += met_emission(step.lit, path, ray, hit);
    else if (step.first_emission == FirstEmission::counted)
        step.sums[path.slot] += path.throughput * emission(step.lit.scene, hit.point, hit.front);
}

bool scatter(const Step& step, std::size_t at, EightPaths& next, int lane) {
    const Hit& hit = step.wave.hits[at];
    next.paths[lane] = step.wave.paths[at];
    next.rays[lane] = step.wave.rays[at];
    const MetSurface surface = describe(step.lit, hit);
    const Bounce here = {step.lit, surface, hit, step.bounce, step.ends_at, step.wave.shadows};
    return scatter(here, next.paths[lane], next.rays[lane]);
}

// Eight neighbours from `first` on; returns those that go on, in `next`.
std::uint32_t advance(const Step& step, std::size_t first, EightPaths& next) {
    const Scene& scene = step.lit.scene;
    DiffuseBounce diffuse = {step.lit, step.wave, first, step.bounce, step.ends_at};
    std::uint32_t others = 0;
    for (int lane = 0; lane < diffuse.lane_count(); ++lane) {
        const std::size_t at = first + lane;
        const Hit& hit = step.wave.hits[at];
        if (!hit) {
            add_environment(step, step.wave.paths[at], step.wave.rays[at]);
            continue;
        }
        const Mesh& mesh = scene.mesh_of(scene.objects[index_of(hit.point.object)]);
        const Material& material = scene.material(mesh.primitives[hit.point.primitive].material);
        if (material.emissive()) add_emission(step, step.wave.paths[at], step.wave.rays[at], hit);
        if (step.lit.dark()) continue;
        if (material.gloss.model != GlossModel::none) {
            others |= 1U << lane;
            continue;
        }
        const bool plain = !material.base_color_texture.used() && mesh.colors.empty();
        diffuse.lanes |= 1U << lane;
        diffuse.base_color.set(lane,
                               plain ? material.base_color : Rgb(base_color(scene, hit.point)));
        diffuse.shading_normal.set(
            lane, hit.flat ? hit.normal : shading_normal(scene, hit.point, hit.normal));
    }

    std::uint32_t going_on = diffuse.lanes == 0 ? 0 : reflect_diffusely(diffuse, next);
    for_each_lane(others, [&](int lane) {
        if (scatter(step, first + lane, next, lane)) going_on |= 1U << lane;
    });
    return going_on;
}

}  // namespace

void follow(const LitScene& lit, PathWave& wave, FirstEmission first, std::span<Rgb> sums,
            const EndsAt* ends_at) {
    EightPaths next;
    for (std::uint32_t bounce = 0; !wave.paths.empty(); ++bounce) {
        if (bounce > 0) {
            wave.hits.resize(wave.rays.size());
            lit.caster.intersect(wave.rays, wave.hits);
        }
        const Step step = {lit, wave, bounce, first, sums, ends_at};
        std::size_t alive = 0;
        for (std::size_t i = 0; i < wave.paths.size(); i += kLanes)
            for_each_lane(advance(step, i, next), [&](int lane) {
                wave.paths[alive] = next.paths[lane];
                wave.rays[alive++] = next.rays[lane];
            });
        wave.paths.resize(alive);
        wave.rays.resize(alive);
        wave.shadows.settle(lit.caster, sums);
    }
}

}  // namespace chiaro
