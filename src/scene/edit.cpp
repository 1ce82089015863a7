#include "scene/edit.h"

#include "base/error.h"
#include "scene/bsdf.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace chiaro {
namespace {

auto& at(auto& values, auto id, const char* otherwise) {
    check(index_of(id) < values.size(), otherwise);
    return values[index_of(id)];
}

// Of what an edit names; `scene` may be const.
auto& object_at(auto& scene, ObjectId id) {
    return at(scene.objects, id, "apply: object out of range");
}
auto& light_at(auto& scene, LightId id) {
    return at(scene.lights, id, "apply: light out of range");
}
auto& material_at(auto& scene, MaterialId id) {
    return at(scene.materials, id, "apply: material out of range");
}

struct Apply {
    Scene& scene;
    Camera& camera;

    Edit operator()(const SetCamera& edit) const {
        check_camera(edit.camera);
        return SetCamera{std::exchange(camera, edit.camera)};
    }
    Edit operator()(const SetTransform& edit) const {
        Object changed = object_at(scene, edit.object);
        changed.to_world = edit.to_world;
        check_object(scene, changed);
        Object& object = object_at(scene, edit.object);
        return SetTransform{edit.object, std::exchange(object.to_world, edit.to_world)};
    }
    Edit operator()(const SetShown& edit) const {
        return SetShown{edit.object,
                        std::exchange(object_at(scene, edit.object).shown, edit.shown)};
    }
    Edit operator()(const SetEmission& edit) const {
        Object changed = object_at(scene, edit.object);
        changed.emission_scale = edit.scale;
        check_object(scene, changed);
        Object& object = object_at(scene, edit.object);
        return SetEmission{edit.object, std::exchange(object.emission_scale, edit.scale)};
    }
    Edit operator()(const SetLight& edit) const {
        check_light(edit.value);
        return SetLight{edit.light, std::exchange(light_at(scene, edit.light), edit.value)};
    }
    Edit operator()(const SetMaterial& edit) const {
        check_material(scene, edit.value);
        return SetMaterial{edit.material,
                           std::exchange(material_at(scene, edit.material), edit.value)};
    }
    Edit operator()(const AddObject& edit) const {
        Object object = edit.object;
        if (edit.mesh) object.mesh = add_mesh(*edit.mesh, edit.materials);
        check_object(scene, object);
        scene.objects.push_back(object);
        return SetShown{static_cast<ObjectId>(scene.objects.size() - 1), false};
    }
    Edit operator()(const AddLight& edit) const {
        check_light(edit.light);
        scene.lights.push_back(edit.light);
        SetLight undo = {static_cast<LightId>(scene.lights.size() - 1), edit.light};
        undo.value.on = false;
        return undo;
    }

private:
    MeshId add_mesh(Mesh mesh, const std::vector<Material>& materials) const {
        const std::size_t first = scene.materials.size();
        for (const Material& material : materials) {
            check_material(scene, material);
            scene.materials.push_back(material);
        }
        if (!materials.empty())
            for (Primitive& primitive : mesh.primitives)
                primitive.material = static_cast<MaterialId>(first + index_of(primitive.material));
        check_mesh(scene, mesh);
        scene.meshes.push_back(std::move(mesh));
        return static_cast<MeshId>(scene.meshes.size() - 1);
    }
};

struct ChangesNothing {
    const Scene& scene;
    const Camera& camera;

