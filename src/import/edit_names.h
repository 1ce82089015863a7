// What the names in an edit script stand for.
#pragma once

#include "scene/scene.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace chiaro {

/// Things that one name stands for, each once, in order.
struct NamedThings {
    std::vector<ObjectId> objects;
    std::vector<LightId> lights;

    bool empty() const { return objects.empty() && lights.empty(); }
};

/// The names of a scene, and those that edits add.
class EditNames {
public:
    /// Keeps a reference to the scene's nodes, which must not change.
    explicit EditNames(const Scene& loaded);

    /// The objects of that name, all that hangs on nodes of that name or of theirs (glTF), and the
    /// objects "name/..." (groups of an OBJ object); if there are none, the objects ".../name".
    NamedThings things(const std::string& name) const;
    /// The light of that name, or those that hang on nodes of that name.
    std::vector<LightId> lights(const std::string& name) const;
    /// None if there is none.
    MaterialId material(const std::string& name) const;

    bool taken(const std::string& name) const;
    void add(const std::string& name, NamedThings things);
    void add_material(const std::string& name, MaterialId id) { materials_.emplace(name, id); }

    /// "there are A, B", as the remedy of a message.
    std::string object_names() const { return listed(names_of(objects_)); }
    std::string material_names() const { return listed(names_of(materials_)); }
    /// Of lights, and of the objects that `shines(ObjectId)` says to be some.
    template <typename Shines>
    std::string light_names(const Shines& shines) const {
        std::vector<std::string> names = names_of(lights_);
        for (const auto& [name, id] : objects_)
            if (shines(id)) names.push_back(name);
        return listed(names);
    }

private:
    template <typename Id>
    static std::vector<std::string> names_of(const std::map<std::string, Id>& ids) {
        std::vector<std::string> names;
        for (const auto& [name, id] : ids) names.push_back(name);
        return names;
    }
    static std::string listed(std::span<const std::string> names);
    NamedThings below(const std::string& name, ObjectId object) const;

    const std::vector<SceneNode>& nodes_;
    std::map<std::string, ObjectId> objects_;
    std::map<std::string, LightId> lights_;
    std::map<std::string, MaterialId> materials_;
    std::map<std::string, NamedThings> added_;
};

}  // namespace chiaro
