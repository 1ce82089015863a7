#include "image_generator/outlines.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// Of a pixel: an outline in less is not looked for. Lamps are brighter than that.
constexpr float kLeastSeen = 1.0f / 64;

// What the material alone tells.
CentreHit describe(const Scene& scene, const SurfacePoint& point) {
    CentreHit c;
    c.material = material_of(scene, point);
    c.point = point;
    const Material& m = scene.material(c.material);
    c.textured = m.base_color_texture.used() || m.gloss.metallic_roughness.used();
    c.emissive = m.emissive();
    c.intricate = m.see_through() || m.emission_texture.used();
    return c;
}

// Whether something shows in one pixel that has no counterpart in the other.
bool differs(std::span<const CentreHit> a, std::span<const CentreHit> b, float footprint) {
    for (const CentreHit& hit : a) {
        const CentreHit* other = find_trail(b, hit.trail);
        if (!other || outline_between(hit, *other, footprint)) return true;
    }
    return false;
}

}  // namespace

CentreRow make_centre_row(const Scene& scene, std::span<const Looking> looking,
                          std::span<const Sighting> sightings) {
    CentreRow row;
    row.hits.reserve(sightings.size());
    for (const Sighting& s : sightings) {
        if (by_chance(s.trail) || (s.trail == 0 && !s.hit)) continue;
        CentreHit c;
        if (s.hit)
            c = describe(scene, s.hit.point);
        else
            c.intricate = scene.environment.has_map();
        c.x = looking[s.looking].x;
        c.trail = s.trail;
        c.weight = luminance(s.weight);
        if (c.trail != 0 && c.weight < kLeastSeen && !c.emissive) continue;
        c.normal = s.hit.normal;
        c.position = s.position;
        c.distance = s.distance;
        c.intricate |= c.weight * s.by_chance >= kLeastSeen;
        row.hits.push_back(c);
    }
    const auto before = [](const CentreHit& a, const CentreHit& b) { return a.x < b.x; };
    if (!std::is_sorted(row.hits.begin(), row.hits.end(), before))
        std::stable_sort(row.hits.begin(), row.hits.end(), before);
    // The nearest of several layers stands for them.
    const auto same = [](const CentreHit& a, const CentreHit& b) {
        return a.x == b.x && a.trail == b.trail;
    };
    row.hits.erase(std::unique(row.hits.begin(), row.hits.end(), same), row.hits.end());

    auto next = row.hits.begin();
    for (std::uint32_t x = 0; x < looking.size(); ++x) {
        row.first.push_back(static_cast<std::uint32_t>(next - row.hits.begin()));
        while (next != row.hits.end() && next->x == x) ++next;
    }
    row.first.push_back(static_cast<std::uint32_t>(row.hits.size()));
    return row;
}

CentreHit centre_hit(const Scene& scene, const Ray& ray, const Hit& hit, std::uint32_t x) {
    CentreHit c;
    if (hit) c = describe(scene, hit.point);
    c.x = x;
    if (!hit) return c;
    c.normal = hit.normal;
    c.position = ray.origin + hit.t * ray.direction;
    c.distance = hit.t;
    return c;
}

const CentreHit* find_trail(std::span<const CentreHit> hits, Trail trail) {
    for (const CentreHit& hit : hits)
        if (hit.trail == trail) return &hit;
    return nullptr;
}

bool outline_between(const CentreHit& a, const CentreHit& b, float footprint) {
    const bool one = a.point.object == b.point.object && a.point.primitive == b.point.primitive;
    if (one && a.normal == b.normal) return false;
    if (a.point.object != b.point.object || a.material != b.material) return true;
    if (a.point.object == ObjectId::none) return false;
    if (glm::dot(a.normal, b.normal) < 0.98f) return true;
    // One surface, or two behind each other? The second point lies in the first's plane, or nearly.
    const float reach = 2 * footprint * std::max(a.distance, b.distance);
    const Vec3 between = b.position - a.position;
    return std::abs(glm::dot(between, a.normal)) > reach + 0.25f * glm::length(between);
}

bool needs_more_rays(std::span<const CentreRow> centres, int x, int y, float footprint) {
    const auto here = centres[y].at(x);
    for (const CentreHit& hit : here)
        if (hit.intricate) return true;
    const int height = static_cast<int>(centres.size());
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, centres[y].width() - 1); ++nx) {
            const auto there = centres[ny].at(nx);
            if (differs(here, there, footprint) || there.size() > here.size()) return true;
        }
    return false;
}

bool touches_light(std::span<const CentreRow> centres, int x, int y) {
    const int height = static_cast<int>(centres.size());
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, centres[y].width() - 1); ++nx)
            for (const CentreHit& hit : centres[ny].at(nx))
                if (hit.emissive) return true;
    return false;
}

Neighbours on_same_primitive(std::span<const CentreRow> centres, const CentreHit& here, int y) {
    const auto same = [&](int nx, int ny) -> const CentreHit* {
        if (ny < 0 || ny >= static_cast<int>(centres.size())) return nullptr;
        if (nx < 0 || nx >= centres[ny].width()) return nullptr;
        const CentreHit* there = find_trail(centres[ny].at(nx), here.trail);
        const bool one = there && there->point.object == here.point.object &&
                         there->point.primitive == here.point.primitive;
        return one ? there : nullptr;
    };
    const int x = static_cast<int>(here.x);
    Neighbours n{same(x + 1, y), same(x, y + 1)};
    if (!n.beside) n.beside = same(x - 1, y);
    if (!n.below) n.below = same(x, y - 1);
    return n;
}

}  // namespace chiaro
