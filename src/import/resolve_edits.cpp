#include "import/resolve_edits.h"

#include "base/error.h"
#include "import/fault.h"

#include <fmt/format.h>

#include <algorithm>

namespace chiaro {
namespace {

std::string quoted(const std::string& name) {
    return "\"" + printable(name) + "\"";
}

// A surface without gloss gets the varnish that glTF's materials have. MTL's exponents stand for
// facets as rough as alpha = sqrt(2 / (Ns + 2)) (scene/bsdf_at.cpp).
void set_roughness(Material& material, float roughness) {
    Gloss& gloss = material.gloss;
    const bool shiny_mtl = gloss.model == GlossModel::phong && gloss.illumination_model >= 2 &&
                           max_component(gloss.specular) > 0;
    if (shiny_mtl) {
        const float alpha = std::max(roughness * roughness, 1e-3f);
        gloss.shininess = std::max(2 / (alpha * alpha) - 2, 1e-3f);
        return;
    }
    if (gloss.model != GlossModel::metallic_roughness)
        gloss = {.model = GlossModel::metallic_roughness, .metallic = 0};
    gloss.roughness = roughness;
}

}  // namespace

struct ResolveVisitor {
    EditResolver& resolver;
    template <typename T>
    std::vector<Edit> operator()(const T& edit) const {
        return resolver(edit);
    }
};

EditResolver::EditResolver(const Scene& loaded, const Camera& camera)
    : scene_(loaded),
      names_(loaded),
      camera_(camera),
      objects_(loaded.objects),
      lights_in_file_(loaded.lights),
      lights_(loaded.lights),
      materials_in_file_(loaded.materials),
      materials_(loaded.materials) {
    for (const Object& object : objects_) primitives_ += mesh_of(object).primitives.size();
}

std::vector<Edit> EditResolver::resolve(const NamedEdit& edit, const std::string& where) {
    where_ = where;
    return std::visit(ResolveVisitor{*this}, edit);
}

const Mesh& EditResolver::mesh_of(const Object& object) const {
    const std::size_t mesh = index_of(object.mesh);
    return mesh < scene_.meshes.size() ? scene_.meshes[mesh]
                                       : new_meshes_[mesh - scene_.meshes.size()];
}

std::vector<Edit> EditResolver::operator()(const ChangeObject& edit) {
    const NamedThings things = names_.things(edit.name);
    if (things.empty())
        throw Error(at("object"), "there is no object " + quoted(edit.name), names_.object_names());
    Placement& placement = placement_of(edit.name, things);
    change(edit.place, placement);
    return placed(things, placement);
}

std::vector<Edit> EditResolver::operator()(const ChangeCamera& edit) {
    if (edit.eye) camera_.eye = *edit.eye;
    if (edit.target) camera_.target = *edit.target;
    if (edit.up) camera_.up = glm::normalize(*edit.up);
    if (edit.vertical_fov) camera_.vertical_fov = *edit.vertical_fov;
    const Vec3 forward = camera_.target - camera_.eye;
    if (!(glm::length(forward) > 0))
        throw Error(at("camera"), "its target is where its eye is", "move one of them");
    if (!(glm::length(glm::cross(forward, camera_.up)) > 1e-6f * glm::length(forward)))
        throw Error(at("camera"), "its line of sight is its vertical", "give another up");
    return {SetCamera{camera_}};
}

std::vector<Edit> EditResolver::operator()(const ChangeMaterial& edit) {
    const MaterialId id = names_.material(edit.name);
    if (id == MaterialId::none)
        throw Error(at("material"), "there is no material " + quoted(edit.name),
                    names_.material_names());
    Material& material = materials_[index_of(id)];
    if (edit.base_color) material.base_color = *edit.base_color;
    if (edit.roughness) set_roughness(material, *edit.roughness);
    if (edit.emission_scale) {
        material.emission = *edit.emission_scale * materials_in_file_[index_of(id)].emission;
        check_brightness(material.emission, "emission_scale");
    }
    return {SetMaterial{id, material}};
}

std::vector<Edit> EditResolver::operator()(const Remove& edit) {
    NamedThings things = names_.things(edit.name);
    const std::vector<LightId> lights = names_.lights(edit.name);
    things.lights.insert(things.lights.end(), lights.begin(), lights.end());
    if (things.empty())
        throw Error(at("remove"), "there is no object or light " + quoted(edit.name),
                    "of objects " + names_.object_names() + "; of lights " + light_names());
    std::vector<Edit> edits;
    for (const ObjectId id : things.objects) edits.emplace_back(SetShown{id, false});
    for (const LightId id : things.lights) {
        lights_[index_of(id)].on = false;
        edits.emplace_back(SetLight{id, lights_[index_of(id)]});
    }
    return edits;
}

std::vector<Edit> EditResolver::operator()(const CopyObject& edit) {
    refuse_taken(edit.name, "add.object");
    const NamedThings originals = names_.things(edit.original);
    if (originals.empty())
        throw Error(at("add.copy"), "there is no object " + quoted(edit.original),
                    names_.object_names());
    Placement placement = {box_of(originals)};
    change(edit.place, placement);

    const std::vector<PunctualLight> as_edited = lights_;
    std::vector<Edit> moves = placed(originals, placement);
    lights_ = as_edited;  // the originals stay where they are

    std::vector<Edit> edits;
    NamedThings copies;
    for (Edit& edit_of : moves) {
        const std::string name = edits.empty() ? edit.name : free_name(edit.name);
        if (const auto* there = std::get_if<SetTransform>(&edit_of)) {
            Object copy = objects_[index_of(there->object)];
            copy.name = name;
            copy.to_world = there->to_world;
            copies.objects.push_back(add(copy));
            if (!edits.empty()) names_.add(name, {{copies.objects.back()}, {}});
            edits.emplace_back(AddObject{copy});
        } else if (auto* light = std::get_if<SetLight>(&edit_of)) {
            light->value.name = name;
            copies.lights.push_back(add(light->value));
            if (!edits.empty()) names_.add(name, {{}, {copies.lights.back()}});
            edits.emplace_back(AddLight{light->value});
        }
    }
    names_.add(edit.name, std::move(copies));
    return edits;
}

// Of the second and further parts of a copy.
std::string EditResolver::free_name(const std::string& name) const {
    for (int i = 2;; ++i)
        if (std::string free = fmt::format("{}.{}", name, i); !names_.taken(free)) return free;
}

void EditResolver::refuse_taken(const std::string& name, const char* key) const {
    if (name.empty()) throw Error(at(key), "is an empty name");
    if (names_.taken(name))
        throw Error(at(key), "the name " + quoted(name) + " is taken", "choose another");
}

ObjectId EditResolver::add(const Object& object) {
    primitives_ += mesh_of(object).primitives.size();
    if (primitives_ > kMostPrimitives)
        throw Error(where_, fmt::format("makes more than {} polygons", kMostPrimitives));
    objects_.push_back(object);
    return static_cast<ObjectId>(objects_.size() - 1);
}

LightId EditResolver::add(const PunctualLight& light) {
    lights_in_file_.push_back(light);
    lights_.push_back(light);
    return static_cast<LightId>(lights_.size() - 1);
}

std::vector<Edit> resolve_edits(const EditScript& script, const Scene& loaded,
                                const Camera& camera) {
    EditResolver resolver(loaded, camera);
    std::vector<Edit> edits;
    for (const TimedEdit& timed : script.edits)
        for (Edit& edit : resolver.resolve(timed.edit, timed.where))
            edits.push_back(std::move(edit));
    return edits;
}

}  // namespace chiaro
