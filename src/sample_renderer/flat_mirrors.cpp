#include "sample_renderer/flat_mirrors.h"

#include "scene/bsdf.h"

namespace chiaro {
namespace {

// What a file's texture of roughness makes smooth somewhere is not looked for.
bool reflects_smoothly(const Scene& scene, const SurfacePoint& middle) {
    const Bsdf b = bsdf_at(scene, middle, true);
    return b.smooth() && has_specular(b);
}

bool is_flat(const Scene& scene, const SurfacePoint& middle) {
    const SurfaceGeometry g = surface_geometry(scene, middle);
    return glm::dot(g.geometric_normal, g.shading_normal) > 0.999999f;
}

}  // namespace

std::vector<FlatMirror> find_flat_mirrors(const Scene& scene) {
    std::vector<FlatMirror> mirrors;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const Object& object = scene.objects[o];
        if (object.mesh == MeshId::none || !object.shown) continue;
        const Mesh& mesh = scene.mesh_of(object);
        const auto id = static_cast<ObjectId>(o);
        const auto flat_from = static_cast<std::uint32_t>(mesh.bicubics.size());
        for (std::uint32_t p = flat_from; p < mesh.primitives.size(); ++p) {
            const Primitive& primitive = mesh.primitives[p];
            if (scene.material(primitive.material).gloss.model == GlossModel::none) continue;
            const auto corner = [&](int c) {
                return Vec3(object.to_world * Vec4(mesh.positions[primitive.corners[c]], 1));
            };
            for (const bool second : {false, true}) {
                if (second && !primitive.is_quad()) continue;
                const float uv = second ? 0.75f : 0.25f;
                const SurfacePoint middle = {id, p, uv, uv};
                if (!reflects_smoothly(scene, middle) || !is_flat(scene, middle)) continue;
                const Vec3 start = corner(second ? 2 : 0);
                const Vec3 u = corner(second ? 3 : 1) - start;
                const Vec3 v = corner(second ? 1 : primitive.is_quad() ? 3 : 2) - start;
                const Vec3 normal = surface_geometry(scene, middle).geometric_normal;
                mirrors.push_back({id, p, second, start, u, v, normal});
            }
        }
    }
    return mirrors;
}

}  // namespace chiaro
