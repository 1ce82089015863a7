#include "import/glb.h"

#include "base/error.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

namespace chiaro {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

// Little endian, as is every machine with the vector instructions that we need.
std::uint32_t read_u32(std::string_view bytes, std::size_t offset) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

void check_header(std::string_view bytes, const std::string& where) {
    if (bytes.size() < kHeaderBytes || read_u32(bytes, 0) != kMagic)
        throw Error(where, "is not a binary glTF file");
    const std::uint32_t version = read_u32(bytes, 4);
    if (version != 2)
        throw Error(where, fmt::format("version {} of binary glTF is not supported", version));
    const std::uint32_t length = read_u32(bytes, 8);
    if (length != bytes.size())
        throw Error(where, fmt::format("the header gives a length of {} bytes, but the file has {}",
                                       length, bytes.size()));
}

}  // namespace

GlbChunks split_glb(std::string_view bytes, const std::string& where) {
    check_header(bytes, where);
    GlbChunks chunks;
    std::size_t index = 0;
    for (std::size_t at = kHeaderBytes; at < bytes.size(); ++index) {
        const auto refuse = [&](const std::string& what) {
            throw Error(fmt::format("{}: chunk {}", where, index), what);
        };
        if (bytes.size() - at < kChunkHeaderBytes) refuse("the file ends in its header");
        const std::uint32_t length = read_u32(bytes, at);
        const std::uint32_t type = read_u32(bytes, at + 4);
        at += kChunkHeaderBytes;
        if (length > bytes.size() - at)
            refuse(fmt::format("its {} bytes go beyond the end of the file", length));
        if (length % 4 != 0) refuse("its length is not a multiple of 4");
        const std::string_view body = bytes.substr(at, length);
        at += length;

        if ((type == kJsonChunk) != (index == 0))
            refuse(index == 0 ? "the first chunk is not JSON" : "a second chunk of JSON");
        if (type == kJsonChunk) chunks.json = body;
        if (type == kBinaryChunk) {
            if (index != 1) refuse("binary data must be the second chunk");
            chunks.binary = body;
        }
    }
    if (chunks.json.empty()) throw Error(where, "there is no JSON in the file");
    return chunks;
}

void check_json_depth(std::string_view json, const std::string& where) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kMaxJsonDepth)
                throw Error(fmt::format("{}: byte {}", where, i),
                            fmt::format("JSON is nested deeper than {}", kMaxJsonDepth));
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

}  // namespace chiaro
