#include "import/image_file.h"

#include "import/fault.h"
#include "import/image_codecs.h"
#include "import/output_file.h"

#include <fmt/format.h>

namespace chiaro {
namespace {

std::span<const std::uint8_t> as_bytes(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

void check_image_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels,
                      const std::string& where) {
    if (width == 0 || height == 0) throw Error(where, "the picture has no pixels");
    if (width > kMaxImageSide || height > kMaxImageSide || width * height > most_pixels)
        throw Error(
            where, fmt::format("a picture of {} x {} pixels is too large", width, height),
            fmt::format("at most {} a side and {} in all are read", kMaxImageSide, most_pixels));
}

Texture read_texture(std::span<const std::uint8_t> bytes, const std::string& where) {
    if (bytes.empty()) throw Error(where, "the picture is empty");
    if (is_png(bytes)) return decode_png(bytes, where);
    if (is_jpeg(bytes)) return decode_jpeg(bytes, where);
    throw Error(where, "the picture is neither PNG nor JPEG");
}

Image read_image(const std::filesystem::path& file) {
    const std::string where = printable(file.string());
    const std::string bytes = read_whole_file(file, where);
    if (bytes.empty()) throw Error(where, "the file is empty");
    if (is_exr(as_bytes(bytes))) return decode_exr(bytes, where);
    if (is_hdr(as_bytes(bytes))) return decode_hdr(bytes, where);
    if (is_png(as_bytes(bytes))) return decode_png_linear(as_bytes(bytes), where);
    throw Error(where, "the picture is neither OpenEXR, Radiance nor PNG");
}

void write_exr(const std::filesystem::path& file, const Image& image) {
    replace_file(file, encode_exr(image, printable(file.string())));
}

void write_png(const std::filesystem::path& file, const Image& image) {
    replace_file(file, encode_png(image, printable(file.string())));
}

void check_writable(const std::filesystem::path& file) {
    const std::string extension = lower_extension(file);
    if (extension != ".png" && extension != ".exr")
        throw Error(printable(file.string()), "is neither a .png nor an .exr file",
                    "give the picture one of these endings");
    check_replaceable(file);
}

}  // namespace chiaro
