#include "scene/area_lights.h"

namespace chiaro {
namespace {

// By luminance, zero where a material is dark: a texture's mean is taken once. It is good enough to
// choose by, and never zero where the texture has any light at all.
std::vector<SurfaceWeight> luminances(const Scene& scene) {
    std::vector<SurfaceWeight> result(scene.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (material.emissive())
            result[i] = {choice_weight(mean_emission(scene, material)), material.emits_backward};
    }
    return result;
}

}  // namespace

AreaLights::AreaLights(const Scene& scene) : scene_(&scene), surfaces_(scene, luminances(scene)) {
    plain_.reserve(surfaces_.size());
    for (std::uint32_t i = 0; i < surfaces_.size(); ++i) {
        const SurfacePoint& where = surfaces_.where(i);
        const Material& material = scene.material(material_of(scene, where));
        plain_.push_back({!material.emission_texture.used() && !material.see_through(),
                          {emission(scene, where, false), emission(scene, where, true)}});
    }
}

Rgb AreaLights::varied_radiance(const AreaLightSample& sample, bool front) const {
    const Rgb radiance = emission(*scene_, sample.point, front);
    if (radiance == Rgb(0)) return radiance;
    return opacity(*scene_, sample.point) * radiance;
}

}  // namespace chiaro
