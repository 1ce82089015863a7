#include "import/read_edits.h"

#include "base/error.h"
#include "import/fault.h"
#include "import/json_fields.h"
#include "import/json_place.h"
#include "import/load_scene.h"

#include <fmt/format.h>

#include <algorithm>

namespace chiaro {
namespace {

using Json = nlohmann::json;

constexpr double kMostSeconds = 1e9;
constexpr double kFar = double(kFarthest);
constexpr double kBright = double(kBrightest);
constexpr double kLeastLength = 1e-6, kMostLength = 1e6;  // sizes and scales
constexpr double kMostDegrees = 1e6;

// What is said to be edited; the keys that name it.
constexpr const char* kKinds[] = {"object", "light", "camera", "material", "remove", "add"};

PlaceChange read_place(const JsonFields& fields) {
    PlaceChange place;
    place.translate = fields.vector("translate", kFar);
    place.scale = fields.number("scale", kLeastLength, kMostLength);
    if (const auto turn = fields.numbers("rotate", 4, -kMostDegrees, kMostDegrees)) {
        place.rotate = Vec4((*turn)[0], (*turn)[1], (*turn)[2], (*turn)[3]);
        if (!(glm::length(Vec3(*place.rotate)) > 1e-9f))
            throw Error(fields.where("rotate"), "its axis has no direction",
                        "give an axis and degrees, as [0, 1, 0, 30]");
    }
    return place;
}

ChangeObject read_object(const Json& edit, const std::string& where) {
    const JsonFields fields(edit, where, {"t", "object", "translate", "rotate", "scale"});
    return {*fields.text("object"), read_place(fields)};
}

ChangeLight read_lamp(const JsonFields& fields) {
    ChangeLight light;
    light.name = *fields.text("light");
    light.position = fields.vector("position", kFar);
    light.direction = fields.direction("direction");
    if (const auto size = fields.numbers("size", 2, kLeastLength, kMostLength))
        light.size = Vec2((*size)[0], (*size)[1]);
    light.candela = fields.number("candela", 0, kBright);
    light.nits = fields.number("nits", 0, kBright);
    light.color = fields.color("color", kBright);
    if (light.color && !(luminance(*light.color) > 0))
        throw Error(fields.where("color"), "is black", "say \"on\": false");
    return light;
}

ChangeLight read_light(const Json& edit, const std::string& where) {
    const JsonFields fields(edit, where,
                            {"t", "light", "position", "direction", "size", "candela", "nits",
                             "intensity_scale", "color", "on"});
    ChangeLight light = read_lamp(fields);
    light.intensity_scale = fields.number("intensity_scale", 0, kBright);
    light.on = fields.flag("on");
    if (light.candela.has_value() + light.nits.has_value() + light.intensity_scale.has_value() > 1)
        throw Error(where, "candela, nits and intensity_scale exclude each other", "give one");
    return light;
}

ChangeCamera read_camera(const Json& edit, const std::string& where) {
    const JsonFields outer(edit, where, {"t", "camera"});
    const JsonFields fields(outer.at("camera"), outer.where("camera"),
                            {"eye", "target", "up", "vfov"});
    return {fields.vector("eye", kFar), fields.vector("target", kFar), fields.direction("up"),
            fields.number("vfov", 0.001, 179.999)};
}

ChangeMaterial read_material(const Json& edit, const std::string& where) {
    const JsonFields fields(edit, where,
                            {"t", "material", "base_color", "roughness", "emission_scale"});
    return {*fields.text("material"), fields.color("base_color", 1),
            fields.number("roughness", 0, 1), fields.number("emission_scale", 0, kBright)};
}

Remove read_remove(const Json& edit, const std::string& where) {
    return {*JsonFields(edit, where, {"t", "remove"}).text("remove")};
}

// What a new light of its kind must say, and may not.
void check_new_light(const NewLight& added, const JsonFields& fields) {
    const bool area = added.kind == NewLightKind::area;
    const auto need = [&](const char* key) {
        if (!fields.has(key)) throw Error(fields.where(key), "is missing");
    };
    const auto refuse = [&](const char* key, const char* what) {
        if (fields.has(key)) throw Error(fields.where(key), what);
    };
    need("position");
    need(area ? "nits" : "candela");
    if (area) {
        need("size");
        refuse("candela", "an area light has nits");
        refuse("cone", "a spot alone has a cone");
        return;
    }
    refuse("nits", "a point or spot light has candela");
    refuse("size", "an area light alone has a size");
    if (added.kind == NewLightKind::spot) return;
    refuse("cone", "a spot alone has a cone");
    refuse("direction", "a point light shines all round");
}

NewLight read_new_light(const Json& edit, const std::string& where) {
    const JsonFields fields(
        edit, where,
        {"light", "type", "position", "direction", "size", "candela", "nits", "color", "cone"});
    NewLight added;
    added.light = read_lamp(fields);
    const std::string type = fields.text("type").value_or("");
    if (type == "spot")
        added.kind = NewLightKind::spot;
    else if (type == "area")
        added.kind = NewLightKind::area;
    else if (type != "point")
        throw Error(fields.where("type"), "is none of point, spot and area");
    check_new_light(added, fields);
    if (added.light.size) added.size = *added.light.size;
    added.light.size.reset();
    if (const auto cone = fields.numbers("cone", 2, 0, 90)) {
        added.cone = {(*cone)[0], (*cone)[1]};
        if (!(added.cone[0] <= added.cone[1] && added.cone[1] > 0))
            throw Error(fields.where("cone"), "its outer angle is not beyond its inner one",
                        "give degrees from the axis, as [20, 30]");
    }
    return added;
}

NamedEdit read_add(const Json& edit, const std::string& where) {
    const JsonFields outer(edit, where, {"t", "add"});
    const Json& added = outer.at("add");
    const std::string place = outer.where("add");
    if (!added.is_object()) throw Error(place, "is not an object");
    if (added.contains("light")) return read_new_light(added, place);
    const JsonFields fields(added, place, {"object", "copy", "translate", "rotate", "scale"});
    for (const char* key : {"object", "copy"})
        if (!fields.has(key))
            throw Error(fields.where(key), "is missing",
                        "add a \"light\", or an \"object\" that is a \"copy\"");
    return CopyObject{*fields.text("object"), *fields.text("copy"), read_place(fields)};
}

NamedEdit read_edit(const Json& edit, const std::string& where) {
    if (!edit.is_object()) throw Error(where, "is not an object");
    const char* kind = nullptr;
    for (const char* key : kKinds) {
        if (!edit.contains(key)) continue;
        if (kind != nullptr)
            throw Error(where, fmt::format("edits both \"{}\" and \"{}\"", kind, key),
                        "make two edits of it");
        kind = key;
    }
    const std::string_view what = kind != nullptr ? kind : "";
    if (what == "object") return read_object(edit, where);
    if (what == "light") return read_light(edit, where);
    if (what == "camera") return read_camera(edit, where);
    if (what == "material") return read_material(edit, where);
    if (what == "remove") return read_remove(edit, where);
    if (what == "add") return read_add(edit, where);
    throw Error(where, "does not say what it edits",
                "there are object, light, camera, material, remove and add");
}

const Json& list_at(const JsonFields& fields, const char* key) {
    static const Json kNone = Json::array();
    if (!fields.has(key)) return kNone;
    if (!fields.at(key).is_array()) throw Error(fields.where(key), "is not a list");
    return fields.at(key);
}

}  // namespace

EditScript read_edits(const std::filesystem::path& file) {
    const std::string where = printable(file.string());
    return parse_edits(read_whole_file(file, where), where);
}

EditScript parse_edits(std::string_view text, const std::string& file) {
    const Json root = parse_json(text, file);
    if (!root.is_object()) throw Error(file, "the script is not an object");
    const JsonFields fields(root, file + ": ", {"edits", "frames"});
    EditScript script;
    for (const Json& edit : list_at(fields, "edits")) {
        const std::string where = fmt::format("{}: edits[{}]", file, script.edits.size());
        NamedEdit named = read_edit(edit, where);
        const double time =
            edit.contains("t") ? read_number(edit["t"], 0, kMostSeconds, where + ".t") : 0.0;
        script.edits.push_back({time, where, std::move(named)});
    }
    std::ranges::stable_sort(script.edits, {}, &TimedEdit::time);
    for (const Json& frame : list_at(fields, "frames"))
        script.frames.push_back(read_number(
            frame, 0, kMostSeconds, fmt::format("{}: frames[{}]", file, script.frames.size())));
    return script;
}

}  // namespace chiaro
