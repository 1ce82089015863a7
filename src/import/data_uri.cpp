#include "import/data_uri.h"

#include "base/error.h"
#include "import/fault.h"

#include <fmt/format.h>

#include <cstdint>

namespace chiaro {
namespace {

// The six bits of a base64 character; -1 if it is none.
int base64_value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string decode_base64(std::string_view text, const std::string& where) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int value = base64_value(c);
        if (value < 0) throw Error(where, "its data is not base64");
        bits = (bits << 6) | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes += static_cast<char>((bits >> bit_count) & 0xff);
    }
    if (bit_count == 6) throw Error(where, "its data is not base64");
    return bytes;
}

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

std::optional<std::string> decode_data_uri(std::string_view uri, const std::string& where) {
    if (!uri.starts_with("data:")) return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos || !uri.substr(0, comma).ends_with(";base64"))
        throw Error(where, "is a data URI that is not base64");
    return decode_base64(uri.substr(comma + 1), where);
}

std::string decode_relative_uri(std::string_view uri, const std::string& where) {
    // A colon before the first slash ends the name of a scheme (RFC 3986, 4.2).
    const std::size_t colon = uri.find(':');
    if (colon != uri.npos && uri.find('/') > colon)
        throw Error(where, fmt::format("\"{}\" is not the name of a file", printable(uri)),
                    "only files beside the scene and data URIs are read");
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            name += uri[i];
            continue;
        }
        const int high = i + 2 < uri.size() ? hex_value(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hex_value(uri[i + 2]) : -1;
        if (high < 0 || low < 0)
            throw Error(where, fmt::format("\"{}\" has a malformed %", printable(uri)));
        name += static_cast<char>(16 * high + low);
        i += 2;
    }
    return name;
}

}  // namespace chiaro
