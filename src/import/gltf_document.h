// A glTF file whose structure has been checked, with the bytes of its buffers.
#pragma once

#include "import/scene_file.h"

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace chiaro {

/// Bytes of a buffer or an image. They stay where they are while the document lives.
using GltfBytes = std::span<const std::uint8_t>;

struct GltfBuffer {
    std::uint64_t length = 0;  // as declared
    GltfBytes bytes;           // `length` of them, or none if the file gives no data for the buffer
};

/// An image as the file names it; its bytes are read when a material needs them.
struct GltfImage {
    std::string uri;  // empty: in a buffer view
    int buffer_view = -1;
    std::string name;
};

class GltfDocument {
public:
    /// Reads `file`, a .glb if `binary`. Throws an Error at "file: place" if anything of its
    /// structure is wrong, a buffer is absent or a view or an accessor reaches beyond its data.
    GltfDocument(const SceneFile& file, bool binary);
    GltfDocument(const GltfDocument&) = delete;
    GltfDocument& operator=(const GltfDocument&) = delete;

    /// Every index in the model is in range. Buffers, images, skins and animations are not in it:
    /// no bytes of the file pass through the library.
    const tinygltf::Model& model() const { return model_; }
    const std::vector<GltfBuffer>& buffers() const { return buffers_; }
    const std::vector<GltfImage>& images() const { return images_; }

    /// "file: place", for messages.
    std::string where(const std::string& place) const { return where_ + ": " + place; }
    /// Bytes of a buffer view; none if its buffer has none.
    GltfBytes view_bytes(int buffer_view) const;
    /// The encoded bytes of an image. Throws an Error at `place` if they are absent.
    GltfBytes image_bytes(std::size_t image, const std::string& place);
    /// What an image that is a file of its own misses; empty if nothing.
    std::string missing_file(std::size_t image) const;
    /// Whether the accessor's type and component type are any that glTF knows.
    bool accessor_known(std::size_t accessor) const { return accessor_known_[accessor]; }

    /// The file's list of animations, which has passed check_gltf().
    const nlohmann::json& animations() const { return animations_; }

    bool has_skins = false;

private:
    void load_buffers(const nlohmann::json& root, std::optional<std::string_view> binary);
    void note_images(const nlohmann::json& root);
    void read_model(nlohmann::json root);
    GltfBytes load_uri(const std::string& uri, const std::string& place);

    std::string where_;
    std::filesystem::path folder_;
    tinygltf::Model model_;
    std::vector<GltfBuffer> buffers_;
    std::vector<GltfImage> images_;
    std::vector<bool> accessor_known_;
    nlohmann::json animations_ = nlohmann::json::array();
    std::deque<std::string> storage_;           // decoded data URIs
    std::map<std::string, std::string> files_;  // by name, read once each
};

}  // namespace chiaro
