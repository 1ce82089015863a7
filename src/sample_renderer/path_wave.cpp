#include "sample_renderer/path_wave.h"

#include "sample_renderer/sequence.h"
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

MetSurface describe(const LitScene& lit, const Ray& ray, const Hit& hit) {
    const Scene& scene = lit.scene;
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(hit.point.object)]);
    const Material& material = scene.material(mesh.primitives[hit.point.primitive].material);
    const Vec3 shading =
        mesh.normals.empty() ? hit.normal : shading_normal(scene, hit.point, hit.normal);
    const bool plain = !material.base_color_texture.used() && mesh.colors.empty();

    const float side = hit.front ? 1.0f : -1.0f;
    return {make_receiver(lit.caster, hit.point.object, ray.origin + hit.t * ray.direction,
                          side * hit.normal, side * shading),
            plain ? material.base_color : Rgb(base_color(scene, hit.point)), material.emissive()};
}

// Emission that a ray of a path met by chance, which next event estimation at its origin may have
// found too.
Rgb met_emission(const LitScene& lit, const Path& path, const Ray& ray, const Hit& hit) {
    const float pdf_light = lit.choice.probability_of_area_lights() *
                            pdf_area_light(lit, {ray.origin, path.normal}, ray.direction, hit);
    const float weight = path.pdf / (path.pdf + pdf_light);
    return path.throughput * weight * emission(lit.scene, hit.point, hit.front);
}

// Asks one light; `reflected` is the path's throughput after the reflection here.
void add_next_event(const LitScene& lit, const Receiver& receiver, const Path& path, Rgb reflected,
                    ShadowBatch& shadows) {
    const LightChoice::Choice choice = lit.choice.sample(path.light_choice);
    const auto connection = choice.punctual >= 0
                                ? connect_punctual(lit, receiver, choice.punctual)
                                : connect_area_light(lit, receiver, choice.rest, path.light_place);
    if (!connection) return;
    const float pdf = connection->pdf_solid_angle * choice.probability;
    const float weight = pdf > 0 ? pdf / (pdf + connection->pdf_cosine) : 1.0f;
    shadows.add(connection->shadow_ray,
                reflected * connection->irradiance * (weight / (kPi * choice.probability)),
                path.slot);
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
    return true;
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
    blocked.resize(rays.size());
    caster.occluded(rays, blocked);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (blocked[i] == 0) sums[slots[i]] += values[i];
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

void follow(const LitScene& lit, PathWave& wave, FirstEmission first, std::span<Rgb> sums) {
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
            const MetSurface surface = describe(lit, ray, hit);

            // Light that the surface emits.
            if (surface.emissive) {
                if (bounce > 0)
                    sums[path.slot] += met_emission(lit, path, ray, hit);
                else if (first == FirstEmission::counted)
                    sums[path.slot] += path.throughput * emission(lit.scene, hit.point, hit.front);
            }

            // Light that it reflects: from a light at once, from elsewhere by the next ray.
            const Rgb reflected = path.throughput * surface.albedo;
            if (!(max_component(reflected) > 0) || lit.choice.empty()) continue;
            BounceNumbers numbers(path.key, bounce);
            if (bounce > 0) {
                path.light_choice = numbers.next();
                path.light_place = numbers.next_pair();
            }
            add_next_event(lit, surface.receiver, path, reflected, wave.shadows);
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
