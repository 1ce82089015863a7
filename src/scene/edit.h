// Edits of a scene as values. Each sets an absolute state, so that applying one tells the edit that
// undoes it.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <variant>
#include <vector>

namespace chiaro {

struct SetCamera {
    Camera camera;
};
struct SetTransform {
    ObjectId object;
    Mat4 to_world;  // affine, finite, not singular
};
/// Removes an object, or brings it back.
struct SetShown {
    ObjectId object;
    bool shown;
};
struct SetEmission {
    ObjectId object;
    Rgb scale;  // of what its materials emit: Object::emission_scale
};
/// Its place, power, colour, kind, and whether it is on.
struct SetLight {
    LightId light;
    PunctualLight value;
};
struct SetMaterial {
    MaterialId material;
    Material value;
};

/// Appends an object, and before it what it needs that the scene does not have. Primitives of a new
/// `mesh` name its `materials` by their place in that list where it is not empty, else materials of
/// the scene; the mesh is in order (order_primitives). Without a new mesh `object.mesh` is one of
/// the scene's.
struct AddObject {
    Object object;
    std::optional<Mesh> mesh = std::nullopt;  // object.mesh is set to it
    std::vector<Material> materials = {};
};
struct AddLight {
    PunctualLight light;
};

/// One change. Nothing is ever erased and what is added stands at the end, so that ids stay valid
/// for ever: what is removed is hidden or switched off.
using Edit = std::variant<SetCamera, SetTransform, SetShown, SetEmission, SetLight, SetMaterial,
                          AddObject, AddLight>;

/// Makes the change and returns the one that takes it back; that of an addition hides what was
/// added or switches it off. Checks what scene.h promises: ids in range, places that are finite and
/// not singular.
Edit apply(Scene& scene, Camera& camera, const Edit& edit);

/// True if the edit sets what already is: there is nothing to follow. Checks: ids as apply().
bool changes_nothing(const Scene& scene, const Camera& camera, const Edit& edit);

/// What an edit may change of what is derived from the scene. Light lists (AreaLights, LitScene)
/// are to be made anew if `lights`; what knows where surfaces are and whether rays pass them, as
/// RayCaster and lists of mirrors, is to follow if `geometry`.
struct EditEffect {
    bool camera = false;
    bool lights = false;    // a light, or a surface that emits before or afterwards
    bool geometry = false;  // an object moved, came or went, or rays pass its material otherwise
    bool passing = false;   // another part of straight light gets through the material
    ObjectId object = ObjectId::none;        // that is changed or added
    MaterialId material = MaterialId::none;  // that is changed
    LightId light = LightId::none;           // that is changed or added
    std::optional<Box> before, after;  // world bounds of `object` where it was and will be shown
};

/// Of an edit that has not been applied to `scene` yet.
EditEffect effect_of(const Scene& scene, const Edit& edit);

}  // namespace chiaro
