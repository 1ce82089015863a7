// How edits change lights.

#include "base/error.h"
#include "import/fault.h"
#include "import/load_scene.h"
#include "import/resolve_edits.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace chiaro {
namespace {

const char* keys_of(LightKind kind) {
    switch (kind) {
        case LightKind::point:
            return "a point light has position, candela, intensity_scale, color and on";
        case LightKind::spot:
            return "a spot has position, direction, candela, intensity_scale, color and on";
        case LightKind::directional:
            break;
    }
    return "a directional light has direction, intensity_scale, color and on";
}

void check_keys(LightKind kind, const ChangeLight& edit, const std::string& where) {
    const auto refuse = [&](bool given, const char* key) {
        if (given) throw Error(where + "." + key, "this light has none", keys_of(kind));
    };
    refuse(edit.size.has_value(), "size");
    refuse(edit.nits.has_value(), "nits");
    refuse(kind == LightKind::point && edit.direction, "direction");
    refuse(kind == LightKind::directional && edit.position, "position");
    refuse(kind == LightKind::directional && edit.candela, "candela");
}

Rgb of_luminance_1(Rgb color) {
    return color / luminance(color);
}

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

std::vector<Edit> EditResolver::operator()(const ChangeLight& edit) {
    const std::vector<LightId> lamps = names_.lights(edit.name);
    if (lamps.empty()) {
        const NamedThings things = names_.things(edit.name);
        const auto emits = [&](ObjectId id) { return shape_of({{id}, {}}).shines(); };
        if (std::ranges::any_of(things.objects, emits)) return changed_area_light(things, edit);
        throw Error(at("light"),
                    things.empty() ? "there is no light \"" + printable(edit.name) + "\""
                                   : "the object \"" + printable(edit.name) + "\" does not shine",
                    "besides objects that shine " + names_.light_names());
    }
    Vec3 centre(0);
    for (const LightId id : lamps)
        centre += lights_in_file_[index_of(id)].position / static_cast<float>(lamps.size());
    std::vector<Edit> edits;
    for (const LightId id : lamps) {
        const Vec3 position = lights_in_file_[index_of(id)].position;
        const Vec3 beside = lamps.size() > 1 ? position - centre : Vec3(0);
        edits.push_back(changed_lamp(id, edit, beside));
    }
    return edits;
}

Edit EditResolver::changed_lamp(LightId id, const ChangeLight& edit, Vec3 beside) {
    PunctualLight& light = lights_[index_of(id)];
    check_keys(light.kind, edit, where_);
    if (edit.position) light.position = *edit.position + beside;
    if (edit.direction) light.direction = glm::normalize(*edit.direction);
    if (edit.on) light.on = *edit.on;

    const Rgb in_file = lights_in_file_[index_of(id)].intensity;
    const auto [known, fresh] = brightness_.try_emplace(id);
    Brightness& brightness = known->second;
    if (fresh) brightness = {luminance(in_file), std::nullopt};
    if (edit.color) brightness.color = of_luminance_1(*edit.color);
    if (edit.candela) brightness.amount = *edit.candela;
    if (edit.intensity_scale) brightness.amount = *edit.intensity_scale * luminance(in_file);
    const Rgb own = luminance(in_file) > 0 ? of_luminance_1(in_file) : Rgb(1);
    light.intensity = brightness.amount * brightness.color.value_or(own);
    check_brightness(light.intensity, "light");
    return SetLight{id, light};
}

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

void EditResolver::check_brightness(Rgb value, const char* key) const {
    if (!(max_component(value) <= kBrightest)) throw Error(at(key), "is brighter than 1e15");
}

std::vector<Edit> EditResolver::operator()(const NewLight& edit) {
    refuse_taken(edit.light.name, "add.light");
    const Rgb color = of_luminance_1(edit.light.color.value_or(Rgb(1)));
    const Rgb value = (edit.light.nits ? *edit.light.nits : *edit.light.candela) * color;
    check_brightness(value, "add.light");
    const Vec3 direction = glm::normalize(edit.light.direction.value_or(-scene_.up));
    if (edit.kind == NewLightKind::area) return add_area_light(edit, value, direction);

    PunctualLight light;
    light.name = edit.light.name;
    light.kind = edit.kind == NewLightKind::spot ? LightKind::spot : LightKind::point;
    light.intensity = value;
    light.position = *edit.light.position;
    light.direction = direction;
    light.inner_cone = glm::radians(edit.cone[0]);
    light.outer_cone = glm::radians(edit.cone[1]);
    names_.add(light.name, {{}, {add(light)}});
    return {AddLight{light}};
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
