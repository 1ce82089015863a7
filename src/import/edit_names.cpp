#include "import/edit_names.h"

#include "import/fault.h"

#include <algorithm>

namespace chiaro {
namespace {

template <typename Id>
void sort_unique(std::vector<Id>& ids) {
    std::ranges::sort(ids);
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

EditNames::EditNames(const Scene& loaded) : nodes_(loaded.nodes) {
    for (std::size_t i = 0; i < loaded.objects.size(); ++i)
        objects_.emplace(loaded.objects[i].name, static_cast<ObjectId>(i));
    for (std::size_t i = 0; i < loaded.lights.size(); ++i)
        lights_.emplace(loaded.lights[i].name, static_cast<LightId>(i));
    for (std::size_t i = 0; i < loaded.materials.size(); ++i)
        materials_.emplace(loaded.materials[i].name, static_cast<MaterialId>(i));
}

NamedThings EditNames::things(const std::string& name) const {
    if (name.empty()) return {};  // nodes without a name have none
    if (const auto added = added_.find(name); added != added_.end()) return added->second;
    const auto exact = objects_.find(name);
    const ObjectId object = exact == objects_.end() ? ObjectId::none : exact->second;
    NamedThings found = below(name, object);
    if (object != ObjectId::none) found.objects.push_back(object);
    for (const auto& [other, id] : objects_)
        if (other.starts_with(name + "/")) found.objects.push_back(id);
    if (found.empty())
        for (const auto& [other, id] : objects_)
            if (other.ends_with("/" + name)) found.objects.push_back(id);
    sort_unique(found.objects);
    sort_unique(found.lights);
    return found;
}

// What hangs on nodes of that name, or on that of the object, and below them; parents come first.
NamedThings EditNames::below(const std::string& name, ObjectId object) const {
    NamedThings found;
    std::vector<bool> named(nodes_.size(), false);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const SceneNode& node = nodes_[i];
        const bool parent = node.parent != NodeId::none && named[index_of(node.parent)];
        const bool itself = object != ObjectId::none ? node.object == object : node.name == name;
        named[i] = parent || itself;
        if (!named[i]) continue;
        if (node.object != ObjectId::none) found.objects.push_back(node.object);
        if (node.light != LightId::none) found.lights.push_back(node.light);
    }
    return found;
}

std::vector<LightId> EditNames::lights(const std::string& name) const {
    if (const auto exact = lights_.find(name); exact != lights_.end()) return {exact->second};
    return things(name).lights;
}

MaterialId EditNames::material(const std::string& name) const {
    const auto found = materials_.find(name);
    return found == materials_.end() ? MaterialId::none : found->second;
}

bool EditNames::taken(const std::string& name) const {
    return lights_.contains(name) || !things(name).empty();
}

void EditNames::add(const std::string& name, NamedThings things) {
    if (!things.objects.empty()) objects_.emplace(name, things.objects.front());
    if (!things.lights.empty()) lights_.emplace(name, things.lights.front());
    added_.emplace(name, std::move(things));
}

std::string EditNames::listed(std::span<const std::string> names) {
    constexpr std::size_t kMost = 20;
    if (names.empty()) return "there are none";
    std::string list;
    for (const std::string& name : names.first(std::min(names.size(), kMost)))
        list += (list.empty() ? "" : ", ") + printable(name, 60);
    return "there are " + list + (names.size() > kMost ? ", ..." : "");
}

}  // namespace chiaro
