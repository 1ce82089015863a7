#include "import/add_texture.h"

#include "base/error.h"

#include <fmt/format.h>

#include <utility>

namespace chiaro {

TextureId add_texture(Scene& scene, Texture texture, const std::string& where) {
    std::uint64_t bytes = 4 * texture.texels.size();
    for (const Texture& other : scene.textures) bytes += 4 * other.texels.size();
    if (bytes > kMaxTextureBytes)
        throw Error(
            where,
            fmt::format("the scene's textures take more than {} MiB", kMaxTextureBytes >> 20),
            "make them smaller");
    if (scene.textures.size() >= kMaxTextures)
        throw Error(where, fmt::format("the scene has more than {} textures", kMaxTextures));
    scene.textures.push_back(std::move(texture));
    return static_cast<TextureId>(scene.textures.size() - 1);
}

}  // namespace chiaro
