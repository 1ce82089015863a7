// How edits change lights.

#include "base/error.h"
#include "import/fault.h"
#include "import/load_scene.h"
#include "import/resolve_edits.h"

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

}  // namespace

std::vector<Edit> EditResolver::operator()(const ChangeLight& edit) {
    const std::vector<LightId> lamps = names_.lights(edit.name);
    if (lamps.empty()) {
        const NamedThings things = names_.things(edit.name);
        const auto lit = [&](ObjectId id) { return shines(id); };
        if (std::ranges::any_of(things.objects, lit)) return changed_area_light(things, edit);
        throw Error(at("light"),
                    things.empty() ? "there is no light \"" + printable(edit.name) + "\""
                                   : "the object \"" + printable(edit.name) + "\" does not shine",
                    light_names());
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

std::string EditResolver::light_names() const {
    return names_.light_names([&](ObjectId id) { return shines(id); });
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

}  // namespace chiaro
