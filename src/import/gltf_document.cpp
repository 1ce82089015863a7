#include "import/gltf_document.h"

#include "import/data_uri.h"
#include "import/fault.h"
#include "import/glb.h"
#include "import/gltf_accessor.h"
#include "import/gltf_check.h"
#include "import/json_place.h"

#include <fmt/format.h>

#include <array>

namespace chiaro {
namespace {

using Json = nlohmann::json;

GltfBytes as_bytes(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

bool known_component(int type) {
    return (type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT &&
            type != TINYGLTF_COMPONENT_TYPE_INT) ||
           type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

bool known_type(const std::string& type) {
    constexpr std::array kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    return std::ranges::find(kTypes, type) != kTypes.end();
}

// The library reads structure only; should it ever ask for a file, there is none.
tinygltf::FsCallbacks no_files() {
    tinygltf::FsCallbacks files = {};
    files.FileExists = [](const std::string&, void*) { return false; };
    files.ExpandFilePath = [](const std::string& path, void*) { return path; };
    files.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) {
        return false;
    };
    files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                              void*) { return false; };
    return files;
}

bool no_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
              int, void*) {
    return false;
}

}  // namespace

GltfDocument::GltfDocument(const SceneFile& file, bool binary)
    : where_(file.where), folder_(file.folder) {
    const GlbChunks chunks = binary ? split_glb(file.bytes, where_) : GlbChunks{file.bytes, {}};
    Json root = parse_json(chunks.json, where_);
    check_gltf(root, where_);
    has_skins = root.contains("skins");
    if (root.contains("animations")) animations_ = root["animations"];
    load_buffers(root, chunks.binary);
    note_images(root);
    read_model(std::move(root));
    check_buffer_views(*this);
    check_accessors(*this);
}

void GltfDocument::load_buffers(const Json& root, std::optional<std::string_view> binary) {
    if (!root.contains("buffers")) return;
    for (const Json& declared : root["buffers"]) {
        const std::string place = where(fmt::format("buffers[{}]", buffers_.size()));
        GltfBuffer buffer = {declared["byteLength"].get<std::uint64_t>(), {}};
        const bool in_file = !declared.contains("uri") && buffers_.empty() && binary.has_value();
        if (declared.contains("uri"))
            buffer.bytes = load_uri(declared["uri"].get_ref<const std::string&>(), place);
        else if (in_file)
            buffer.bytes = as_bytes(*binary);
        if (declared.contains("uri") || in_file) {
            if (buffer.bytes.size() < buffer.length)
                throw Error(place, fmt::format("has {} bytes of the {} that it declares",
                                               buffer.bytes.size(), buffer.length));
            buffer.bytes = buffer.bytes.first(buffer.length);
        }
        buffers_.push_back(buffer);
    }
}

GltfBytes GltfDocument::load_uri(const std::string& uri, const std::string& place) {
    if (std::optional<std::string> data = decode_data_uri(uri, place)) {
        storage_.push_back(std::move(*data));
        return as_bytes(storage_.back());
    }
    const std::string name = decode_relative_uri(uri, place);
    const auto [file, fresh] = files_.try_emplace(name);
    if (fresh)
        file->second =
            read_whole_file(resolve_beside(folder_, name, place), place + ": " + printable(name));
    return as_bytes(file->second);
}

void GltfDocument::note_images(const Json& root) {
    if (!root.contains("images")) return;
    for (const Json& declared : root["images"]) {
        const std::string place = where(fmt::format("images[{}]", images_.size()));
        GltfImage image = {declared.value("uri", ""), declared.value("bufferView", -1),
                           declared.value("name", "")};
        // The name alone is checked here, so that it is refused in images without use too.
        if (image.buffer_view < 0 && !image.uri.starts_with("data:"))
            resolve_beside(folder_, decode_relative_uri(image.uri, place), place);
        images_.push_back(std::move(image));
    }
}

void GltfDocument::read_model(Json root) {
    for (const char* bytes : {"buffers", "images", "skins", "animations"}) root.erase(bytes);
    if (root.contains("accessors"))
        for (Json& accessor : root["accessors"]) {
            const auto component = accessor["componentType"].get<int>();
            const bool known =
                known_type(accessor["type"].get<std::string>()) && known_component(component);
            accessor_known_.push_back(known);
            if (known) continue;
            accessor["type"] = "SCALAR";
            accessor["componentType"] = TINYGLTF_COMPONENT_TYPE_FLOAT;
        }

    tinygltf::TinyGLTF library;
    library.SetFsCallbacks(no_files());
    library.SetImageLoader(no_image, nullptr);
    const std::string text = root.dump();
    std::string fault, warning;
    bool read = false;
    try {
        read = library.LoadASCIIFromString(&model_, &fault, &warning, text.data(),
                                           static_cast<unsigned int>(text.size()), "",
                                           tinygltf::NO_REQUIRE);
    } catch (const std::exception& exception) {
        fault = exception.what();
    }
    if (!read) throw Error(where_, printable(fault.substr(0, fault.find('\n'))));
}

GltfBytes GltfDocument::view_bytes(int buffer_view) const {
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(buffer_view)];
    const GltfBytes bytes = buffers_[static_cast<std::size_t>(view.buffer)].bytes;
    return bytes.empty() ? bytes : bytes.subspan(view.byteOffset, view.byteLength);
}

GltfBytes GltfDocument::image_bytes(std::size_t image, const std::string& place) {
    const GltfImage& declared = images_[image];
    if (declared.buffer_view < 0) return load_uri(declared.uri, place);
    return view_bytes(declared.buffer_view);
}

std::string GltfDocument::missing_file(std::size_t image) const {
    const GltfImage& declared = images_[image];
    if (declared.buffer_view >= 0 || declared.uri.starts_with("data:")) return "";
    const std::string place = where(fmt::format("images[{}]", image));
    const std::string name = decode_relative_uri(declared.uri, place);
    std::error_code ignored;
    const auto path = resolve_beside(folder_, name, place);
    return std::filesystem::is_regular_file(path, ignored) ? "" : name;
}

}  // namespace chiaro
