// Places in a JSON document, written as in messages: meshes[2].primitives[0].material.
#pragma once

#include "base/error.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace chiaro {

/// The document that `text` is. Throws an Error at `where` if it is none, nests deeper than
/// kMaxJsonDepth or begins with a byte order mark.
nlohmann::json parse_json(std::string_view text, const std::string& where);

/// A step of the way from the root of a document to a value; the whole way is spelled out only when
/// a message needs it. Lives on the stack of the walk.
struct JsonPlace {
    const JsonPlace* parent = nullptr;
    std::string_view key = {};  // of an object; empty where `index` counts
    std::size_t index = 0;      // in an array

    std::string path() const;
};

/// Throws the Error "`file`: path: `what`".
[[noreturn]] void refuse(const std::string& file, const JsonPlace& place, const std::string& what);

using JsonVisitor = std::function<void(const nlohmann::json*, const JsonPlace&)>;

/// Calls `visit` for every place that `pattern` fits: keys joined by '/', where '*' stands for
/// every element of an array or member of an object, and '~' for those members that are objects. A
/// last key that is absent is visited with null; a place above it that is absent, is not.  Throws
/// an Error if a value on the way is of the wrong kind.
void visit_json(const nlohmann::json& root, std::string_view pattern, const std::string& file,
                const JsonVisitor& visit);

}  // namespace chiaro
