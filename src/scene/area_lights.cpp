#include "scene/area_lights.h"

namespace chiaro {
namespace {

// By luminance, zero where a material is dark: a texture's mean is taken once. It is good enough to
// choose by, and never zero where the texture has any light at all.
SampledSurfaces emitting_surfaces(const Scene& scene) {
    std::vector<Rgb> means(scene.materials.size(), Rgb(0));
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].emissive()) means[i] = mean_emission(scene, scene.materials[i]);
    return SampledSurfaces(scene, [&](ObjectId object, std::uint32_t p) -> SurfaceWeight {
        const MaterialId material = material_of(scene, {object, p});
        const Rgb scale = scene.objects[index_of(object)].emission_scale;
        return {choice_weight(scale * means[index_of(material)]),
                scene.material(material).emits_backward};
    });
}

}  // namespace

AreaLights::AreaLights(const Scene& scene) : scene_(&scene), surfaces_(emitting_surfaces(scene)) {
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
