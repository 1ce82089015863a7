#include "image_generator/specular_chains.h"

#include "base/halton.h"

#include <array>

namespace chiaro {
namespace {

constexpr float kLeastPart = 1.0f / 512;   // of a ray: what is behind it is not missed
constexpr float kLeastLeft = 1.0f / 1024;  // of a chain
constexpr int kMostSurfaces = 16;
constexpr float kFar = 1e9f;  // scenes end before

// A ray on its way, at the same place in the wave's arrays.
struct Way {
    std::uint32_t looking;
    Trail trail;
    Rgb left;  // of the camera ray's radiance
    float distance;
    float index2;
    bool after_chance;  // and nothing but panes since
};
struct Wave {
    std::vector<Ray> rays;
    std::vector<Way> ways;

    void clear() {
        rays.clear();
        ways.clear();
    }
};
struct Waves {
    Wave camera, transport;
    bool empty() const { return camera.rays.empty() && transport.rays.empty(); }
    void clear() {
        camera.clear();
        transport.clear();
    }
};

// What follows rays of one call, and where they go next.
struct Chains {
    const RayCaster& rays;
    std::span<const Looking> looking;
    const ChainSettings& settings;
    std::vector<SightLine>* lines;
    Waves next = {};
    std::vector<LayerHit> layers = {};

