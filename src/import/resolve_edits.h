// From edits by name to edits of a scene.
#pragma once

#include "import/edit_names.h"
#include "import/lamp_shape.h"
#include "import/read_edits.h"
#include "scene/edit.h"

#include <map>
#include <string>
#include <vector>

namespace chiaro {

/// Looks names up and reckons what is relative to the scene as it was loaded. It remembers what it
/// was asked before, so that an edit that says nothing of a light's colour leaves the colour that
/// an earlier one gave: ask for all edits in their order, then apply what it answers in the same
/// order to the scene, which is not to be edited otherwise meanwhile.
class EditResolver {
public:
    /// Keeps a reference to the scene, which must stay as it was loaded while edits are resolved.
    /// `camera` is the one that edits of the camera change.
    EditResolver(const Scene& loaded, const Camera& camera);

    /// Throws an Error at a place in `where` for a name that is not there, a name that is taken, a
    /// key that its thing does not have, or a place or brightness that no scene may have.
    std::vector<Edit> resolve(const NamedEdit& edit, const std::string& where);

private:
    // Of what a name stands for, from its place in the file, about its centre there.
    struct Placement {
        Box box;  // in the file
        Vec3 translate = Vec3(0);
        Mat3 turn = Mat3(1);
        Mat3 stretch = Mat3(1);
        glm::dmat4 matrix() const;
    };
    // What edits said of a light.
    struct Brightness {
        float amount = 0;          // luminance of its radiance, intensity or irradiance
        std::optional<Rgb> color;  // of luminance 1; nothing: the file's
        bool on = true;
    };

    friend struct ResolveVisitor;
    std::vector<Edit> operator()(const ChangeObject& edit);
    std::vector<Edit> operator()(const ChangeLight& edit);
    std::vector<Edit> operator()(const ChangeCamera& edit);
    std::vector<Edit> operator()(const ChangeMaterial& edit);
    std::vector<Edit> operator()(const Remove& edit);
    std::vector<Edit> operator()(const NewLight& edit);
    std::vector<Edit> operator()(const CopyObject& edit);

    Box box_of(const NamedThings& things) const;
    Placement& placement_of(const std::string& name, const NamedThings& things);
    static void change(const PlaceChange& edit, Placement& placement);
    std::vector<Edit> placed(const NamedThings& things, const Placement& placement);
    void check_reach(const glm::dmat4& m, const Box& box) const;

    // `beside`: where the light is from the centre of those that are edited together.
    Edit changed_lamp(LightId id, const ChangeLight& edit, Vec3 beside);
    bool shines(ObjectId id) const { return shape_of({{id}, {}}).shines(); }
    std::string light_names() const;
    LampShape shape_of(const NamedThings& things) const;
    std::vector<Edit> changed_area_light(const NamedThings& things, const ChangeLight& edit);
    void place_area_light(const NamedThings& things, const ChangeLight& edit,
                          Placement& placement) const;
    Edit changed_emission(ObjectId id, Rgb in_file, const ChangeLight& edit);
    void check_brightness(Rgb value, const char* key) const;
    std::vector<Edit> add_area_light(const NewLight& edit, Rgb radiance, Vec3 direction);

    const Mesh& mesh_of(const Object& object) const;
    void refuse_taken(const std::string& name, const char* key) const;
    std::string free_name(const std::string& name) const;
    ObjectId add(const Object& object);
    LightId add(const PunctualLight& light);
    std::string at(const char* key) const { return where_ + "." + key; }

    const Scene& scene_;
    EditNames names_;
    Camera camera_;
    std::vector<Object> objects_;                // as in the file, or as they were added
    std::vector<PunctualLight> lights_in_file_;  // likewise
    std::vector<PunctualLight> lights_;          // as edited so far
    std::vector<Material> materials_in_file_, materials_;
    std::vector<Mesh> new_meshes_;
    std::map<std::string, Placement> placements_;
    std::map<ObjectId, Brightness> area_brightness_;
    std::map<LightId, Brightness> brightness_;
    std::size_t primitives_ = 0;  // of all objects
    std::string where_;           // of the edit that is being resolved
};

/// All edits of a script, in its order; what resolve() throws.
std::vector<Edit> resolve_edits(const EditScript& script, const Scene& loaded,
                                const Camera& camera);

}  // namespace chiaro
