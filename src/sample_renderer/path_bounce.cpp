#include "sample_renderer/path_bounce.h"

#include "sample_renderer/path_lights.h"
#include "scene/scattering.h"

#include <algorithm>

namespace chiaro {
namespace {

// Up to here a path ends at no smooth surface by roulette: no light sample took what it may find.
constexpr std::uint32_t kSureBounces = 8;

// Light that a surface which is not Lambertian scatters into the path; `receiver` faces the side
// that the lights are on.
void add_scattered_light(const Bounce& here, const Receiver& receiver, const Scattering& surface,
                         const Path& path) {
    connect_lights(here.lit, receiver, path, [&](const LightConnection& found) {
        const Rgb value = path.throughput * scattered(surface, found.to_light);
        if (!(max_component(value) > 0)) return;
        const float weight = light_weight(found, pdf_scattering(surface, found.to_light));
        here.shadows.add(found, value * found.irradiance * (weight / found.cosine), path.slot);
    });
}

// Numbers for the lights, unless it is the first surface of all: those are the sequence's.
void draw_light_numbers(const Bounce& here, BounceNumbers& numbers, Path& path) {
    if (here.number == 0) return;
    path.light_choice = numbers.next();
    path.light_place = numbers.next_pair();
    draw_sky_numbers(here.lit, here.number, path);
}

// Russian roulette on what the path has come to carry; false if it ends.
bool survives(float number, Path& path) {
    const float survival =
        std::min(kMostSurvival, path.roulette_scale * max_component(path.throughput));
    if (!(number < survival)) return false;
    path.throughput *= 1 / survival;
    return true;
}

// Turns the path along what was sampled.
void go_on(const Bounce& here, const Bsdf& bsdf, const BsdfSample& sample, Path& path, Ray& ray) {
    const bool passes = sample.lobe == Lobe::transmission;
    if (passes && bsdf.thin && sample.delta()) {
        pass_pane(here.hit, ray);
        return;
    }
    const Receiver& receiver = here.surface.receiver;
    const Receiver start = passes ? other_side(receiver) : receiver;
    if (passes && !bsdf.thin) path.roulette_scale *= bsdf.eta * bsdf.eta;
    ray = {start.origin, sample.direction};
    path.normal = start.geometric_normal;
    path.pdf = sample.pdf;
    path.first = false;
}

}  // namespace

void pass_pane(const Hit& hit, Ray& ray) {
    const float cosine = std::max(std::abs(glm::dot(hit.normal, ray.direction)), 0.05f);
    ray.t_min = hit.t + 2 * hit.offset / cosine;
}

MetSurface describe(const LitScene& lit, const Hit& hit) {
    const Scene& scene = lit.scene;
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(hit.point.object)]);
    const Material& material = scene.material(mesh.primitives[hit.point.primitive].material);
    const Vec3 shading = hit.flat ? hit.normal : shading_normal(scene, hit.point, hit.normal);
    const bool plain = !material.base_color_texture.used() && mesh.colors.empty();

    const float side = hit.front ? 1.0f : -1.0f;
    return {make_receiver(lit.caster, hit.point.object, surface_position(scene, hit.point),
                          side * hit.normal, side * shading),
            plain ? material.base_color : Rgb(base_color(scene, hit.point)), material};
}

Rgb met_emission(const LitScene& lit, const Path& path, const Ray& ray, const Hit& hit) {
    const Rgb radiance = emission(lit.scene, hit.point, hit.front);
    if (radiance == Rgb(0) || path.pdf == 0) return path.throughput * radiance;
    const float pdf_light = pdf_area_light(lit, {ray.origin, path.normal}, ray.direction, hit);
    return path.throughput * radiance * (path.pdf / (path.pdf + pdf_light));
}

Rgb met_environment(const LitScene& lit, const Path& path, const Ray& ray) {
    if (lit.environment.empty()) return Rgb(0);
    const Rgb radiance = path.throughput * lit.environment.radiance(ray.direction);
    if (radiance == Rgb(0) || path.pdf == 0) return radiance;
    const float pdf_light = lit.environment.pdf({ray.origin, path.normal}, ray.direction);
    return radiance * (path.pdf / (path.pdf + pdf_light));
}

Rgb passed_straight(const LitScene& lit, const Hit& hit, Ray& ray) {
    const Scene& scene = lit.scene;
    if (!may_pass_straight(scene.material(material_of(scene, hit.point)))) return Rgb(0);
    const Vec3 normal = shading_normal(scene, hit.point, hit.normal);
    const float cosine = glm::dot(normal, ray.direction);
    pass_pane(hit, ray);
    return straight_transmittance(bsdf_at(scene, hit.point, hit.front), cosine);
}

bool scatter(const Bounce& here, Path& path, Ray& ray) {
    const Receiver& receiver = here.surface.receiver;
    Scattering surface =
        make_scattering(bsdf_at(here.lit.scene, here.hit.point, here.hit.front),
                        receiver.geometric_normal, receiver.shading_normal, -ray.direction);

    // Diffuse light may be known here; the rest never is.
    Bsdf& bsdf = surface.bsdf;
    if (here.ends_at && has_diffuse(bsdf)) {
        const Rgb reflected = path.throughput * diffuse_albedo(bsdf, surface.from.z);
        if ((*here.ends_at)({{&path, 1},
                             {&here.hit, 1},
                             everywhere(receiver),
                             everywhere(reflected),
                             here.number,
                             1}) != 0) {
            if (is_lambertian(bsdf)) return false;
            bsdf = specular_only(bsdf);
        }
    }

    BounceNumbers numbers(path.key, here.number);
    draw_light_numbers(here, numbers, path);
    if (!is_delta_only(bsdf)) {
        add_scattered_light(here, receiver, surface, path);
        const bool lit_through = bsdf.glass > 0 && !bsdf.smooth();
        if (lit_through) add_scattered_light(here, other_side(receiver), surface, path);
    }

    const float roulette = numbers.next(), lobe = numbers.next();
    const bool chosen = here.number == 0 && path.direction;
    const Vec2 direction = chosen ? *path.direction : numbers.next_pair();
    const auto sample = sample_scattering(surface, lobe, direction);
    if (!sample) return false;
    path.throughput *= sample->weight;
    go_on(here, bsdf, *sample, path, ray);
    if (!(max_component(path.throughput) > 0)) return false;
    const bool sure = chosen || (sample->delta() && here.number < kSureBounces);
    return sure || survives(roulette, path);
}

}  // namespace chiaro
