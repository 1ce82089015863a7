#include "import/gltf_check.h"

#include "import/fault.h"
#include "import/gltf_rules.h"
#include "import/json_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

namespace chiaro {
namespace {

using Json = nlohmann::json;

constexpr double kEighthTurn = 0.7853981633974483;  // KHR_lights_punctual's outerConeAngle
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

constexpr std::array kSupported = {
    "KHR_lights_punctual",    "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_specular", "KHR_materials_transmission",      "KHR_mesh_quantization",
    "KHR_texture_transform",
};

void check_number(const Json& value, double low, double high, const std::string& file,
                  const JsonPlace& place) {
    if (!value.is_number()) refuse(file, place, "is not a number");
    const double number = value.get<double>();
    const double largest = std::numeric_limits<float>::max();
    if (!(std::abs(number) <= largest)) refuse(file, place, "is not a number that a float holds");
    if (number < low || number > high)
        refuse(file, place, fmt::format("{:g} is out of range", number));
}

void check_numbers(const Json& value, double count, const std::string& file,
                   const JsonPlace& place) {
    if (!value.is_array() || static_cast<double>(value.size()) != count)
        refuse(file, place, fmt::format("is not an array of {:g} numbers", count));
    for (std::size_t i = 0; i < value.size(); ++i)
        check_number(value[i], -kUnbounded, kUnbounded, file, {&place, {}, i});
}

void check_integer(const Json& value, double low, double high, const std::string& file,
                   const JsonPlace& place) {
    if (!value.is_number_integer()) refuse(file, place, "is not an integer");
    const double number = value.get<double>();
    if (number < low || number > high)
        refuse(file, place, fmt::format("{} is out of range", value.dump()));
}

void check_size(const Json& value, double least, const std::string& file, const JsonPlace& place) {
    if (static_cast<double>(value.size()) < least) refuse(file, place, "is empty");
}

// How many elements the array has that an index counts in; 0 if there is no such array.
std::size_t target_size(const Json& root, const char* pattern, const std::string& file) {
    std::size_t size = 0;
    visit_json(root, pattern, file, [&](const Json* value, const JsonPlace&) {
        if (value != nullptr && value->is_array()) size = value->size();
    });
    return size;
}

void check_rule(const Json& root, const GltfRule& rule, const std::string& file) {
    const std::size_t count = rule.target == nullptr ? 0 : target_size(root, rule.target, file);
    visit_json(root, rule.pattern, file, [&](const Json* value, const JsonPlace& place) {
        if (value == nullptr) {
            if (rule.required) refuse(file, place, "is missing");
            return;
        }
        switch (rule.kind) {
            case JsonKind::object:
                if (!value->is_object()) refuse(file, place, "is not an object");
                return check_size(*value, rule.low, file, place);
            case JsonKind::array:
                if (!value->is_array()) refuse(file, place, "is not an array");
                return check_size(*value, rule.low, file, place);
            case JsonKind::string:
                if (!value->is_string()) refuse(file, place, "is not a string");
                return;
            case JsonKind::boolean:
                if (!value->is_boolean()) refuse(file, place, "is not true or false");
                return;
            case JsonKind::integer:
                return check_integer(*value, rule.low, rule.high, file, place);
            case JsonKind::number:
                return check_number(*value, rule.low, rule.high, file, place);
            case JsonKind::numbers:
                return check_numbers(*value, rule.high, file, place);
            case JsonKind::index:
                if (!value->is_number_integer() || value->get<double>() < 0)
                    refuse(file, place, "is not an index");
                if (value->get<double>() >= static_cast<double>(count))
                    refuse(file, place,
                           fmt::format("{} names one that is not there ({} are)", value->dump(),
                                       count));
        }
    });
}

void check_version(const Json& asset, const std::string& file) {
    for (const char* key : {"version", "minVersion"}) {
        if (!asset.contains(key)) continue;
        const auto version = asset[key].get<std::string>();
        const bool supported =
            std::string_view(key) == "version" ? version.starts_with("2.") : version == "2.0";
        if (!supported)
            throw Error(fmt::format("{}: asset.{}", file, key),
                        fmt::format("version \"{}\" of glTF is not supported", printable(version)),
                        "export the scene as glTF 2.0");
    }
}

void check_required_extensions(const Json& root, const std::string& file) {
    if (!root.contains("extensionsRequired")) return;
    const Json listed = root.value("extensionsUsed", Json::array());
    const std::set<Json> used(listed.begin(), listed.end());
    for (const Json& extension : root["extensionsRequired"]) {
        const auto name = extension.get<std::string>();
        if (!is_supported_extension(name))
            throw Error(file + ": extensionsRequired",
                        fmt::format("the extension {} is not supported", printable(name)),
                        "export the scene without it");
        if (!used.contains(extension))
            throw Error(file + ": extensionsRequired",
                        fmt::format("{} is not in extensionsUsed", name));
    }
}

// Where the extensions of Khronos belong; those of others may stand anywhere.
bool may_extend(const std::string& extension, const JsonPlace& place) {
    const bool root = place.parent == nullptr;
    const auto element_of = [&](std::string_view array) {
        return !root && place.key.empty() && place.parent->key == array;
    };
    if (extension == "KHR_lights_punctual") return root || element_of("nodes");
    if (extension == "KHR_materials_variants") return root || element_of("primitives");
    if (extension.starts_with("KHR_materials_")) return element_of("materials");
    if (extension == "KHR_texture_transform") return place.key.ends_with("Texture");
    return true;
}

// Nesting is at most kMaxJsonDepth.
void check_extension_places(const Json& value, const JsonPlace& place, const std::string& file) {
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            check_extension_places(value[i], {&place, {}, i}, file);
    if (!value.is_object()) return;
    for (auto member = value.begin(); member != value.end(); ++member) {
        const JsonPlace inner = {&place, member.key()};
        if (member.key() == "extras") continue;
        if (member.key() == "extensions" && member->is_object())
            for (auto extension = member->begin(); extension != member->end(); ++extension)
                if (!may_extend(extension.key(), place))
                    refuse(file, {&inner, extension.key()}, "an extension that has no place here");
        check_extension_places(*member, inner, file);
    }
}

void check_attribute_names(const Json& root, const std::string& file) {
    const auto known = [](std::string_view name) {
        if (name.starts_with('_') || name == "POSITION" || name == "NORMAL" || name == "TANGENT")
            return true;
        const std::size_t split = name.rfind('_');
        if (split == name.npos || split + 1 == name.size()) return false;
        const std::string_view kind = name.substr(0, split), digits = name.substr(split + 1);
        return (kind == "TEXCOORD" || kind == "COLOR" || kind == "JOINTS" || kind == "WEIGHTS") &&
               std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
    };
    const auto check_name = [&](const Json*, const JsonPlace& place) {
        if (!known(place.key)) refuse(file, place, "is not the name of an attribute");
    };
    visit_json(root, "meshes/*/primitives/*/attributes/*", file, check_name);
    visit_json(root, "meshes/*/primitives/*/targets/*/*", file, check_name);
}

void check_alternatives(const Json& root, const std::string& file) {
    visit_json(root, "images/*", file, [&](const Json* image, const JsonPlace& place) {
        if (image->contains("uri") == image->contains("bufferView"))
            refuse(file, place, "needs either a uri or a bufferView");
        if (image->contains("bufferView") &&
            root["bufferViews"][image->at("bufferView").get<std::size_t>()].contains("byteStride"))
            refuse(file, place, "its bufferView has a byteStride");
    });
    visit_json(root, "nodes/*", file, [&](const Json* node, const JsonPlace& place) {
        for (const char* part : {"translation", "rotation", "scale"})
            if (node->contains("matrix") && node->contains(part))
                refuse(file, place, fmt::format("has a matrix and a {}", part));
    });
    visit_json(root, "cameras/*", file, [&](const Json* camera, const JsonPlace& place) {
        const auto type = camera->at("type").get<std::string>();
        if ((type == "perspective" || type == "orthographic") && !camera->contains(type))
            refuse(file, place, type + " is missing");
    });
    visit_json(
        root, "extensions/KHR_lights_punctual/lights/*", file,
        [&](const Json* light, const JsonPlace& place) {
            if (light->at("type") != "spot") return;
            if (!light->contains("spot")) refuse(file, place, "spot is missing");
            // Equal angles, which the extension forbids too, are what Blender writes for an
            // edge without a blend.
            const Json& spot = light->at("spot");
            if (spot.value("innerConeAngle", 0.0) > spot.value("outerConeAngle", kEighthTurn))
                refuse(file, place, "innerConeAngle is beyond outerConeAngle");
        });
    visit_json(root, "animations/*", file, [&](const Json* animation, const JsonPlace& place) {
        const std::size_t count = animation->at("samplers").size();
        for (const Json& channel : animation->at("channels"))
            if (channel.at("sampler").get<std::size_t>() >= count)
                refuse(file, place, "a channel names a sampler that is not there");
    });
}

// Every node has at most one parent, none is its own ancestor, and scenes begin at roots.
void check_forest(const Json& root, const std::string& file) {
    if (!root.contains("nodes")) return;
    const Json& nodes = root["nodes"];
    const auto children = [&](std::size_t i) {
        return nodes[i].contains("children") ? nodes[i]["children"].get<std::vector<std::size_t>>()
                                             : std::vector<std::size_t>();
    };
    const auto where = [&](std::size_t i) { return fmt::format("{}: nodes[{}]", file, i); };
    std::vector<bool> has_parent(nodes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const std::size_t child : children(i)) {
            if (has_parent[child]) throw Error(where(child), "has two parents");
            has_parent[child] = true;
        }
    visit_json(root, "scenes/*/nodes/*", file, [&](const Json* node, const JsonPlace& place) {
        if (has_parent[node->get<std::size_t>()]) refuse(file, place, "is not a root node");
    });
    visit_json(root, "scenes/*/nodes", file, [&](const Json* list, const JsonPlace& place) {
        if (list == nullptr) return;
        const std::set<Json> different(list->begin(), list->end());
        if (different.size() < list->size()) refuse(file, place, "names a node twice");
    });

    std::vector<bool> reached(nodes.size(), false);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!has_parent[i]) open.push_back(i);
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        reached[i] = true;
        for (const std::size_t child : children(i)) open.push_back(child);
    }
    const auto lost = std::ranges::find(reached, false);
    if (lost != reached.end())
        throw Error(where(static_cast<std::size_t>(lost - reached.begin())),
                    "is below itself in the hierarchy");
}

}  // namespace

bool is_supported_extension(const std::string& name) {
    return std::ranges::find(kSupported, name) != kSupported.end();
}

void check_gltf(const Json& root, const std::string& file) {
    if (!root.is_object()) throw Error(file, "JSON: the document is not an object");
    for (const GltfRule& rule : kGltfRules) check_rule(root, rule, file);
    check_version(root["asset"], file);
    check_required_extensions(root, file);
    check_extension_places(root, {}, file);
    check_attribute_names(root, file);
    check_alternatives(root, file);
    check_forest(root, file);
}

}  // namespace chiaro
