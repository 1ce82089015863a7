// Edits as scripts say them: by names, and relative to the scene as it was loaded
// (docs/files.md).
#pragma once

#include "base/color.h"

#include <array>
#include <optional>
#include <string>
#include <variant>

namespace chiaro {

/// Where things are, from their place in the file: scaled and turned about the centre of their
/// bounds there, then moved; all in world space.
struct PlaceChange {
    std::optional<Vec3> translate = std::nullopt;
    std::optional<Vec4> rotate = std::nullopt;  // axis of any length above 0, degrees
    std::optional<float> scale = std::nullopt;  // above 0
};

struct ChangeObject {
    std::string name;
    PlaceChange place;
};

/// What is absent stays as it is. Candela, nits and intensity_scale exclude each other.
struct ChangeLight {
    std::string name;
    std::optional<Vec3> position = std::nullopt;   // world; of an area light, its bounds' centre
    std::optional<Vec3> direction = std::nullopt;  // the way the light travels, any length above 0
    std::optional<Vec2> size = std::nullopt;       // of an area light: width, height
    std::optional<float> candela = std::nullopt;   // luminous intensity, whatever the colour
    std::optional<float> nits = std::nullopt;      // luminance [cd/m2], whatever the colour
    std::optional<float> intensity_scale = std::nullopt;  // of what the file says
    std::optional<Rgb> color = std::nullopt;              // keeps the luminance; linear, not black
    std::optional<bool> on = std::nullopt;
};

struct ChangeCamera {
    std::optional<Vec3> eye = std::nullopt, target = std::nullopt, up = std::nullopt;
    std::optional<float> vertical_fov = std::nullopt;  // degrees
};

struct ChangeMaterial {
    std::string name;
    std::optional<Rgb> base_color = std::nullopt;
    std::optional<float> roughness = std::nullopt;
    std::optional<float> emission_scale = std::nullopt;  // of what the file says
};

/// Of an object or a light.
struct Remove {
    std::string name;
};

enum class NewLightKind { point, spot, area };
struct NewLight {
    NewLightKind kind = NewLightKind::point;
    Vec2 size = Vec2(0);                  // area
    std::array<float, 2> cone = {0, 45};  // spot: degrees from the axis
    ChangeLight light;  // by its new name; position, and candela or nits, are there
};

struct CopyObject {
    std::string name;  // new
    std::string original;
    PlaceChange place;  // from the original's place in the file
};

using NamedEdit = std::variant<ChangeObject, ChangeLight, ChangeCamera, ChangeMaterial, Remove,
                               NewLight, CopyObject>;

}  // namespace chiaro
