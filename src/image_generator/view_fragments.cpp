#include "image_generator/view_fragments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro {
namespace {

// A ray of the camera's, and what part of the pixel it is.
struct Looking {
    Ray ray;
    std::uint32_t x = 0;
    float part = 1;
};

// Place `i` of side x side in a pixel, on a rotated grid: as many different heights and widths as
// places, so that edges near the axes are smooth too.
Vec2 place_in_pixel(int i, int side) {
    const auto n = static_cast<float>(side);
    const auto a = static_cast<float>(i % side), b = static_cast<float>(i / side);
    return {(a + (b + 0.5f) / n) / n, (b + (a + 0.5f) / n) / n};
}

constexpr float kLeastPart = 1.0f / 512;  // of a ray: what is behind it is not missed

// Follows rays until they are stopped, and tells `see(looking, hit, part)` of each surface
// that shows, ray by ray and front to back; `part` is what of the pixel it takes. What is left of
// a ray in the end sees the environment: `see_beyond(looking, part)`.
template <typename See, typename SeeBeyond>
void look(const RayCaster& rays, std::span<const Looking> looking, const See& see,
          const SeeBeyond& see_beyond) {
    const Scene& scene = rays.scene();
    std::vector<Ray> cast;
    for (const Looking& l : looking) cast.push_back(l.ray);
    std::vector<LayerHit> layers;
    rays.intersect_layers(cast, layers);

    auto layer = layers.begin();
    for (std::uint32_t ray = 0; ray < looking.size(); ++ray) {
        float left = 1;  // of the ray
        for (; layer != layers.end() && layer->ray == ray; ++layer) {
            if (left < kLeastPart) continue;
            const float part = left * opacity(scene, layer->hit.point);
            see(looking[ray], layer->hit, looking[ray].part * part);
            left -= part;
        }
        if (left >= kLeastPart) see_beyond(looking[ray], looking[ray].part * left);
    }
}

// The environment as rays that leave the scene see it.
class Beyond {
public:
    Beyond(const Scene& scene, Aov aov)
        : environment_(scene.environment),
          frame_(scene.up),
          seen_(aov == Aov::radiance && !(environment_.sky == Rgb(0) && !environment_.has_map())) {}
    Rgb seen(const Ray& ray, float part) const {
        return seen_ ? part * radiance_from(environment_, frame_, ray.direction) : Rgb(0);
    }

private:
    const Environment& environment_;
    EnvironmentFrame frame_;
    bool seen_;
};

Rgb seen_reflectance(const Scene& scene, const Hit& hit, Aov aov, float part) {
    if (aov == Aov::irradiance) return Rgb(part);
    return Rgb(base_color(scene, hit.point)) * (part / kPi);
}

// Pieces of one pixel that lie on the same side of the same primitive become one, at their mean
// place.
void add_piece(std::vector<SeenPiece>& pieces, std::vector<float>& weights, std::size_t first,
               const SeenPiece& piece, float part) {
    for (std::size_t i = first; i < pieces.size(); ++i) {
        SeenPiece& known = pieces[i];
        if (known.point.object != piece.point.object ||
            known.point.primitive != piece.point.primitive || known.front != piece.front)
            continue;
        float& weight = weights[i - first];
        const float share = part / (weight + part);
        known.point.u += share * (piece.point.u - known.point.u);
        known.point.v += share * (piece.point.v - known.point.v);
        known.reflectance += piece.reflectance;
        weight += part;
        return;
    }
    pieces.push_back(piece);
    weights.push_back(part);
}

Rgb seen_emission(const Scene& scene, const Hit& hit, Aov aov, float part) {
    if (aov == Aov::irradiance) return Rgb(0);
    return part * emission(scene, hit.point, hit.front);
}

// What a ray met first, as outlines are found by it.
CentreHit centre_hit(const Scene& scene, const Ray& ray, const Hit& hit) {
    if (!hit) return {};
    const MaterialId id = material_of(scene, hit.point);
    const Material& m = scene.material(id);
    return {hit.point.object,
            id,
            hit.normal,
            ray.origin + hit.t * ray.direction,
            hit.t,
            hit.point,
            m.base_color_texture.used(),
            m.emissive(),
            m.see_through() || m.emission_texture.used()};
}

}  // namespace

SeenRow see_row(const RayCaster& rays, const View& view, int y, Aov aov,
                std::vector<CentreHit>& centres) {
    const Scene& scene = rays.scene();
    SeenRow row;
    row.background.assign(view.width(), Rgb(0));
    centres.assign(view.width(), CentreHit{});
    std::vector<Looking> looking(view.width());
    for (int x = 0; x < view.width(); ++x)
        looking[x] = {view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f),
                      static_cast<std::uint32_t>(x), 1};

    const Beyond beyond(scene, aov);
    const auto see = [&](const Looking& l, const Hit& hit, float part) {
        row.pieces.push_back({l.x, hit.point, hit.front, seen_reflectance(scene, hit, aov, part)});
        row.background[l.x] += seen_emission(scene, hit, aov, part);
        CentreHit& centre = centres[l.x];
        if (centre.object == ObjectId::none) centre = centre_hit(scene, l.ray, hit);
    };
    look(rays, looking, see,
         [&](const Looking& l, float part) { row.background[l.x] += beyond.seen(l.ray, part); });
    return row;
}

