#include "scene/area_lights.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr std::uint32_t kDark = 0xffff'ffff;

// Luminance of each material's lit sides, zero where it is dark: a texture's mean is taken once. It
// is good enough to choose by, and never zero where the texture has any light at all.
std::vector<float> luminances(const Scene& scene) {
    std::vector<float> result(scene.materials.size(), 0.0f);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (material.emissive()) result[i] = choice_weight(mean_emission(scene, material));
    }
    return result;
}

// Uniform barycentric weights of a triangle's second and third corner.
Vec2 square_to_triangle(Vec2 place) {
    const float root = std::sqrt(place.x);
    return {root * (1 - place.y), root * place.y};
}

}  // namespace

AreaLights::AreaLights(const Scene& scene) : scene_(&scene), light_of_(scene.objects.size()) {
    const std::vector<float> luminance_of = luminances(scene);
    std::vector<LightBounds> bounds;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        if (scene.objects[o].mesh == MeshId::none) continue;
        const auto more = add_object(static_cast<ObjectId>(o), luminance_of);
        bounds.insert(bounds.end(), more.begin(), more.end());
    }

    // Sums in double, however many there are. Clusters get shares, which no unit can make too
    // large.
    double power = 0;
    for (const LightBounds& b : bounds)
        power += double(kPi) * (b.two_sided ? 2 : 1) * double(b.intensity);
    power_ = static_cast<float>(power);
    for (LightBounds& b : bounds) b.intensity = static_cast<float>(b.intensity / power);
    clusters_ = LightClusters(bounds);
}

std::vector<LightBounds> AreaLights::add_object(ObjectId object,
                                                const std::vector<float>& luminances) {
    std::vector<LightBounds> bounds;
    const auto& primitives = scene_->mesh_of(scene_->objects[index_of(object)]).primitives;
    for (std::uint32_t p = 0; p < primitives.size(); ++p) {
        const float luminance = luminances[index_of(primitives[p].material)];
        if (!(luminance > 0)) continue;
        const float area = primitive_area(*scene_, object, p);
        if (!(area > 0)) continue;

        std::vector<std::uint32_t>& lights = light_of_[index_of(object)];
        if (lights.empty()) lights.assign(primitives.size(), kDark);
        lights[p] = static_cast<std::uint32_t>(lights_.size());
        lights_.push_back(make_light(*scene_, {object, p, 0, 0}, area));
        const bool two_sided = scene_->material(primitives[p].material).emits_backward;
        bounds.push_back(bounds_of(lights_.back(), two_sided, luminance * area));
    }
    return bounds;
}

AreaLights::Light AreaLights::make_light(const Scene& scene, const SurfacePoint& where,
                                         float area) {
    const Object& object = scene.objects[index_of(where.object)];
    const Mesh& mesh = scene.mesh_of(object);
    const Primitive& primitive = mesh.primitives[where.primitive];
    const auto normal_at = [&](float uv) {
        return surface_geometry(scene, {where.object, where.primitive, uv, uv}).geometric_normal;
    };

    Light light;
    light.where = where;
    light.quad = primitive.is_quad();
    for (int c = 0; c < primitive.corner_count(); ++c)
        light.corners[c] = Vec3(object.to_world * Vec4(mesh.positions[primitive.corners[c]], 1));
    light.inverse_area = 1 / area;
    light.normals[0] = normal_at(0.25f);
    const Material& material = scene.material(primitive.material);
    light.plain = !material.emission_texture.used() && !material.see_through();
    light.radiance[0] = emission(scene, where, false);
    light.radiance[1] = emission(scene, where, true);
    if (!light.quad) return light;

    const auto& c = light.corners;
    light.normals[1] = normal_at(0.75f);
    const float first = 0.5f * glm::length(glm::cross(c[1] - c[0], c[3] - c[0]));
    light.first_half = std::min(1.0f, first / area);
    const float skew = glm::length(c[0] - c[1] + c[2] - c[3]);
    light.parallelogram = skew <= 1e-5f * glm::length(c[2] - c[0]);
    return light;
}

LightBounds AreaLights::bounds_of(const Light& light, bool two_sided, float intensity) {
    LightBounds first;
    for (int c = 0; c < (light.quad ? 4 : 3); ++c) first.box.add(light.corners[c]);
    first.axis = light.normals[0];
    first.two_sided = two_sided;
    first.intensity = intensity;
    if (!light.quad) return first;
    LightBounds second = first;
    second.axis = light.normals[1];
    LightBounds both = merge(first, second);
    both.intensity = intensity;
    return both;
}

Rgb AreaLights::eval(const AreaLightSample& sample, Vec3 direction) const {
    const bool front = glm::dot(sample.normal, direction) > 0;
    const Light& light = lights_[sample.light];
    if (light.plain) return light.radiance[front];
    const Rgb radiance = emission(*scene_, sample.point, front);
    if (radiance == Rgb(0)) return radiance;
    return opacity(*scene_, sample.point) * radiance;
}

std::optional<AreaLightSample> AreaLights::sample(const LitPlace& place, float choice,
                                                  Vec2 spot) const {
    check(!lights_.empty(), "AreaLights: nothing to sample");
    // One variable for every return, built where the caller gets it: a copy would cost as much as
    // the rest.
    std::optional<AreaLightSample> result;
    LightClusters::Choice chosen = {0, 1};
    if (lights_.size() > 1) {
        const auto found = clusters_.sample(place, choice);
        if (!found) return result;
        chosen = *found;
    }
    result.emplace();
    const Light& light = lights_[chosen.light];
    result->point = light.where;
    result->light = chosen.light;
    result->pdf_area = chosen.probability * light.inverse_area;
    place_on(light, spot, *result);
    return result;
}

// Evenly over the light's area.
inline void AreaLights::place_on(const Light& light, Vec2 spot, AreaLightSample& result) {
    // The (u, v) of the primitive. Where half a quad was chosen first, the number used is spread
    // again.
    Vec2 uv;
    if (!light.quad) {
        uv = square_to_triangle(spot);
    } else if (light.parallelogram) {
        uv = spot;
    } else if (spot.x < light.first_half) {
        uv = square_to_triangle({spot.x / light.first_half, spot.y});
    } else {
        const float rest = (spot.x - light.first_half) / (1 - light.first_half);
        uv = Vec2(1) - square_to_triangle({std::min(rest, 1.0f), spot.y});
    }
    result.point.u = uv.x;
    result.point.v = uv.y;

    // The position, on the half that (u, v) lies in (scene/surface.h).
    const auto& c = light.corners;
    const bool second = light.quad && uv.x + uv.y > 1;
    result.normal = light.normals[second];
    if (!light.quad)
        result.position = c[0] + uv.x * (c[1] - c[0]) + uv.y * (c[2] - c[0]);
    else if (!second)
        result.position = c[0] + uv.x * (c[1] - c[0]) + uv.y * (c[3] - c[0]);
    else
        result.position = c[2] + (1 - uv.x) * (c[3] - c[2]) + (1 - uv.y) * (c[1] - c[2]);
}

float AreaLights::pdf(const LitPlace& place, ObjectId object, std::uint32_t primitive) const {
    const std::vector<std::uint32_t>& lights = light_of_[index_of(object)];
    if (lights.empty() || lights[primitive] == kDark) return 0;
    const std::uint32_t light = lights[primitive];
    return clusters_.pdf(place, light) * lights_[light].inverse_area;
}

}  // namespace chiaro
