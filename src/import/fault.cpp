#include "import/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>
#include <system_error>

namespace chiaro {
namespace {

// Bytes of the well-formed UTF-8 character at the start of `text`; 0 if there is none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xc2 && lead < 0xe0 ? 2
                               : lead >= 0xe0 && lead < 0xf0 ? 3
                               : lead >= 0xf0 && lead < 0xf5 ? 4
                                                             : 0;
    if (length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    return length;
}

// U+0000 to U+001F, U+007F to U+009F, and the line and paragraph separators.
bool is_control(std::string_view character) {
    const auto lead = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return lead < 0x20 || lead == 0x7f;
    if (character.size() == 2)
        return lead == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
    return character == "\u2028" || character == "\u2029";
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
    std::string line;
    while (!text.empty()) {
        if (line.size() > most) return line + "...";
        const std::size_t length = utf8_length(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        text.remove_prefix(character.size());
        if (length > 0 && !is_control(character))
            line += character;
        else if (character == "\n")
            line += "\\n";
        else
            for (const char c : character)
                line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    return line;
}

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string read_whole_file(const std::filesystem::path& file, const std::string& where) {
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(file, failure);
    if (status.type() == std::filesystem::file_type::not_found)
        throw Error(where, "there is no such file");
    if (is_directory(status)) throw Error(where, "is a folder, not a file");
    if (failure) throw Error(where, "cannot be read: " + failure.message());
    if (!is_regular_file(status)) throw Error(where, "is not an ordinary file");

    const std::uint64_t size = std::filesystem::file_size(file, failure);
    if (failure) throw Error(where, "cannot be read: " + failure.message());
    if (size > kMaxFileBytes) throw Error(where, "is larger than 2 GiB");

    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                                 std::fclose);
    if (!stream) throw Error(where, "cannot be opened: " + std::generic_category().message(errno));
    std::string bytes(size, '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), stream.get()));
    if (std::ferror(stream.get())) throw Error(where, "cannot be read to its end");
    return bytes;
}

std::filesystem::path real_path(const std::filesystem::path& file) {
    std::error_code failure;
    const auto whole = std::filesystem::absolute(file, failure);
    const auto real = std::filesystem::weakly_canonical(whole, failure);
    return failure ? whole.lexically_normal() : real;
}

std::filesystem::path resolve_beside(const std::filesystem::path& folder, std::string_view relative,
                                     const std::string& where) {
    const std::string shown = printable(relative);
    if (relative.empty()) throw Error(where, "names a file without a name");
    if (relative.find('\0') != std::string_view::npos)
        throw Error(where, fmt::format("\"{}\" is not the name of a file", shown));
    const std::string remedy = "put the file into the scene's folder and name it from there";
    const bool drive = relative.size() > 1 && relative[1] == ':';
    const auto path = std::filesystem::path(relative).lexically_normal();
    if (path.is_absolute() || drive)
        throw Error(where, fmt::format("\"{}\" is an absolute path", shown), remedy);
    const std::filesystem::path real = real_path(folder / path), top = real_path(folder / ".");
    if (std::ranges::mismatch(top, real).in1 != top.end())
        throw Error(where, fmt::format("\"{}\" leads out of the scene's folder", shown), remedy);
    return folder / path;
}

}  // namespace chiaro
