// Files that are written whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace chiaro {

/// Writes `bytes` to a file beside `file` and renames it to `file`, whose permissions stay; where
/// `file` is a link, what it points to is replaced. Throws an Error, and leaves what was there
/// before, if any step fails.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

/// Throws the Error that replace_file() would end in, as far as can be told without writing.
void check_replaceable(const std::filesystem::path& file);

}  // namespace chiaro
