// The one way by which readers put textures into a scene, so that no file fills the memory.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <string>

namespace chiaro {

/// The most texels of all textures of a scene [bytes], and the most textures.
inline constexpr std::uint64_t kMaxTextureBytes = std::uint64_t{1} << 30;
inline constexpr std::size_t kMaxTextures = 4096;

/// Appends `texture`. Throws an Error at `where` if the scene then passes a limit.
TextureId add_texture(Scene& scene, Texture texture, const std::string& where);

}  // namespace chiaro
