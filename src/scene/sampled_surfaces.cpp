#include "scene/sampled_surfaces.h"

#include "base/error.h"
#include "scene/bicubic_mesh.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr std::uint32_t kNone = 0xffff'ffff;

// Uniform barycentric weights of a triangle's second and third corner.
Vec2 square_to_triangle(Vec2 place) {
    const float root = std::sqrt(place.x);
    return {root * (1 - place.y), root * place.y};
}

// Area for (u, v) at a place of a patch.
float stretch_at(const BicubicPatch& patch, Vec2 uv) {
    const PatchPoint p = patch_point(patch, uv);
    return glm::length(glm::cross(p.du, p.dv));
}

}  // namespace

SampledSurfaces::SampledSurfaces(const Scene& scene, std::span<const SurfaceWeight> of_material)
    : SampledSurfaces(scene, [&](ObjectId object, std::uint32_t primitive) {
          return of_material[index_of(material_of(scene, {object, primitive}))];
      }) {}

SampledSurfaces::SampledSurfaces(const Scene& scene, const WeightOf& weight_of)
    : surface_of_(scene.objects.size()) {
    std::vector<LightBounds> bounds;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        if (scene.objects[o].mesh == MeshId::none || !scene.objects[o].shown) continue;
        const auto more = add_object(scene, static_cast<ObjectId>(o), weight_of);
        bounds.insert(bounds.end(), more.begin(), more.end());
    }

    // Sums in double, however many there are. Clusters get shares, which no unit can make too
    // large.
    std::vector<double> all;
    for (const LightBounds& b : bounds) {
        all.push_back((b.two_sided ? 2 : 1) * double(b.intensity));
        total_weight_ += all.back();
    }
    by_weight_ = WeightedChoice(all);
    for (LightBounds& b : bounds)
        b.intensity = static_cast<float>(b.intensity / (double(kPi) * total_weight_));
    clusters_ = LightClusters(bounds);
}

std::vector<LightBounds> SampledSurfaces::add_object(const Scene& scene, ObjectId object,
                                                     const WeightOf& weight_of) {
    std::vector<LightBounds> bounds;
    const auto& primitives = scene.mesh_of(scene.objects[index_of(object)]).primitives;
    for (std::uint32_t p = 0; p < primitives.size(); ++p) {
        const auto [weight, two_sided] = weight_of(object, p);
        if (!(weight > 0)) continue;
        const float area = primitive_area(scene, object, p);
        if (!(area > 0)) continue;

        std::vector<std::uint32_t>& surfaces = surface_of_[index_of(object)];
        if (surfaces.empty()) surfaces.assign(primitives.size(), kNone);
        surfaces[p] = static_cast<std::uint32_t>(surfaces_.size());
        surfaces_.push_back(make_surface(scene, {object, p, 0, 0}, area));
        bounds.push_back(bounds_of(surfaces_.back(), two_sided, weight * area));
    }
    return bounds;
}

SampledSurfaces::Surface SampledSurfaces::make_surface(const Scene& scene,
                                                       const SurfacePoint& where, float area) {
    const Object& object = scene.objects[index_of(where.object)];
    const Mesh& mesh = scene.mesh_of(object);
    const Primitive& primitive = mesh.primitives[where.primitive];
    const auto normal_at = [&](float uv) {
        return surface_geometry(scene, {where.object, where.primitive, uv, uv}).geometric_normal;
    };

    Surface surface;
    surface.where = where;
    if (is_bicubic(mesh, where.primitive)) {
        surface.curve = add_curve(mesh.bicubics[where.primitive], object.to_world);
        return surface;
    }
    surface.quad = primitive.is_quad();
    for (int c = 0; c < primitive.corner_count(); ++c)
        surface.corners[c] = Vec3(object.to_world * Vec4(mesh.positions[primitive.corners[c]], 1));
    surface.inverse_area = 1 / area;
    surface.normals[0] = normal_at(0.25f);
    if (!surface.quad) return surface;

    const auto& c = surface.corners;
    surface.normals[1] = normal_at(0.75f);
    const float first = 0.5f * glm::length(glm::cross(c[1] - c[0], c[3] - c[0]));
    surface.first_half = std::min(1.0f, first / area);
    const float skew = glm::length(c[0] - c[1] + c[2] - c[3]);
    surface.parallelogram = skew <= 1e-5f * glm::length(c[2] - c[0]);
    return surface;
}

std::uint32_t SampledSurfaces::add_curve(const BicubicPatch& patch, const Mat4& to_world) {
    const BicubicPatch world = transformed(patch, to_world);
    std::vector<double> areas;
    for (std::uint32_t j = 0; j < Curve::kAcross; ++j)
        for (std::uint32_t i = 0; i < Curve::kAcross; ++i) {
            // Never 0: a cell may have area where its middle has none.
            const Vec2 middle = (Vec2(i, j) + 0.5f) / static_cast<float>(Curve::kAcross);
            areas.push_back(stretch_at(world, middle) + 1e-3f * stretch_at(world, Vec2(0.5f)));
        }
    curves_.push_back({world, glm::determinant(Mat3(to_world)) < 0, WeightedChoice(areas)});
    return static_cast<std::uint32_t>(curves_.size() - 1);
}

LightBounds SampledSurfaces::bounds_of(const Surface& surface, bool two_sided,
                                       float intensity) const {
    LightBounds first;
    if (surface.curve != kFlat) {
        first.box = hull(curves_[surface.curve].patch);
        first.cone = kPi;  // it may face anywhere
        first.two_sided = two_sided;
        first.intensity = intensity;
        return first;
    }
    for (int c = 0; c < (surface.quad ? 4 : 3); ++c) first.box.add(surface.corners[c]);
    first.axis = surface.normals[0];
    first.two_sided = two_sided;
    first.intensity = intensity;
    if (!surface.quad) return first;
    LightBounds second = first;
    second.axis = surface.normals[1];
    LightBounds both = merge(first, second);
    both.intensity = intensity;
    return both;
}

