// libjpeg reports errors by jumping out of its calls; no object with a destructor lives in a frame
// that is jumped over.

#include "import/fault.h"
#include "import/image_codecs.h"

#include <csetjmp>
#include <cstdio>
// jpeglib.h needs FILE and size_t declared before it.
#include <jpeglib.h>

#include <jerror.h>

#include <array>

namespace chiaro {
namespace {

constexpr int kMaxScans = 200;  // a progressive file of a few bytes can ask for hours of scans

// What libjpeg's callbacks see of the decoding they belong to: `base` must come first.
struct Faults {
    jpeg_error_mgr base;
    std::jmp_buf escape;
    std::array<char, JMSG_LENGTH_MAX> message;
};

void leave(j_common_ptr info) {
    auto* faults = reinterpret_cast<Faults*>(info->err);
    faults->base.format_message(info, faults->message.data());
    std::longjmp(faults->escape, 1);
}

// libjpeg goes on after a warning. Stray bytes and odd headers do no harm; after cut or corrupt
// data the pixels would be made up.
void heed_warning(j_common_ptr info, int level) {
    const int code = info->err->msg_code;
    const bool harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM ||
                          code == JWRN_JFIF_MAJOR || code == JWRN_TOO_MUCH_DATA;
    if (level < 0 && !harmless) leave(info);
}

void limit_scans(j_common_ptr info) {
    const auto* decoder = reinterpret_cast<j_decompress_ptr>(info);
    if (decoder->input_scan_number <= kMaxScans) return;
    auto* faults = reinterpret_cast<Faults*>(info->err);
    std::snprintf(faults->message.data(), faults->message.size(), "too many scans");
    std::longjmp(faults->escape, 1);
}

struct Decoder {
    jpeg_decompress_struct info = {};
    jpeg_progress_mgr progress = {};
    Faults faults = {};

    Decoder() {
        info.err = jpeg_std_error(&faults.base);
        faults.base.error_exit = leave;
        faults.base.emit_message = heed_warning;
        progress.progress_monitor = limit_scans;
    }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { jpeg_destroy_decompress(&info); }
};

// Reads the header and asks for grey, RGB or CMYK output. False: `faults.message` says why not.
bool read_header(Decoder& decoder, std::span<const std::uint8_t> bytes) {
    if (setjmp(decoder.faults.escape)) return false;
    jpeg_create_decompress(&decoder.info);
    decoder.info.progress = &decoder.progress;
    jpeg_mem_src(&decoder.info, bytes.data(), bytes.size());
    jpeg_read_header(&decoder.info, TRUE);
    const int channels = decoder.info.num_components;
    decoder.info.out_color_space = channels == 4   ? JCS_CMYK
                                   : channels == 1 ? JCS_GRAYSCALE
                                                   : JCS_RGB;
    return true;
}

// Decodes into `pixels`, rows of `row_bytes` from the top.
bool read_rows(Decoder& decoder, std::uint8_t* pixels, std::size_t row_bytes) {
    if (setjmp(decoder.faults.escape)) return false;
    jpeg_start_decompress(&decoder.info);
    while (decoder.info.output_scanline < decoder.info.output_height) {
        JSAMPROW row = pixels + decoder.info.output_scanline * row_bytes;
        jpeg_read_scanlines(&decoder.info, &row, 1);
    }
    jpeg_finish_decompress(&decoder.info);
    return true;
}

using Texel = std::array<std::uint8_t, 4>;

Texel from_cmyk(const std::uint8_t* cmyk, bool inverted) {
    Texel texel = {0, 0, 0, 255};
    const int black = inverted ? cmyk[3] : 255 - cmyk[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const int ink = inverted ? cmyk[i] : 255 - cmyk[i];
        texel[i] = static_cast<std::uint8_t>(ink * black / 255);
    }
    return texel;
}

}  // namespace

bool is_jpeg(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

Texture decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& where) {
    Decoder decoder;
    const auto refuse = [&] {
        throw Error(where, "JPEG: " + printable(decoder.faults.message.data()));
    };
    if (!read_header(decoder, bytes)) refuse();
    const std::size_t width = decoder.info.image_width;
    const std::size_t height = decoder.info.image_height;
    check_image_size(width, height, kMaxTexturePixels, where);
    const std::size_t channels = decoder.info.out_color_space == JCS_CMYK        ? 4
                                 : decoder.info.out_color_space == JCS_GRAYSCALE ? 1
                                                                                 : 3;
    std::vector<std::uint8_t> pixels(width * height * channels);
    if (!read_rows(decoder, pixels.data(), width * channels)) refuse();

    Texture texture;
    texture.width = static_cast<int>(width);
    texture.height = static_cast<int>(height);
    texture.texels.reserve(width * height);
    const bool inverted = decoder.info.saw_Adobe_marker;  // Adobe stores ink as its absence
    for (const std::uint8_t* p = pixels.data(); p != pixels.data() + pixels.size(); p += channels)
        texture.texels.push_back(channels == 4   ? from_cmyk(p, inverted)
                                 : channels == 1 ? Texel{p[0], p[0], p[0], 255}
                                                 : Texel{p[0], p[1], p[2], 255});
    return texture;
}

}  // namespace chiaro
