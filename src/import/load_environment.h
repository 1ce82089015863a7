// Environment maps from files.
#pragma once

#include "scene/environment.h"

#include <filesystem>

namespace chiaro {

/// The map in `file`, an equirectangular picture of radiance in cd/m2 (read_image() says of which
/// kinds). Throws an Error of one line if it cannot be read, or has a pixel that is not a number,
/// is negative, or is brighter than kBrightest.
Environment load_environment(const std::filesystem::path& file);

}  // namespace chiaro
