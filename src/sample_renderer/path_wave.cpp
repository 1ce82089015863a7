#include "sample_renderer/path_wave.h"

#include "sample_renderer/warp.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr float kMostSurvival = 0.98f;  // or a closed room of albedo 1 would never end

// What a path needs to know of the surface that it met.
struct MetSurface {
    Receiver receiver;  // on the side that the ray came from
    Rgb albedo;
    bool emissive;
};

MetSurface describe(const LitScene& lit, const Hit& hit) {
    const Scene& scene = lit.scene;
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(hit.point.object)]);
    const Material& material = scene.material(mesh.primitives[hit.point.primitive].material);
    const Vec3 shading =
        lit.caster.flat(hit.point) ? hit.normal : shading_normal(scene, hit.point, hit.normal);
    const bool plain = !material.base_color_texture.used() && mesh.colors.empty();

    const float side = hit.front ? 1.0f : -1.0f;
    return {make_receiver(lit.caster, hit.point.object, surface_position(scene, hit.point),
                          side * hit.normal, side * shading),
            plain ? material.base_color : Rgb(base_color(scene, hit.point)), material.emissive()};
}

// Emission that a ray of a path met by chance, which next event estimation at its origin may have
// found too.
Rgb met_emission(const LitScene& lit, const Path& path, const Ray& ray, const Hit& hit) {
    const Rgb radiance = emission(lit.scene, hit.point, hit.front);
    if (radiance == Rgb(0)) return radiance;
    const float pdf_light = pdf_area_light(lit, {ray.origin, path.normal}, ray.direction, hit);
    return path.throughput * radiance * (path.pdf / (path.pdf + pdf_light));
}

// Asks one light of each kind: none takes samples from another, which may be hidden where it seems
// brightest. `reflected` is the path's throughput after the reflection here.
void add_next_events(const LitScene& lit, const Receiver& receiver, const Path& path, Rgb reflected,
                     ShadowBatch& shadows) {
    const Rgb brdf = reflected * (1 / kPi);
    if (!lit.area_lights.empty()) {
        if (const auto found =
                connect_area_light(lit, receiver, path.light_choice, path.light_place)) {
            const float pdf = found->pdf_solid_angle;
            shadows.add(found->shadow_ray,
                        brdf * found->irradiance * (pdf / (pdf + found->pdf_cosine)), path.slot);
        }
    }
    if (!lit.punctual.lamps().empty())
        if (const auto found = connect_lamp(lit, receiver, path.light_choice))
            shadows.add(found->shadow_ray, brdf * found->irradiance, path.slot);
    if (!lit.punctual.suns().empty())
        if (const auto found = connect_sun(lit, receiver, path.light_choice))
            shadows.add(found->shadow_ray, brdf * found->irradiance, path.slot);
}

// Turns the path into its next ray; false if it ends here.
bool scatter(const Receiver& receiver, Rgb reflected, BounceNumbers& numbers, Path& path,
             Ray& ray) {
    const float survival = std::min(kMostSurvival, max_component(reflected));
    if (numbers.next() >= survival) return false;
    ray = {receiver.origin, sample_receiving_cosine(receiver, numbers.next_pair())};
    path.throughput = reflected * (1 / survival);
    path.pdf = pdf_receiving_cosine(receiver, ray.direction);
    path.normal = receiver.geometric_normal;
    return path.pdf > 0;
}

}  // namespace

void ShadowBatch::clear() {
    rays.clear();
    values.clear();
    slots.clear();
}

void ShadowBatch::add(const Ray& ray, Rgb value, std::uint32_t slot) {
    rays.push_back(ray);
    values.push_back(value);
    slots.push_back(slot);
}

void ShadowBatch::settle(const RayCaster& caster, std::span<Rgb> sums) {
    through.resize(rays.size());
    caster.transmittance(rays, through);
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

void follow(const LitScene& lit, PathWave& wave, FirstEmission first, std::span<Rgb> sums,
            const EndsAt* ends_at) {
    for (std::uint32_t bounce = 0; !wave.paths.empty(); ++bounce) {
        if (bounce > 0) {
            wave.hits.resize(wave.rays.size());
            lit.caster.intersect(wave.rays, wave.hits);
        }

        std::size_t alive = 0;
        for (std::size_t i = 0; i < wave.paths.size(); ++i) {
            const Hit& hit = wave.hits[i];
            if (!hit) continue;
            Path& path = wave.paths[i];
            Ray& ray = wave.rays[i];
            const MetSurface surface = describe(lit, hit);

            // Light that the surface emits.
            if (surface.emissive) {
                if (bounce > 0)
                    sums[path.slot] += met_emission(lit, path, ray, hit);
                else if (first == FirstEmission::counted)
                    sums[path.slot] += path.throughput * emission(lit.scene, hit.point, hit.front);
            }

            // Light that it reflects: from a light at once, from elsewhere by the next ray.
            const Rgb reflected = path.throughput * surface.albedo;
            if (!(max_component(reflected) > 0) || lit.dark()) continue;
            if (ends_at && (*ends_at)(path, bounce, hit, surface.receiver, reflected)) continue;
            BounceNumbers numbers(path.key, bounce);
            if (bounce > 0) {
                path.light_choice = numbers.next();
                path.light_place = numbers.next_pair();
            }
            add_next_events(lit, surface.receiver, path, reflected, wave.shadows);
            if (!scatter(surface.receiver, reflected, numbers, path, ray)) continue;
            wave.paths[alive] = path;
            wave.rays[alive] = ray;
            ++alive;
        }
        wave.paths.resize(alive);
        wave.rays.resize(alive);
        wave.shadows.settle(lit.caster, sums);
    }
}

}  // namespace chiaro