    bool operator()(const SetCamera& edit) const { return edit.camera == camera; }
    bool operator()(const SetTransform& edit) const {
        return object_at(scene, edit.object).to_world == edit.to_world;
    }
    bool operator()(const SetShown& edit) const {
        return object_at(scene, edit.object).shown == edit.shown;
    }
    bool operator()(const SetEmission& edit) const {
        return object_at(scene, edit.object).emission_scale == edit.scale;
    }
    bool operator()(const SetLight& edit) const {
        return light_at(scene, edit.light) == edit.value;
    }
    bool operator()(const SetMaterial& edit) const {
        return material_at(scene, edit.material) == edit.value;
    }
    bool operator()(const AddObject&) const { return false; }
    bool operator()(const AddLight&) const { return false; }
};

// Whether a change of the material may change which rays go on at it.
bool stops_otherwise(const Material& a, const Material& b) {
    const auto key = [](const Material& m) {
        const Gloss& g = m.gloss;
        const bool glass = g.model != GlossModel::none && g.transmission > 0;
        return std::tuple(m.alpha_mode, m.double_sided, glass, glass && g.thin);
    };
    return key(a) != key(b);
}

// Whether it may change how much of the light gets through that goes on straight: by holes, or as
// through a pane, whose tint is in the base colour or beside it.
bool passes_otherwise(const Material& a, const Material& b) {
    const auto holes = [](const Material& m) {
        return std::tuple(m.alpha_mode, m.alpha, m.alpha_cutoff, m.base_color_texture);
    };
    const auto pane = [](const Material& m) {
        return std::tuple(m.base_color, m.base_color_texture, m.gloss);
    };
    return ((a.see_through() || b.see_through()) && holes(a) != holes(b)) ||
           ((may_pass_straight(a) || may_pass_straight(b)) && pane(a) != pane(b));
}

struct Effect {
    const Scene& scene;

    EditEffect operator()(const SetCamera&) const { return {.camera = true}; }
    EditEffect operator()(const SetTransform& edit) const {
        Object after = scene.objects[index_of(edit.object)];
        after.to_world = edit.to_world;
        return of_object(edit.object, after, true);
    }
    EditEffect operator()(const SetShown& edit) const {
        Object after = scene.objects[index_of(edit.object)];
        after.shown = edit.shown;
        return of_object(edit.object, after, true);
    }
    EditEffect operator()(const SetEmission& edit) const {
        Object after = scene.objects[index_of(edit.object)];
        after.emission_scale = edit.scale;
        return of_object(edit.object, after, false);
    }
    EditEffect operator()(const SetLight& edit) const {
        const bool dark = !scene.lights[index_of(edit.light)].lit() && !edit.value.lit();
        return {.lights = !dark, .light = edit.light};
    }
    EditEffect operator()(const SetMaterial& edit) const {
        const Material& before = scene.material(edit.material);
        const bool shines = before.emissive() || edit.value.emissive();
        return {.lights = shines,
                .geometry = stops_otherwise(before, edit.value),
                .passing = passes_otherwise(before, edit.value),
                .material = edit.material};
    }
    EditEffect operator()(const AddObject& edit) const {
        EditEffect effect;
        effect.object = static_cast<ObjectId>(scene.objects.size());
        effect.geometry = true;
        if (!edit.object.shown) return effect;
        const Mesh& mesh = edit.mesh ? *edit.mesh : scene.mesh_of(edit.object);
        effect.after = bounds(mesh, edit.object.to_world);
        effect.lights = edit.materials.empty()
                            ? std::ranges::any_of(mesh.primitives,
                                                  [&](const Primitive& p) {
                                                      return scene.material(p.material).emissive();
                                                  })
                            : std::ranges::any_of(edit.materials, &Material::emissive);
        return effect;
    }
    EditEffect operator()(const AddLight& edit) const {
        return {.lights = edit.light.lit(), .light = static_cast<LightId>(scene.lights.size())};
    }

private:
    EditEffect of_object(ObjectId id, const Object& after, bool geometry) const {
        const Object& before = scene.objects[index_of(id)];
        EditEffect effect = {.geometry = geometry, .object = id};
        effect.lights = emits(scene, before) || emits(scene, after);
        if (before.shown) effect.before = bounds(scene.mesh_of(before), before.to_world);
        if (after.shown) effect.after = bounds(scene.mesh_of(after), after.to_world);
        return effect;
    }
};

}  // namespace

Edit apply(Scene& scene, Camera& camera, const Edit& edit) {
    return std::visit(Apply{scene, camera}, edit);
}

bool changes_nothing(const Scene& scene, const Camera& camera, const Edit& edit) {
    return std::visit(ChangesNothing{scene, camera}, edit);
}

EditEffect effect_of(const Scene& scene, const Edit& edit) {
    return std::visit(Effect{scene}, edit);
}

}  // namespace chiaro
