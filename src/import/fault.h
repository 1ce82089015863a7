// What every reader of files shares: one-line messages, whole files, files named in other files.
#pragma once

#include "base/error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace chiaro {

/// The largest file that is read [bytes].
inline constexpr std::uint64_t kMaxFileBytes = (std::uint64_t{1} << 31) - 1;

/// `text` as it may stand in a line of a message: control characters and bytes that are not UTF-8
/// are escaped (\n, \x1b), and a text longer than `most` bytes is cut.
std::string printable(std::string_view text, std::size_t most = 160);

/// The file's ending with its dot, in lower case.
std::string lower_extension(const std::filesystem::path& file);

/// The bytes of `file`. `where` names the file in the Error that a missing, unreadable or too large
/// file, a folder or a device throws.
std::string read_whole_file(const std::filesystem::path& file, const std::string& where);

/// Where `file`, which need not exist, really is: an absolute path without links.
std::filesystem::path real_path(const std::filesystem::path& file);

/// The path of a file that the scene names as `relative`, seen from the scene's `folder`. Throws an
/// Error at `where` if it is absolute or leads out of the folder, be it by a symbolic link.
std::filesystem::path resolve_beside(const std::filesystem::path& folder, std::string_view relative,
                                     const std::string& where);

}  // namespace chiaro