std::optional<SurfaceSample> SampledSurfaces::sample(const LitPlace& place, float choice,
                                                     Vec2 spot) const {
    check(!surfaces_.empty(), "SampledSurfaces: nothing to sample");
    // One variable for every return, built where the caller gets it: a copy would cost as much as
    // the rest.
    std::optional<SurfaceSample> result;
    LightClusters::Choice chosen = {0, 1};
    if (surfaces_.size() > 1) {
        const auto found = clusters_.sample(place, choice);
        if (!found) return result;
        chosen = *found;
    }
    result.emplace();
    place_on(chosen.light, chosen.probability, spot, *result);
    return result;
}

SurfaceSample SampledSurfaces::sample_by_weight(float choice, Vec2 spot) const {
    const WeightedChoice::Choice chosen = by_weight_.choose(choice);
    SurfaceSample result;
    place_on(chosen.index, chosen.probability, spot, result);
    return result;
}

inline void SampledSurfaces::place_on(std::uint32_t surface, float probability, Vec2 spot,
                                      SurfaceSample& result) const {
    result.point = surfaces_[surface].where;
    result.surface = surface;
    if (const std::uint32_t curve = surfaces_[surface].curve; curve != kFlat) {
        place_on(curves_[curve], spot, result);
        result.pdf_area = probability * density_on(surface, result.point);
        return;
    }
    result.pdf_area = probability * surfaces_[surface].inverse_area;
    place_on(surfaces_[surface], spot, result);
}

// Evenly over (u, v) within a cell. Where the patch is no surface, as at poles, the density is
// infinite and the sample worth nothing.
void SampledSurfaces::place_on(const Curve& curve, Vec2 spot, SurfaceSample& result) {
    const WeightedChoice::Choice cell = curve.cells.choose(spot.x);
    const auto column = static_cast<float>(cell.index % Curve::kAcross);
    const auto row = static_cast<float>(cell.index / Curve::kAcross);
    const Vec2 uv = (Vec2(column + cell.rest, row + spot.y)) / static_cast<float>(Curve::kAcross);
    result.point.u = uv.x;
    result.point.v = uv.y;
    result.position = patch_position(curve.patch, uv);
    const Vec3 normal = patch_normal(curve.patch, uv);
    result.normal = curve.mirrored ? -normal : normal;
}

// Over area at a point, once its surface is chosen.
float SampledSurfaces::density_on(std::uint32_t surface, const SurfacePoint& point) const {
    const Surface& s = surfaces_[surface];
    if (s.curve == kFlat) return s.inverse_area;
    const Curve& curve = curves_[s.curve];
    const auto cell_of = [](float x) {
        return std::min(static_cast<std::uint32_t>(x * Curve::kAcross), Curve::kAcross - 1);
    };
    const float chance =
        curve.cells.probability(cell_of(point.v) * Curve::kAcross + cell_of(point.u));
    constexpr float kCells = Curve::kAcross * Curve::kAcross;
    return kCells * chance / std::max(stretch_at(curve.patch, {point.u, point.v}), 1e-30f);
}

// Evenly over the surface's area.
inline void SampledSurfaces::place_on(const Surface& surface, Vec2 spot, SurfaceSample& result) {
    // The (u, v) of the primitive. Where half a quad was chosen first, the number used is spread
    // again.
    Vec2 uv;
    if (!surface.quad) {
        uv = square_to_triangle(spot);
    } else if (surface.parallelogram) {
        uv = spot;
    } else if (spot.x < surface.first_half) {
        uv = square_to_triangle({spot.x / surface.first_half, spot.y});
    } else {
        const float rest = (spot.x - surface.first_half) / (1 - surface.first_half);
        uv = Vec2(1) - square_to_triangle({std::min(rest, 1.0f), spot.y});
    }
    result.point.u = uv.x;
    result.point.v = uv.y;

    // The position, on the half that (u, v) lies in (scene/surface.h).
    const auto& c = surface.corners;
    const bool second = surface.quad && uv.x + uv.y > 1;
    result.normal = surface.normals[second];
    if (!surface.quad)
        result.position = c[0] + uv.x * (c[1] - c[0]) + uv.y * (c[2] - c[0]);
    else if (!second)
        result.position = c[0] + uv.x * (c[1] - c[0]) + uv.y * (c[3] - c[0]);
    else
        result.position = c[2] + (1 - uv.x) * (c[3] - c[2]) + (1 - uv.y) * (c[1] - c[2]);
}

std::optional<std::uint32_t> SampledSurfaces::surface_at(ObjectId object,
                                                         std::uint32_t primitive) const {
    const std::vector<std::uint32_t>& surfaces = surface_of_[index_of(object)];
    if (surfaces.empty() || surfaces[primitive] == kNone) return std::nullopt;
    return surfaces[primitive];
}

float SampledSurfaces::pdf(const LitPlace& place, const SurfacePoint& point) const {
    const auto surface = surface_at(point.object, point.primitive);
    return surface ? clusters_.pdf(place, *surface) * density_on(*surface, point) : 0.0f;
}

float SampledSurfaces::pdf_by_weight(const SurfacePoint& point) const {
    const auto surface = surface_at(point.object, point.primitive);
    return surface ? by_weight_.probability(*surface) * density_on(*surface, point) : 0.0f;
}

}  // namespace chiaro