std::vector<char> more_within(const RayCaster& rays, const View& view, int y,
                              std::span<const CentreHit> centres, float footprint,
                              std::span<const char> known) {
    constexpr int kSide = 2;
    std::vector<Ray> scouts;
    std::vector<std::uint32_t> pixels;
    for (std::uint32_t x = 0; x < centres.size(); ++x) {
        if (known[x]) continue;
        for (int i = 0; i < kSide * kSide; ++i) {
            const Vec2 at = place_in_pixel(i, kSide);
            scouts.push_back(view.ray(static_cast<float>(x) + at.x, static_cast<float>(y) + at.y));
            pixels.push_back(x);
        }
    }
    std::vector<Hit> hits(scouts.size());
    rays.intersect_coherent(scouts, hits, RayKind::camera);

    std::vector<char> more(centres.size(), 0);
    const Scene& scene = rays.scene();
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const CentreHit found = centre_hit(scene, scouts[i], hits[i]);
        if (outline_between(centres[pixels[i]], found, footprint)) more[pixels[i]] = 1;
    }
    return more;
}

void see_pixel(const RayCaster& rays, const View& view, int x, int y, int side, Aov aov,
               SeenRow& row) {
    std::vector<Looking> looking(side * side);
    for (int i = 0; i < side * side; ++i) {
        const Vec2 at = place_in_pixel(i, side);
        looking[i] = {view.ray(static_cast<float>(x) + at.x, static_cast<float>(y) + at.y),
                      static_cast<std::uint32_t>(x), 1 / static_cast<float>(side * side)};
    }
    const Scene& scene = rays.scene();
    const std::size_t first = row.pieces.size();
    std::vector<float> weights;
    Rgb background(0);
    const Beyond beyond(scene, aov);
    const auto see = [&](const Looking& l, const Hit& hit, float part) {
        add_piece(row.pieces, weights, first,
                  {l.x, hit.point, hit.front, seen_reflectance(scene, hit, aov, part)}, part);
        background += seen_emission(scene, hit, aov, part);
    };
    look(rays, looking, see,
         [&](const Looking& l, float part) { background += beyond.seen(l.ray, part); });
    row.background[x] = background;
}

Rgb mean_environment(const Scene& scene, const View& view, int x, int y, float footprint) {
    const Beyond beyond(scene, Aov::radiance);
    const auto map_pixels_a_radian = static_cast<float>(scene.environment.map.width) / (2 * kPi);
    const int side =
        static_cast<int>(std::clamp(std::ceil(footprint * map_pixels_a_radian), 1.0f, 8.0f));
    Rgb sum(0);
    for (int i = 0; i < side * side; ++i) {
        const Vec2 at = place_in_pixel(i, side);
        sum += beyond.seen(view.ray(static_cast<float>(x) + at.x, static_cast<float>(y) + at.y), 1);
    }
    return sum / static_cast<float>(side * side);
}

Rgb mean_base_color(const Scene& scene, const SurfacePoint& here, const SurfacePoint& beside,
                    const SurfacePoint& below) {
    const Vec2 across(beside.u - here.u, beside.v - here.v);
    const Vec2 down(below.u - here.u, below.v - here.v);
    const auto color_at = [&](float x, float y) {
        SurfacePoint p = here;
        const Vec2 uv = Vec2(here.u, here.v) + x * across + y * down;
        p.u = std::clamp(uv.x, 0.0f, 1.0f);
        p.v = std::clamp(uv.y, 0.0f, 1.0f);
        return Rgb(base_color(scene, p));
    };
    // Four places, irregular so that no pattern falls in step with them, show whether there is any
    // detail within the pixel; if so, sixteen resolve it.
    constexpr std::array<Vec2, 4> kProbes = {Vec2(-0.37f, -0.21f), Vec2(0.29f, -0.38f),
                                             Vec2(0.41f, 0.33f), Vec2(-0.18f, 0.27f)};
    Rgb sum(0), low(kInfinity), high(0);
    for (const Vec2 probe : kProbes) {
        const Rgb c = color_at(probe.x, probe.y);
        sum += c;
        low = glm::min(low, c);
        high = glm::max(high, c);
    }
    if (max_component(high - low) <= 0.02f * max_component(high)) return 0.25f * sum;
    sum = Rgb(0);
    for (int i = 0; i < 16; ++i)
        sum += color_at((static_cast<float>(i % 4) - 1.5f) / 4,
                        (static_cast<float>(i / 4) - 1.5f) / 4);
    return sum / 16.0f;
}

bool outline_between(const CentreHit& a, const CentreHit& b, float footprint) {
    if (a.object != b.object || a.material != b.material) return true;
    if (a.object == ObjectId::none) return false;
    if (glm::dot(a.normal, b.normal) < 0.98f) return true;
    // One surface, or two behind each other? The second point lies in the first's plane, or nearly.
    const float reach = 2 * footprint * std::max(a.distance, b.distance);
    const Vec3 between = b.position - a.position;
    return std::abs(glm::dot(between, a.normal)) > reach + 0.25f * glm::length(between);
}

}  // namespace chiaro
