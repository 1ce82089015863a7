// What the tests of importers share: a folder of their own, and small files to put into it.
#pragma once

#include "base/error.h"
#include "base/image.h"
#include "import/image_file.h"
#include "import/load_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace chiaro {

/// An empty folder that is deleted with all that is in it.
class TempFolder {
public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "chiaro-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    ~TempFolder() { std::filesystem::remove_all(path_); }

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << bytes;
        return file;
    }

    Scene load(const std::string& name, std::string_view bytes,
               const LoadOptions& options = {}) const {
        return load_scene(write(name, bytes), options);
    }

    /// A picture of 2 x 1 pixels, red and green.
    void write_picture(const std::string& name) const {
        Image image(2, 1);
        image.at(0, 0) = Rgb(1, 0, 0);
        image.at(1, 0) = Rgb(0, 1, 0);
        std::filesystem::create_directories((path_ / name).parent_path());
        write_png(path_ / name, image);
    }

private:
    std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// The message of the Error that `load` throws, which must be one line; empty if it throws none.
template <typename Load>
std::string fault_of(const Load& load) {
    try {
        load();
    } catch (const Error& error) {
        const std::string message = error.what();
        for (const char c : message) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << message;
        return message;
    }
    return "";
}

/// The Error's message without the folder of the file; empty if the text loads.
inline std::string fault_of_file(const TempFolder& folder, const std::string& name,
                                 std::string_view bytes) {
    const std::string message = fault_of([&] { folder.load(name, bytes); });
    const std::string prefix = folder.path().string() + "/";
    return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

inline std::string base64(std::string_view bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits =
                (bits << 8) | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[(bits >> (18 - 6 * k)) & 63] : '=';
    }
    return text;
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
    return std::string(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
}

/// A glTF document under construction: each array of numbers gets a buffer of its own.
struct GltfMaker {
    nlohmann::json root = {{"asset", {{"version", "2.0"}}}};

    template <typename T>
    std::size_t add_accessor(const std::vector<T>& values, const std::string& type, int component,
                             std::size_t components) {
        const std::string bytes = bytes_of(values);
        root["buffers"].push_back(
            {{"byteLength", bytes.size()},
             {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
        root["bufferViews"].push_back(
            {{"buffer", root["buffers"].size() - 1}, {"byteLength", bytes.size()}});
        root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", values.size() / components},
                                     {"type", type}});
        return root["accessors"].size() - 1;
    }
    std::size_t add_vec3(const std::vector<float>& v) { return add_accessor(v, "VEC3", 5126, 3); }
    std::size_t add_vec2(const std::vector<float>& v) { return add_accessor(v, "VEC2", 5126, 2); }
    std::size_t add_indices(const std::vector<std::uint16_t>& v) {
        return add_accessor(v, "SCALAR", 5123, 1);
    }
    std::string text() const { return root.dump(); }
    nlohmann::json& primitive() { return root["meshes"][0]["primitives"][0]; }
};

/// One triangle of area 1/2 in the xy plane, facing +z, in a node without a name.
inline GltfMaker triangle_gltf() {
    GltfMaker maker;
    const std::size_t positions = maker.add_vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    maker.root["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
    maker.root["nodes"] = {{{"mesh", 0}}};
    return maker;
}

/// A binary glTF file of a JSON chunk and, unless it is empty, a binary one.
inline std::string make_glb(std::string json, std::string binary) {
    while (json.size() % 4 != 0) json += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    const auto u32 = [](std::size_t value) {
        return bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
    };
    std::string chunks = u32(json.size()) + "JSON" + json;
    if (!binary.empty()) chunks += u32(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + u32(2) + u32(12 + chunks.size()) + chunks;
}

/// An 8 x 8 JPEG of sRGB (200, 100, 50).
inline constexpr std::string_view kJpegBase64 =
    "/9j/2wBDAAIBAQEBAQIBAQECAgICAgQDAgICAgUEBAMEBgUGBgYFBgYGBwkIBgcJBwYGCAsICQoKCgoKBggLDAsKDA"
    "kKCgr/2wBDAQICAgICAgUDAwUKBwYHCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoK"
    "CgoKCgr/wAARCAAIAAgDASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAX/xAAUEAEAAAAAAAAAAAAAAAAAAA"
    "AA/8QAFAEBAAAAAAAAAAAAAAAAAAAACP/EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAMAwEAAhEDEQA/AJ4Armw//9k=";

}  // namespace chiaro
