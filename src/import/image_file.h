// Pictures in files: PNG, JPEG, OpenEXR and Radiance. The only place that knows their libraries.
#pragma once

#include "base/image.h"
#include "scene/texture.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace chiaro {

/// The largest width or height of a picture that is read [pixels].
inline constexpr std::uint32_t kMaxImageSide = 16384;
/// The most pixels of a picture and of a texture.
inline constexpr std::uint64_t kMaxPicturePixels = std::uint64_t{1} << 25;
inline constexpr std::uint64_t kMaxTexturePixels = std::uint64_t{1} << 26;

/// The texels of a PNG or JPEG file's bytes, told apart by how they begin, not by a name. 16-bit
/// channels are cut to 8, grey is spread to RGB; name, sampling and `srgb` are left to the caller.
/// Throws an Error at `where` if the bytes are neither, are broken or are too large a picture.
Texture read_texture(std::span<const std::uint8_t> bytes, const std::string& where);

/// The picture in an OpenEXR file (R, G and B, or Y alone), a Radiance file (.hdr; its exposure
/// undone, CIE XYZ converted, at least 0 and finite) or a PNG file (decoded from sRGB, alpha
/// ignored) as linear RGB, told apart by how they begin. Throws an Error that names the file.
Image read_image(const std::filesystem::path& file);

/// Writes linear RGB as an OpenEXR file of channels R, G and B in floats, ZIP-compressed. An
/// existing file is replaced only when all is written.
void write_exr(const std::filesystem::path& file, const Image& image);

/// Writes values that are already encoded for display, clamped to [0, 1], as an 8-bit RGB file
/// marked as sRGB. An existing file is replaced only when all is written.
void write_png(const std::filesystem::path& file, const Image& image);

/// Throws the Error that writing to `file` would end in, before any work is done: an ending other
/// than .png or .exr, no such folder, a folder in its place, no right or no room to write there.
/// Leaves an existing file as it is.
void check_writable(const std::filesystem::path& file);

}  // namespace chiaro
