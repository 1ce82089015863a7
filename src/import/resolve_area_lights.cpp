// How edits change lights that are surfaces.

#include "base/error.h"
#include "import/load_scene.h"
#include "import/resolve_edits.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace chiaro {
namespace {

// The turn that takes one unit vector to another by the shortest way.
Mat3 turn_between(Vec3 from, Vec3 to) {
    const double along = glm::dot(glm::dvec3(from), glm::dvec3(to));
    if (along < -0.999999) {
        const glm::dvec3 axis(Frame(from).s);
        return Mat3(glm::mat3_cast(glm::angleAxis(glm::pi<double>(), axis)));
    }
    const glm::dvec3 across = glm::cross(glm::dvec3(from), glm::dvec3(to));
    return Mat3(glm::mat3_cast(glm::normalize(glm::dquat(1 + along, across))));
}

}  // namespace

LampShape EditResolver::shape_of(const NamedThings& things) const {
    LampShape shape;
    for (const ObjectId id : things.objects) {
        const Object& object = objects_[index_of(id)];
        add_lamp(mesh_of(object), object.to_world, materials_in_file_, scene_, shape);
    }
    return shape;
}

std::vector<Edit> EditResolver::changed_area_light(const NamedThings& things,
                                                   const ChangeLight& edit) {
    if (edit.candela)
        throw Error(at("candela"), "this light has none",
                    "an area light has position, direction, size, nits, intensity_scale, color "
                    "and on");
    std::vector<Edit> edits;
    if (edit.position || edit.direction || edit.size) {
        Placement& placement = placement_of(edit.name, things);
        place_area_light(things, edit, placement);
        edits = placed(things, placement);
    }
    if (!(edit.nits || edit.intensity_scale || edit.color || edit.on)) return edits;
    for (const ObjectId id : things.objects) {
        const LampShape shape = shape_of({{id}, {}});
        if (shape.shines()) edits.push_back(changed_emission(id, shape.radiance(), edit));
    }
    return edits;
}

void EditResolver::place_area_light(const NamedThings& things, const ChangeLight& edit,
                                    Placement& placement) const {
    if (edit.position) placement.translate = *edit.position - placement.box.centre();
    if (!edit.direction && !edit.size) return;
    const LampShape shape = shape_of(things);
    const auto axes = axes_of(shape, scene_.up);
    if (!axes)
        throw Error(at(edit.direction ? "direction" : "size"),
                    "this light shines all round: it faces nowhere",
                    "use an edit of the \"object\", with rotate and scale");
    if (edit.direction)
        placement.turn = turn_between(axes->normal, glm::normalize(*edit.direction));
    if (!edit.size) return;
    const auto extent = [&](Vec3 along) {
        float low = kInfinity, high = -kInfinity;
        for (const ObjectId id : things.objects) {
            const Object& object = objects_[index_of(id)];
            add_extent(mesh_of(object), object.to_world, materials_in_file_, along, low, high);
        }
        return high - low;
    };
    const Mat3 frame(axes->width, axes->height, axes->normal);
    const Vec3 factors(edit.size->x / extent(axes->width), edit.size->y / extent(axes->height), 1);
    placement.stretch =
        frame * Mat3(factors.x, 0, 0, 0, factors.y, 0, 0, 0, 1) * glm::transpose(frame);
}

Edit EditResolver::changed_emission(ObjectId id, Rgb in_file, const ChangeLight& edit) {
    const auto [known, fresh] = area_brightness_.try_emplace(id);
    Brightness& brightness = known->second;
    if (fresh) brightness = {luminance(in_file), std::nullopt};
    if (edit.color) brightness.color = of_luminance_1(*edit.color);
    if (edit.nits) brightness.amount = *edit.nits;
    if (edit.intensity_scale) brightness.amount = *edit.intensity_scale * luminance(in_file);
    if (edit.on) brightness.on = *edit.on;
    if (!brightness.on) return SetEmission{id, Rgb(0)};

    const Rgb wanted = brightness.amount * brightness.color.value_or(of_luminance_1(in_file));
    check_brightness(wanted, "light");
    Rgb scale(0);
    for (int channel = 0; channel < 3; ++channel) {
        if (!(wanted[channel] > 0)) continue;
        scale[channel] = wanted[channel] / in_file[channel];
        if (!(scale[channel] <= kBrightest))
            throw Error(at("color"), "the light emits nothing of one of its channels in the file",
                        "give the file's light some of every channel");
    }
    return SetEmission{id, scale};
}

// A quad about the origin, put in its place: its width level, as far as it can be.
std::vector<Edit> EditResolver::add_area_light(const NewLight& edit, Rgb radiance, Vec3 direction) {
    const Vec3 up = glm::normalize(scene_.up);
    const Vec3 across = glm::cross(up, direction);
    const Vec3 x = std::abs(up.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const bool level = !(glm::length(across) > 1e-3f);
    const Vec3 width = glm::normalize(level ? x - glm::dot(x, direction) * direction : across);
    const Vec3 height = glm::cross(direction, width);
    const Vec3 u = 0.5f * edit.size.x * width, v = 0.5f * edit.size.y * height;

    Material material;
    material.name = edit.light.name;
    for (int i = 2; names_.material(material.name) != MaterialId::none; ++i)
        material.name = edit.light.name + "." + std::to_string(i);
    material.base_color = Rgb(0);
    material.emission = radiance;
    Mesh mesh;
    mesh.name = edit.light.name;
    mesh.positions = {-u - v, u - v, u + v, -u + v};
    mesh.primitives = {{{0, 1, 2, 3}, MaterialId(0)}};
    mesh.quad_count = 1;
    Object object;
    object.name = edit.light.name;
    object.to_world[3] = Vec4(*edit.light.position, 1);
    Edit added = AddObject{object, mesh, {material}};

    // What later edits of it find.
    const auto id = static_cast<MaterialId>(materials_.size());
    names_.add_material(material.name, id);
    materials_.push_back(material);
    materials_in_file_.push_back(material);
    mesh.primitives[0].material = id;
    object.mesh = static_cast<MeshId>(scene_.meshes.size() + new_meshes_.size());
    new_meshes_.push_back(std::move(mesh));
    names_.add(object.name, {{add(object)}, {}});
    return {std::move(added)};
}

}  // namespace chiaro
