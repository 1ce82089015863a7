#include "import/fault.h"
#include "import/image_codecs.h"

#include <spng.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace chiaro {
namespace {

struct FreeContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

void check_spng(int status, const std::string& where) {
    if (status != 0) throw Error(where, std::string("PNG: ") + spng_strerror(status));
}

struct PngSize {
    std::uint32_t width, height;
};

// Opens `bytes` for decoding, and refuses what has more than `most_pixels`.
PngSize open_png(spng_ctx* context, std::span<const std::uint8_t> bytes, std::uint64_t most_pixels,
                 const std::string& where) {
    constexpr std::size_t kLargestChunk = std::size_t{1} << 26;
    check_spng(spng_set_png_buffer(context, bytes.data(), bytes.size()), where);
    check_spng(spng_set_chunk_limits(context, kLargestChunk, kLargestChunk), where);
    spng_ihdr header;
    check_spng(spng_get_ihdr(context, &header), where);
    check_image_size(header.width, header.height, most_pixels, where);
    return {header.width, header.height};
}

std::uint8_t to_byte(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

bool is_png(std::span<const std::uint8_t> bytes) {
    constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

Texture decode_png(std::span<const std::uint8_t> bytes, const std::string& where) {
    const Context context(spng_ctx_new(0));
    if (!context) throw Error(where, "PNG: out of memory");
    const PngSize size = open_png(context.get(), bytes, kMaxTexturePixels, where);
    Texture texture;
    texture.width = static_cast<int>(size.width);
    texture.height = static_cast<int>(size.height);
    texture.texels.resize(std::size_t{size.width} * size.height);
    check_spng(spng_decode_image(context.get(), texture.texels.data(), 4 * texture.texels.size(),
                                 SPNG_FMT_RGBA8, SPNG_DECODE_TRNS),
               where);
    return texture;
}

Image decode_png_linear(std::span<const std::uint8_t> bytes, const std::string& where) {
    const Context context(spng_ctx_new(0));
    if (!context) throw Error(where, "PNG: out of memory");
    const PngSize size = open_png(context.get(), bytes, kMaxPicturePixels, where);
    std::vector<std::array<std::uint16_t, 4>> pixels(std::size_t{size.width} * size.height);
    check_spng(spng_decode_image(context.get(), pixels.data(), 8 * pixels.size(), SPNG_FMT_RGBA16,
                                 SPNG_DECODE_TRNS),
               where);
    Image image(static_cast<int>(size.width), static_cast<int>(size.height));
    const auto linear = [](std::uint16_t s) {
        return srgb_to_linear(static_cast<float>(s) / 65535.0f);
    };
    std::ranges::transform(pixels, image.pixels.begin(), [&](const auto& p) {
        return Rgb(linear(p[0]), linear(p[1]), linear(p[2]));
    });
    return image;
}

std::string encode_png(const Image& image, const std::string& where) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const Rgb& pixel : image.pixels)
        for (int i = 0; i < 3; ++i)
            bytes.push_back(std::isnan(pixel[i]) ? std::uint8_t{0} : to_byte(pixel[i]));

    const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
    if (!context) throw Error(where, "PNG: out of memory");
    spng_ihdr header = {};
    header.width = static_cast<std::uint32_t>(image.width);
    header.height = static_cast<std::uint32_t>(image.height);
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    check_spng(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1), where);
    check_spng(spng_set_ihdr(context.get(), &header), where);
    check_spng(spng_set_srgb(context.get(), 0), where);
    check_spng(spng_encode_image(context.get(), bytes.data(), bytes.size(), SPNG_FMT_PNG,
                                 SPNG_ENCODE_FINALIZE),
               where);
    std::size_t length = 0;
    int status = 0;
    const std::unique_ptr<void, void (*)(void*)> encoded(
        spng_get_png_buffer(context.get(), &length, &status), std::free);
    check_spng(status, where);
    return std::string(static_cast<const char*>(encoded.get()), length);
}

}  // namespace chiaro
