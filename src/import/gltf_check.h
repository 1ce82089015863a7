// Whether a JSON document is glTF 2.0 that we read: checked whole before any of it is used.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace chiaro {

/// Throws an Error at `file: place` for the first fault: a missing or malformed property, a
/// reference to what is not there, an extension at the wrong place or required and not supported,
/// nodes that are not a forest. Afterwards every index in the document can be used as it stands.
/// Lengths and contents of binary data are not looked at here.
void check_gltf(const nlohmann::json& root, const std::string& file);

/// Whether we read the extension of that name.
bool is_supported_extension(const std::string& name);

}  // namespace chiaro
