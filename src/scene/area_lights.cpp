#include "scene/area_lights.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr std::uint32_t kDark = 0xffff'ffff;

// A light's power is found from its texture's mean: good enough to choose by, and never zero where
// the texture has any light at all.
Rgb mean_emission(const Scene& scene, const Material& material) {
    if (!material.emission_texture.used()) return material.emission;
    return material.emission * mean_color(scene.texture(material.emission_texture.texture));
}

// Luminance alone would leave out a blue so deep that Y rounds to nothing.
float weight_of(Rgb color) {
    return luminance(color) + 1e-6f * max_component(color);
}

// Luminous exitance of each material, zero where it is dark: a texture's mean is taken once.
std::vector<float> exitances(const Scene& scene) {
    std::vector<float> result(scene.materials.size(), 0.0f);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (!material.emissive()) continue;
        const float sides = material.emits_backward ? 2.0f : 1.0f;
        result[i] = kPi * sides * weight_of(mean_emission(scene, material));
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
    const std::vector<float> exitance = exitances(scene);
    for (std::size_t o = 0; o < scene.objects.size(); ++o)
        if (scene.objects[o].mesh != MeshId::none) add_object(static_cast<ObjectId>(o), exitance);
    normalize();
}

void AreaLights::add_object(ObjectId object, const std::vector<float>& exitances) {
    const auto& primitives = scene_->mesh_of(scene_->objects[index_of(object)]).primitives;
    for (std::uint32_t p = 0; p < primitives.size(); ++p) {
        const float exitance = exitances[index_of(primitives[p].material)];
        if (!(exitance > 0)) continue;
        const float area = primitive_area(*scene_, object, p);
        if (!(area > 0)) continue;

        // Its share in the choice for now; normalize() divides by the power of all.
        Light light = make_light(*scene_, {object, p, 0, 0}, area);
        light.pdf_area = exitance;
        std::vector<std::uint32_t>& lights = light_of_[index_of(object)];
        if (lights.empty()) lights.assign(primitives.size(), kDark);
        lights[p] = static_cast<std::uint32_t>(lights_.size());
        lights_.push_back(light);
        cumulative_.push_back(area * exitance);
    }
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

void AreaLights::normalize() {
    // Sums in double: the last light must end at 1 however many there are.
    double sum = 0;
    for (const float power : cumulative_) sum += power;
    power_ = static_cast<float>(sum);
    double up_to = 0;
    for (float& entry : cumulative_) entry = static_cast<float>((up_to += entry) / sum);
    for (Light& light : lights_) light.pdf_area = static_cast<float>(light.pdf_area / sum);
}

Rgb AreaLights::eval(const AreaLightSample& sample, Vec3 direction) const {
    const bool front = glm::dot(sample.normal, direction) > 0;
    const Light& light = lights_[sample.light];
    if (light.plain) return light.radiance[front];
    const Rgb radiance = emission(*scene_, sample.point, front);
    if (radiance == Rgb(0)) return radiance;

    const Mesh& mesh = scene_->mesh_of(scene_->objects[index_of(sample.point.object)]);
    const Material& material = scene_->material(mesh.primitives[sample.point.primitive].material);
    if (!material.see_through()) return radiance;
    const float alpha = base_color(*scene_, sample.point).a;
    if (material.alpha_mode == AlphaMode::blend) return alpha * radiance;
    return alpha >= material.alpha_cutoff ? radiance : Rgb(0);
}

AreaLightSample AreaLights::sample(float choice, Vec2 place) const {
    check(!lights_.empty(), "AreaLights: nothing to sample");
    std::size_t index = 0;
    if (lights_.size() > 1) {
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), choice);
        index = std::min<std::size_t>(found - cumulative_.begin(), lights_.size() - 1);
    }
    const Light& light = lights_[index];

    AreaLightSample result;
    result.point = light.where;
    result.pdf_area = light.pdf_area;
    result.light = static_cast<std::uint32_t>(index);

    // The (u, v) of the primitive. Where half a quad was chosen first, the number used is spread
    // again.
    Vec2 uv;
    if (!light.quad) {
        uv = square_to_triangle(place);
    } else if (light.parallelogram) {
        uv = place;
    } else if (place.x < light.first_half) {
        uv = square_to_triangle({place.x / light.first_half, place.y});
    } else {
        const float rest = (place.x - light.first_half) / (1 - light.first_half);
        uv = Vec2(1) - square_to_triangle({std::min(rest, 1.0f), place.y});
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
    return result;
}

float AreaLights::pdf(ObjectId object, std::uint32_t primitive) const {
    const std::vector<std::uint32_t>& lights = light_of_[index_of(object)];
    if (lights.empty() || lights[primitive] == kDark) return 0;
    return lights_[lights[primitive]].pdf_area;
}

}  // namespace chiaro
