#include "import/fault.h"
#include "import/image_codecs.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>

namespace chiaro {
namespace {

constexpr std::array kChannels = {"R", "G", "B"};

// A file in memory, as OpenEXR reads it.
class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(const std::string& bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char out[], int count) override {
        const auto wanted = static_cast<std::uint64_t>(std::max(count, 0));
        if (wanted > bytes_.size() || position_ > bytes_.size() - wanted)
            throw std::runtime_error("the file ends too early");
        std::memcpy(out, bytes_.data() + position_, wanted);
        position_ += wanted;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    const std::string& bytes_;
    std::uint64_t position_ = 0;
};

// A file in memory, as OpenEXR writes it.
class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream("memory") {}
    void write(const char in[], int count) override {
        const auto length = static_cast<std::size_t>(count);
        if (bytes.size() < position_ + length) bytes.resize(position_ + length);
        std::memcpy(bytes.data() + position_, in, length);
        position_ += length;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::string bytes;

private:
    std::uint64_t position_ = 0;
};

Image read_pixels(Imf::InputFile& file, const std::string& where) {
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width <= 0 || height <= 0) throw Error(where, "the picture has no pixels");
    check_image_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height),
                     kMaxPicturePixels, where);

    const Imf::ChannelList& channels = file.header().channels();
    const bool colored = channels.findChannel("R") != nullptr;
    if (!colored && channels.findChannel("Y") == nullptr)
        throw Error(where, "OpenEXR: there are neither channels R, G, B nor a channel Y");
    for (const char* name : {"R", "G", "B", "Y"}) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (channel != nullptr && (channel->xSampling != 1 || channel->ySampling != 1))
            throw Error(where, "OpenEXR: subsampled channels are not supported");
    }

    Image image(static_cast<int>(width), static_cast<int>(height));
    Imf::FrameBuffer frame;
    for (std::size_t i = 0; i < (colored ? 3u : 1u); ++i)
        frame.insert(colored ? kChannels[i] : "Y",
                     Imf::Slice::Make(Imf::FLOAT, &image.pixels[0][static_cast<int>(i)], window,
                                      sizeof(Rgb), sizeof(Rgb) * image.width));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    if (!colored)
        for (Rgb& pixel : image.pixels) pixel = Rgb(pixel.r);
    return image;
}

}  // namespace

bool is_exr(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 4 && bytes[0] == 0x76 && bytes[1] == 0x2f && bytes[2] == 0x31 &&
           bytes[3] == 0x01;
}

Image decode_exr(const std::string& bytes, const std::string& where) {
    try {
        Imf::Header::setMaxImageSize(kMaxImageSide, kMaxImageSide);
        Imf::Header::setMaxTileSize(kMaxImageSide, kMaxImageSide);
        MemoryInput input(bytes);
        Imf::InputFile file(input, 0);
        return read_pixels(file, where);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& fault) {
        throw Error(where, "OpenEXR: " + printable(fault.what()));
    }
}

std::string encode_exr(const Image& image, const std::string& where) {
    try {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        // Frame buffers serve reading too, so they take no const.
        Imf::FrameBuffer frame;
        char* const samples = reinterpret_cast<char*>(const_cast<Rgb*>(image.pixels.data()));
        for (std::size_t i = 0; i < 3; ++i) {
            const char* const name = kChannels[i];
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice(Imf::FLOAT, samples + i * sizeof(float), sizeof(Rgb),
                                          sizeof(Rgb) * image.width));
        }
        MemoryOutput output;
        {
            Imf::OutputFile file(output, header, 0);
            file.setFrameBuffer(frame);
            file.writePixels(image.height);
        }
        return std::move(output.bytes);
    } catch (const std::exception& fault) {
        throw Error(where, "OpenEXR: " + printable(fault.what()));
    }
}

}  // namespace chiaro
