#include "scene/scene.h"

#include "base/error.h"
#include "scene/bicubic_mesh.h"

#include <algorithm>
#include <optional>
#include <span>

namespace chiaro {
namespace {

// Twice the vector area of a triangle, in double: a sliver's is a small difference of large
// products.
glm::dvec3 cross_area(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return glm::cross(b - a, c - a);
}

// A triangle is flat when its height is below the rounding of its coordinates, or when the square
// of its area is lost in a float: it has no normal to shade with.
bool has_area(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const double longest_squared =
        std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    return glm::length(cross_area(a, b, c)) > std::max(1e-7 * longest_squared, 1e-18);
}

// A corner that stands where the one before it stands says nothing: without it the polygon is the
// same. Empty if fewer than three corners are left, or if two that are not neighbours meet.
std::optional<Primitive> without_repeated_corners(const Mesh& mesh, const Primitive& primitive) {
    Primitive kept = {.corners = {}, .material = primitive.material};
    kept.corners.fill(Primitive::kNoCorner);
    const int count = primitive.corner_count();
    int kept_count = 0;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t previous = primitive.corners[(i + count - 1) % count];
        const std::uint32_t corner = primitive.corners[i];
        if (mesh.positions[corner] != mesh.positions[previous]) kept.corners[kept_count++] = corner;
    }
    if (kept_count < 3) return std::nullopt;

    for (int i = 0; i < kept_count; ++i)
        for (int j = 0; j < i; ++j)
            if (mesh.positions[kept.corners[i]] == mesh.positions[kept.corners[j]])
                return std::nullopt;
    return kept;
}

bool has_area(const Mesh& mesh, const Primitive& primitive) {
    const auto corner = [&](int i) { return glm::dvec3(mesh.positions[primitive.corners[i]]); };
    if (!primitive.is_quad()) return has_area(corner(0), corner(1), corner(2));
    return has_area(corner(0), corner(1), corner(3)) || has_area(corner(2), corner(3), corner(1));
}

bool in_range(TextureId id, const Scene& scene) {
    return id == TextureId::none || index_of(id) < scene.textures.size();
}

bool all_finite(const Mat4& m) {
    float sum = 0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) sum += m[column][row];
    return sum - sum == 0.0f;
}

void check_primitive(const Scene& scene, const Mesh& mesh, std::size_t index) {
    const Primitive& primitive = mesh.primitives[index];
    check(primitive.is_quad() == (index < mesh.quad_count),
          "scene: quads must come first in a mesh");
    for (int i = 0; i < primitive.corner_count(); ++i)
        check(primitive.corners[i] < mesh.positions.size(), "scene: corner out of range");
    check(index_of(primitive.material) < scene.materials.size(), "scene: material out of range");
}

void check_texture(const Texture& texture) {
    check(texture.width > 0 && texture.height > 0, "scene: a texture is empty");
    check(texture.texels.size() == static_cast<std::size_t>(texture.width) * texture.height,
          "scene: a texture's size is not that of its texels");
}

void check_environment(const Environment& environment) {
    const auto sound = [](Rgb c) {
        return is_finite(c) && glm::all(glm::greaterThanEqual(c, Rgb(0)));
    };
    const Image& map = environment.map;
    check(sound(environment.sky), "scene: the sky is not finite or negative");
    check(map.width >= 0 && map.height >= 0 &&
              map.pixels.size() == static_cast<std::size_t>(map.width) * map.height,
          "scene: the environment's size is not that of its pixels");
    check(std::ranges::all_of(map.pixels, sound),
          "scene: the environment is not finite or negative");
}

void check_nodes(const Scene& scene) {
    const auto in_range = [](auto id, std::size_t size) {
        return id == decltype(id)::none || index_of(id) < size;
    };
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        check(in_range(node.parent, i), "scene: a node comes before its parent");
        check(in_range(node.object, scene.objects.size()) &&
                  in_range(node.light, scene.lights.size()) &&
                  in_range(node.camera, scene.cameras.size()),
              "scene: what hangs on a node is out of range");
    }
    for (const Animation& animation : scene.animations)
        for (const AnimationChannel& channel : animation.channels)
            check(index_of(channel.node) < scene.nodes.size(), "scene: animated node out of range");
}

// By material. A black texture makes an emissive one dark.
std::vector<Rgb> emissions(const Scene& scene) {
    std::vector<Rgb> result;
    for (const Material& material : scene.materials) {
        const TextureUse& use = material.emission_texture;
        const Rgb tint =
            material.emissive() && use.used() ? mean_color(scene.texture(use.texture)) : Rgb(1);
        result.push_back(material.emission * tint);
    }
    return result;
}

bool any_emits(const Scene& scene, const Object& object, std::span<const Rgb> emissions) {
    return std::ranges::any_of(scene.mesh_of(object).primitives, [&](const Primitive& primitive) {
        return max_component(emissions[index_of(primitive.material)] * object.emission_scale) > 0;
    });
}

}  // namespace

Box bounds(const Scene& scene) {
    Box box;
    for (const Object& object : scene.objects)
        if (object.shown) box.add(bounds(scene.mesh_of(object), object.to_world));
    return box;
}

