// The two kinds of URI that glTF files name their data with.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace chiaro {

/// The bytes of a base64 data URI ("data:...;base64,..."). Throws an Error at `where` if it is
/// malformed; empty if `uri` is no data URI.
std::optional<std::string> decode_data_uri(std::string_view uri, const std::string& where);

/// The file name that a relative URI stands for, its %20 and the like decoded. Throws an Error at
/// `where` if it has a scheme (http:) or is malformed.
std::string decode_relative_uri(std::string_view uri, const std::string& where);

}  // namespace chiaro
