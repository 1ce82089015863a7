#include "image_generator/view_fragments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro {
namespace {

// A ray on its way through surfaces that let the camera look on: what part of the pixel it still
// is.
struct Looking {
    Ray ray;
    std::uint32_t x = 0;
    float part = 1;
};

// What a ray meets on its way.
struct Seen {
    MaterialId id;
    const Material& material;
    Vec3 position;
};

constexpr int kMostLayers = 32;

// Follows rays until they are stopped, and tells `see(looking, hit, seen, part)` of each surface
// that shows; `part` is what of the pixel it takes.
template <typename See>
void look(const RayCaster& rays, std::vector<Looking> looking, const See& see) {
    const Scene& scene = rays.scene();
    std::vector<Ray> now;
    std::vector<Hit> hits;
    for (int layer = 0; layer < kMostLayers && !looking.empty(); ++layer) {
        now.clear();
        for (const Looking& l : looking) now.push_back(l.ray);
        hits.resize(now.size());
        rays.intersect_coherent(now, hits, RayKind::layers);

        std::size_t kept = 0;
        for (std::size_t i = 0; i < looking.size(); ++i) {
            if (!hits[i]) continue;
            Looking on = looking[i];
            const SurfacePoint& point = hits[i].point;
            const Mesh& mesh = scene.mesh_of(scene.objects[index_of(point.object)]);
            const MaterialId id = mesh.primitives[point.primitive].material;
            const Material& material = scene.material(id);
            const Seen at = {id, material, on.ray.origin + hits[i].t * on.ray.direction};
            float part = 0;
            if (hits[i].front || material.double_sided) {
                const bool blended = material.alpha_mode == AlphaMode::blend;
                part = on.part * (blended ? base_color(scene, hits[i].point).a : 1.0f);
                if (part > 0) see(on, hits[i], at, part);
            }
            on.part -= part;
            if (on.part < 1.0f / 512) continue;
            on.ray.t_min = hits[i].t * (1 + 4e-7f) + RayCaster::offset(at.position);
            looking[kept++] = on;
        }
        looking.resize(kept);
    }
}

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

    look(rays, std::move(looking),
         [&](const Looking& l, const Hit& hit, const Seen& at, float part) {
             row.pieces.push_back(
                 {l.x, hit.point, hit.front, seen_reflectance(scene, hit, aov, part)});
             const Material& m = at.material;
             if (aov == Aov::radiance && m.emissive())
                 row.background[l.x] += part * emission(scene, hit.point, hit.front);
             CentreHit& centre = centres[l.x];
             if (centre.object != ObjectId::none) return;
             centre = {hit.point.object,
                       at.id,
                       hit.normal,
                       at.position,
                       hit.t,
                       hit.point,
                       m.base_color_texture.used(),
                       m.emissive(),
                       m.see_through() || m.emission_texture.used()};
         });
    // Layers were seen one after the other; a pixel's pieces belong together.
    std::stable_sort(row.pieces.begin(), row.pieces.end(),
                     [](const SeenPiece& a, const SeenPiece& b) { return a.x < b.x; });
    return row;
}

void see_pixel(const RayCaster& rays, const View& view, int x, int y, int side, Aov aov,
               SeenRow& row) {
    // A rotated grid: as many different heights and widths as rays, so that edges near the axes are
    // smooth too.
    std::vector<Looking> looking(side * side);
    const auto n = static_cast<float>(side);
    for (int i = 0; i < side * side; ++i) {
        const auto a = static_cast<float>(i % side), b = static_cast<float>(i / side);
        const float sx = (a + (b + 0.5f) / n) / n;
        const float sy = (b + (a + 0.5f) / n) / n;
        looking[i] = {view.ray(static_cast<float>(x) + sx, static_cast<float>(y) + sy),
                      static_cast<std::uint32_t>(x), 1 / (n * n)};
    }
    const Scene& scene = rays.scene();
    const std::size_t first = row.pieces.size();
    std::vector<float> weights;
    Rgb background(0);
    look(rays, std::move(looking),
         [&](const Looking& l, const Hit& hit, const Seen& at, float part) {
             add_piece(row.pieces, weights, first,
                       {l.x, hit.point, hit.front, seen_reflectance(scene, hit, aov, part)}, part);
             if (aov == Aov::radiance && at.material.emissive())
                 background += part * emission(scene, hit.point, hit.front);
         });
    row.background[x] = background;
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
