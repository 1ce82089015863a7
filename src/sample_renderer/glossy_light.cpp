#include "sample_renderer/glossy_light.h"

#include "sample_renderer/path_bounce.h"
#include "scene/scattering.h"

namespace chiaro {
namespace {

constexpr std::uint32_t kGlossySalt = 0x61055e;
constexpr float kJustAbove = 1e-3f;

// Paths of the eye that have just met the surface, in the emptied wave.
void start_at_surface(const LitScene& lit, const ShadeRequest& request, std::uint32_t first,
                      std::uint32_t count, PathWave& wave) {
    const SurfaceGeometry g = surface_geometry(lit.scene, request.where);
    const Vec3 normal = request.front ? g.geometric_normal : -g.geometric_normal;
    const Vec3 shading = request.front ? g.shading_normal : -g.shading_normal;
    Vec3 to_eye = safe_normalize(request.eye - g.position, normal);
    const float height = glm::dot(to_eye, normal);
    if (height < kJustAbove) to_eye = glm::normalize(to_eye + (kJustAbove - height) * normal);

    Hit hit;
    hit.point = request.where;
    hit.t = glm::distance(request.eye, g.position);
    hit.front = request.front;
    hit.normal = g.geometric_normal;
    hit.offset = lit.caster.offset(g.position, request.where.object);
    const Ray ray = {g.position + hit.t * to_eye, -to_eye};

    // Little as it may reflect, that is what was asked for: paths are not to end for it.
    const Bsdf bsdf = specular_only(bsdf_at(lit.scene, request.where, request.front));
    const float cosine = make_scattering(bsdf, normal, shading, to_eye).from.z;
    const float albedo = max_component(total_albedo(bsdf, cosine));

    const Sequence sequence(hash32(request.seed, kGlossySalt));
    wave.clear();
    wave.hits.clear();
    if (!(albedo > 0)) return;
    for (std::uint32_t i = first; i < first + count; ++i) {
        Path path = make_path(sequence, i, i % kReplicates);
        path.roulette_scale = 1 / albedo;
        path.direction = sequence.pair(i, kFirstDirection);
        wave.add(ray, path);
        wave.hits.push_back(hit);
    }
}

// Light samples at the surface, and the rays that go on from it.
void scatter_all(const LitScene& lit, PathWave& wave) {
    const EndsAt leave_out_diffuse = [](const Meetings& all) { return all.lanes; };
    std::size_t left = 0;
    for (std::size_t i = 0; i < wave.paths.size(); ++i) {
        const MetSurface surface = describe(lit, wave.hits[i]);
        const Bounce here = {lit, surface, wave.hits[i], 0, &leave_out_diffuse, wave.shadows};
        if (!scatter(here, wave.paths[i], wave.rays[i])) continue;
        wave.paths[left] = wave.paths[i];
        wave.rays[left++] = wave.rays[i];
    }
    wave.paths.resize(left);
    wave.rays.resize(left);
}

// What emits light that the rays meet, straight or behind panes.
void settle_emission(const LitScene& lit, PathWave& wave, std::span<Rgb, kReplicates> sums) {
    cast_through_panes(
        lit, wave,
        [&](const Path& path, const Ray& ray, const Hit& hit) {
            sums[path.slot] += met_emission(lit, path, ray, hit);
        },
        [&](const Path& path, const Ray& ray) {
            sums[path.slot] += met_environment(lit, path, ray);
        });
}

}  // namespace

void add_glossy_samples(const LitScene& lit, const ShadeRequest& request, std::uint32_t first,
                        std::uint32_t count, PathWave& scratch, std::span<Rgb, kReplicates> sums,
                        const EndsAt* ends_at) {
    start_at_surface(lit, request, first, count, scratch);
    const EndsAt diffuse_is_known = [&](const Meetings& met) {
        if (met.bounce == 0) return met.lanes;
        return ends_at ? (*ends_at)(met) : 0;
    };
    follow(lit, scratch, FirstEmission::skipped, sums, &diffuse_is_known);
}

void add_glint_samples(const LitScene& lit, const ShadeRequest& request, std::uint32_t first,
                       std::uint32_t count, PathWave& scratch, std::span<Rgb, kReplicates> sums) {
    if (lit.dark()) return;
    start_at_surface(lit, request, first, count, scratch);
    scatter_all(lit, scratch);
    settle_emission(lit, scratch, sums);
    scratch.shadows.settle(lit.caster, sums);
}

}  // namespace chiaro