Box bounds(const Mesh& mesh, const Mat4& to_world) {
    Box box;
    for (const BicubicPatch& patch : mesh.bicubics) box.add(hull(transformed(patch, to_world)));
    for (const Primitive& primitive : std::span(mesh.primitives).subspan(mesh.bicubics.size()))
        for (int i = 0; i < primitive.corner_count(); ++i)
            box.add(Vec3(to_world * Vec4(mesh.positions[primitive.corners[i]], 1)));
    return box;
}

bool emits(const Scene& scene, const Object& object) {
    return object.shown && any_emits(scene, object, emissions(scene));
}

bool has_light(const Scene& scene) {
    const std::vector<Rgb> known = emissions(scene);
    const auto shines = [&](const Object& object) {
        return object.shown && any_emits(scene, object, known);
    };
    return std::ranges::any_of(scene.lights, &PunctualLight::lit) ||
           std::ranges::any_of(scene.objects, shines) || !is_dark(scene.environment);
}

std::size_t order_primitives(Mesh& mesh) {
    std::size_t dropped = settle_bicubics(mesh);
    const auto first = mesh.primitives.begin() + static_cast<std::ptrdiff_t>(mesh.bicubics.size());
    std::vector<Primitive> quads(mesh.primitives.begin(), first);  // by their corners
    std::vector<Primitive> triangles;
    for (const Primitive& primitive : std::span(first, mesh.primitives.end())) {
        for (int i = 0; i < primitive.corner_count(); ++i)
            check(primitive.corners[i] < mesh.positions.size(),
                  "order_primitives: corner out of range");
        const std::optional<Primitive> clean = without_repeated_corners(mesh, primitive);
        if (!clean || !has_area(mesh, *clean)) continue;
        (clean->is_quad() ? quads : triangles).push_back(*clean);
    }
    dropped += mesh.primitives.size() - quads.size() - triangles.size();
    mesh.quad_count = static_cast<std::uint32_t>(quads.size());
    mesh.primitives = std::move(quads);
    mesh.primitives.insert(mesh.primitives.end(), triangles.begin(), triangles.end());
    return dropped;
}

void check_mesh(const Scene& scene, const Mesh& mesh) {
    const auto one_a_point = [&](const auto& array) {
        return array.empty() || array.size() == mesh.positions.size();
    };
    check(one_a_point(mesh.normals), "scene: a mesh needs a normal for each point, or none");
    check(one_a_point(mesh.uvs[0]) && one_a_point(mesh.uvs[1]),
          "scene: a mesh needs texture coordinates for each point, or none");
    check(one_a_point(mesh.colors), "scene: a mesh needs a colour for each point, or none");
    for (const Vec3 p : mesh.positions) check(is_finite(p), "scene: a point is not finite");
    for (const Vec3 n : mesh.normals) check(is_finite(n), "scene: a normal is not finite");
    for (const BicubicPatch& patch : mesh.bicubics)
        for (const Vec4& p : patch.points)
            check(is_finite(Vec3(p)) && p.w > 0 && p.w < kInfinity,
                  "scene: a control point is not finite");

    check(mesh.quad_count <= mesh.primitives.size(), "scene: quad_count out of range");
    check(mesh.bicubics.size() <= mesh.quad_count, "scene: bicubic patches come first in a mesh");
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) check_primitive(scene, mesh, i);
}

void check_object(const Scene& scene, const Object& object) {
    check(index_of(object.mesh) < scene.meshes.size(), "scene: mesh out of range");
    const Mat4& m = object.to_world;
    check(all_finite(m), "scene: to_world is not finite");
    check(m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1,
          "scene: to_world is not affine");
    check(glm::determinant(glm::dmat3(m)) != 0, "scene: to_world is singular");
    check(is_finite(object.emission_scale) &&
              glm::all(glm::greaterThanEqual(object.emission_scale, Rgb(0))),
          "scene: an emission scale is not finite or negative");
}

void check_material(const Scene& scene, const Material& material) {
    for (const TextureUse* use : {&material.base_color_texture, &material.emission_texture,
                                  &material.gloss.metallic_roughness}) {
        check(in_range(use->texture, scene), "scene: texture out of range");
        check(use->uv_set < 2, "scene: set of texture coordinates out of range");
    }
    check(is_finite(material.base_color), "scene: a base colour is not finite");
    check(is_finite(material.emission), "scene: an emission is not finite");
}

void check_camera(const Camera& camera) {
    check(is_finite(camera.eye) && is_finite(camera.target) && is_finite(camera.up),
          "scene: a camera is not finite");
    check(camera.vertical_fov > 0 && camera.vertical_fov < 180,
          "scene: field of view out of range");
}

void check_light(const PunctualLight& light) {
    check(is_finite(light.position) && is_finite(light.direction) && is_finite(light.intensity),
          "scene: a light is not finite");
}

void check_scene(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) check_mesh(scene, mesh);
    for (const Object& object : scene.objects) check_object(scene, object);
    for (const Material& material : scene.materials) check_material(scene, material);
    for (const Texture& texture : scene.textures) check_texture(texture);
    for (const Camera& camera : scene.cameras) check_camera(camera);
    for (const PunctualLight& light : scene.lights) check_light(light);
    check_nodes(scene);
    check_environment(scene.environment);
    check(is_finite(scene.up) && scene.up != Vec3(0), "scene: up is not a direction");
}

}  // namespace chiaro
