// The decoders and encoders behind image_file.h, one a file format: bytes in memory to pixels and
// back. `where` names the picture in Errors.
#pragma once

#include "import/image_file.h"

#include <string_view>

namespace chiaro {

/// Throws an Error at `where` unless a picture of this size and of at most `most_pixels` may be
/// decoded.
void check_image_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels,
                      const std::string& where);

bool is_png(std::span<const std::uint8_t> bytes);
Texture decode_png(std::span<const std::uint8_t> bytes, const std::string& where);
Image decode_png_linear(std::span<const std::uint8_t> bytes, const std::string& where);
std::string encode_png(const Image& image, const std::string& where);

bool is_jpeg(std::span<const std::uint8_t> bytes);
Texture decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& where);

bool is_exr(std::span<const std::uint8_t> bytes);
Image decode_exr(const std::string& bytes, const std::string& where);
std::string encode_exr(const Image& image, const std::string& where);

bool is_hdr(std::span<const std::uint8_t> bytes);
Image decode_hdr(std::string_view bytes, const std::string& where);

}  // namespace chiaro
