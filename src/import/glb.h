// What must hold of a glTF file's bytes before any library sees them: the container and the
// nesting.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace chiaro {

/// The deepest nesting of arrays and objects that is read.
inline constexpr int kMaxJsonDepth = 64;

/// The chunks of a binary glTF file, as views of its bytes.
struct GlbChunks {
    std::string_view json;
    std::optional<std::string_view> binary;
};

/// Takes a .glb file apart. Throws an Error at `where` if the header, the length or a chunk is
/// wrong.
GlbChunks split_glb(std::string_view bytes, const std::string& where);

/// Throws an Error at `where` if `json` opens more than kMaxJsonDepth arrays and objects inside one
/// another. Looks at brackets outside strings only; whether it is JSON at all is left to a parser.
void check_json_depth(std::string_view json, const std::string& where);

}  // namespace chiaro