    void add(RayKind kind, const Sighting& at, const Scattering& s, Step step, Vec3 direction,
             Rgb weight);
    void scatter(const Sighting& at, const Scattering& s);
    void go_on(RayKind kind, Sighting& at, Vec3 direction, bool last);
    void see(RayKind kind, const Wave& wave, bool last, std::vector<Sighting>& found);
    Sighting make_sighting(const Way& way, float part) const;
};

void Chains::add(RayKind kind, const Sighting& at, const Scattering& s, Step step, Vec3 direction,
                 Rgb weight) {
    const float part = looking[at.looking].part;
    const Rgb left = at.weight * weight;
    const bool passes = glm::dot(direction, s.geometric_normal) < 0;
    const float index2 = passes && !s.bsdf.thin ? at.index2 * s.bsdf.eta * s.bsdf.eta : at.index2;
    // Within glass radiance is dense: of what is seen there less is left than will be outside.
    if (!(max_component(left) * index2 >= kLeastLeft * part)) return;
    const Vec3 position = surface_position(rays.scene(), at.hit.point);
    const float lift = rays.offset(position, at.hit.point.object);
    const float side = passes ? -lift : lift;
    Wave& wave = kind == RayKind::camera ? next.camera : next.transport;
    wave.rays.push_back({position + side * s.geometric_normal, direction});
    const bool after_chance =
        step == Step::scattered || (step == Step::transmitted && s.bsdf.thin && at.after_chance);
    wave.ways.push_back(
        {at.looking, longer(at.trail, step), left / part, at.distance, index2, after_chance});
}

// Where facets lead by chance. The rays of a pixel share a sequence where it matters most: at the
// first of them.
void Chains::scatter(const Sighting& at, const Scattering& s) {
    const Looking& from = looking[at.looking];
    const bool first = !by_chance(at.trail);
    const int count = first ? settings.directions : 1;
    std::uint32_t key = hash32(from.key, at.trail);
    if (!first) key = hash32(key, from.index);
    for (int i = 0; i < count; ++i) {
        const std::uint32_t index =
            first ? from.index * static_cast<std::uint32_t>(count) + static_cast<std::uint32_t>(i)
                  : 0;
        std::array<float, 3> u;
        for (int d = 0; d < 3; ++d)
            u[d] = rotate_unit(halton(d, index),
                               to_unit_float(hash32(key, static_cast<std::uint32_t>(d))));
        const auto sample = sample_scattering(s, u[2], {u[0], u[1]});
        if (!sample) continue;
        add(RayKind::transport, at, s, Step::scattered, sample->direction,
            sample->weight / static_cast<float>(count));
    }
}

// Completes what is known of the surface, seen along `direction`, and sends the rays that show what
// is seen in it.
void Chains::go_on(RayKind kind, Sighting& at, Vec3 direction, bool last) {
    const Bsdf bsdf = bsdf_at(rays.scene(), at.hit.point, at.hit.front);
    at.diffuse = bsdf.diffuse;
    if (is_lambertian(bsdf)) return;
    const float side = at.hit.front ? 1.0f : -1.0f;
    const Vec3 shading =
        at.hit.flat ? at.hit.normal : shading_normal(rays.scene(), at.hit.point, at.hit.normal);
    Scattering s = make_scattering(bsdf, side * at.hit.normal, side * shading, -direction);
    at.cosine = s.from.z;
    at.diffuse = diffuse_albedo(bsdf, at.cosine);

    if (bsdf.smooth()) {
        if (last) return;
        const SmoothParts parts = smooth_parts(s);
        add(RayKind::transport, at, s, Step::reflected, parts.reflected_from, parts.reflected);
        add(bsdf.thin ? kind : RayKind::transport, at, s, Step::transmitted, parts.transmitted_from,
            parts.transmitted);
    } else if (kind == RayKind::camera && bsdf.alpha >= settings.cached_facets) {
        at.cached_gloss = true;
    } else {
        s.bsdf = specular_only(bsdf);
        const float albedo = luminance(total_albedo(s.bsdf, at.cosine));
        if (max_component(at.weight) * albedo < kLeastLeft * looking[at.looking].part) return;
        at.by_chance = albedo;
        if (!last) scatter(at, s);
    }
}

Sighting Chains::make_sighting(const Way& way, float part) const {
    Sighting at;
    at.looking = way.looking;
    at.trail = way.trail;
    at.weight = way.left * (looking[way.looking].part * part);
    at.distance = way.distance;
    at.index2 = way.index2;
    at.after_chance = way.after_chance;
    return at;
}

void Chains::see(RayKind kind, const Wave& wave, bool last, std::vector<Sighting>& found) {
    const Scene& scene = rays.scene();
    const EnvironmentFrame frame(scene.up);
    const bool sees_environment = settings.chains && settings.environment;
    rays.intersect_layers(wave.rays, layers, kind);
    auto layer = layers.begin();
    for (std::uint32_t i = 0; i < wave.rays.size(); ++i) {
        const Ray& ray = wave.rays[i];
        float left = 1;  // of the ray
        Vec3 farthest = ray.origin;
        for (; layer != layers.end() && layer->ray == i; ++layer) {
            if (left < kLeastPart) continue;
            const float part = left * opacity(scene, layer->hit.point);
            left -= part;
            Sighting at = make_sighting(wave.ways[i], part);
            at.hit = layer->hit;
            at.position = farthest = ray.origin + at.hit.t * ray.direction;
            at.distance += at.hit.t;
            at.seen_from = ray.origin;
            if (settings.chains) {
                if (!at.after_chance)
                    at.light = at.weight * emission(scene, at.hit.point, at.hit.front);
                go_on(kind, at, ray.direction, last);
            }
            found.push_back(at);
        }
        if (lines) {
            const bool hidden = left < kLeastPart;
            lines->push_back({looking[wave.ways[i].looking].x, ray.origin,
                              hidden ? farthest : ray.origin + kFar * ray.direction});
        }
        if (left < kLeastPart || !sees_environment || wave.ways[i].after_chance) continue;
        Sighting beyond = make_sighting(wave.ways[i], left);
        beyond.light = beyond.weight * radiance_from(scene.environment, frame, ray.direction);
        found.push_back(beyond);
    }
}

}  // namespace

void look(const RayCaster& rays, std::span<const Looking> looking, const ChainSettings& settings,
          std::vector<Sighting>& found, std::vector<SightLine>* lines) {
    found.clear();
    found.reserve(looking.size());
    Waves waves;
    waves.camera.rays.reserve(looking.size());
    waves.camera.ways.reserve(looking.size());
    for (std::uint32_t i = 0; i < looking.size(); ++i) {
        waves.camera.rays.push_back(looking[i].ray);
        waves.camera.ways.push_back({i, 0, Rgb(1), 0, 1, false});
    }
    Chains chains{rays, looking, settings, lines};
    for (int surfaces = 1; !waves.empty(); ++surfaces) {
        const bool last = surfaces == kMostSurfaces;
        chains.next.clear();
        chains.see(RayKind::camera, waves.camera, last, found);
        chains.see(RayKind::transport, waves.transport, last, found);
        std::swap(waves, chains.next);
    }
}

}  // namespace chiaro
