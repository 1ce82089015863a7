#include "import/image_file.h"

#include "import/data_uri.h"
#include "import/import_testing.h"

#include <sys/stat.h>

#include <cmath>
#include <limits>

namespace chiaro {
namespace {

std::span<const std::uint8_t> as_bytes(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = Rgb(static_cast<float>(x) / static_cast<float>(width),
                                 static_cast<float>(y) / static_cast<float>(height), 0.5f);
    return image;
}

TEST(ImageFile, AnExrFileKeepsEveryFloat) {
    const TempFolder folder;
    Image image = gradient(7, 5);
    image.at(3, 2) = Rgb(1e6f, 1e-6f, 0);
    write_exr(folder.path() / "a.exr", image);
    const Image read = read_image(folder.path() / "a.exr");
    EXPECT_EQ(read.width, 7);
    EXPECT_EQ(read.height, 5);
    EXPECT_EQ(read.pixels, image.pixels);
}

TEST(ImageFile, AnExrFileOfHalvesKeepsElevenBitsAndNoInfinity) {
    const TempFolder folder;
    Image image = gradient(4, 4);
    image.at(0, 0) = Rgb(1e6f, 1000.3f, 0);
    write_exr(folder.path() / "a.exr", image, ExrDepth::half);
    const Image read = read_image(folder.path() / "a.exr");
    EXPECT_EQ(read.at(0, 0).r, 65504.0f);
    EXPECT_NEAR(read.at(0, 0).g, 1000.3f, 0.5f);
}

TEST(ImageFile, APngFileKeepsEncodedValuesAndIsReadBackLinear) {
    const TempFolder folder;
    Image image(3, 1);
    image.at(0, 0) = Rgb(0.5f, 2.0f, -1.0f);
    image.at(1, 0) = Rgb(std::numeric_limits<float>::quiet_NaN(), 1, kInfinity);
    write_png(folder.path() / "a.png", image);
    const Image read = read_image(folder.path() / "a.png");
    EXPECT_NEAR(read.at(0, 0).r, srgb_to_linear(128 / 255.0f), 1e-6f);
    EXPECT_EQ(read.at(0, 0).g, 1);
    EXPECT_EQ(read.at(0, 0).b, 0);
    EXPECT_EQ(read.at(1, 0), Rgb(0, 1, 1));
}

TEST(ImageFile, ATextureIsToldByItsBytes) {
    const TempFolder folder;
    folder.write_picture("p.png");
    const std::string png = read_text(folder.path() / "p.png");
    const Texture p = read_texture(as_bytes(png), "p");
    EXPECT_EQ(p.width, 2);
    EXPECT_EQ(p.texels[0], (std::array<std::uint8_t, 4>{255, 0, 0, 255}));

    const std::string jpeg =
        *decode_data_uri("data:image/jpeg;base64," + std::string(kJpegBase64), "");
    const Texture j = read_texture(as_bytes(jpeg), "j");
    EXPECT_EQ(j.width, 8);
    EXPECT_EQ(j.height, 8);
    EXPECT_NEAR(j.texels[9][0], 200, 3);
    EXPECT_NEAR(j.texels[9][1], 100, 3);
    EXPECT_NEAR(j.texels[9][2], 50, 3);
    EXPECT_EQ(j.texels[9][3], 255);
}

TEST(ImageFile, CutPicturesAreRefused) {
    const TempFolder folder;
    folder.write_picture("p.png");
    write_exr(folder.path() / "p.exr", gradient(16, 16));
    const std::string png = read_text(folder.path() / "p.png");
    const std::string exr = read_text(folder.path() / "p.exr");
    const std::string jpeg =
        *decode_data_uri("data:image/jpeg;base64," + std::string(kJpegBase64), "");
    // The last 20 bytes of a PNG, and 4 of a JPEG, come after all pixels.
    for (std::size_t n = 0; n + 20 < png.size(); ++n)
        EXPECT_NE(fault_of([&] { read_texture(as_bytes(png.substr(0, n)), "p"); }), "") << n;
    for (std::size_t n = 0; n + 4 < jpeg.size(); ++n)
        EXPECT_NE(fault_of([&] { read_texture(as_bytes(jpeg.substr(0, n)), "j"); }), "") << n;
    for (std::size_t n = 0; n < exr.size(); n += 7)
        EXPECT_NE(fault_of([&] { read_image(folder.write("c.exr", exr.substr(0, n))); }), "") << n;
}

TEST(ImageFile, PicturesThatAreTooLargeAreRefusedBeforeTheyAreDecoded) {
    const TempFolder folder;
    folder.write_picture("p.png");
    std::string png = read_text(folder.path() / "p.png");
    // Width and height are at bytes 16 and 20, the checksum at 29: of 32768 x 1, made beforehand.
    png.replace(16, 8, std::string("\x00\x00\x80\x00\x00\x00\x00\x01", 8));
    EXPECT_NE(fault_of([&] { read_texture(as_bytes(png), "p"); }), "");
    std::string jpeg = *decode_data_uri("data:image/jpeg;base64," + std::string(kJpegBase64), "");
    const std::size_t frame = jpeg.find("\xff\xc0");
    jpeg.replace(frame + 5, 4, "\x7f\xff\x7f\xff");
    EXPECT_NE(fault_of([&] { read_texture(as_bytes(jpeg), "j"); }).find("too large"),
              std::string::npos);
}

TEST(ImageFile, MutatedPicturesAreReadOrRefused) {
    const TempFolder folder;
    folder.write_picture("p.png");
    write_exr(folder.path() / "p.exr", gradient(6, 6));
    std::uint32_t state = 1;
    const auto next = [&state](std::size_t bound) {
        state = state * 1664525u + 1013904223u;
        return (state >> 8) % bound;
    };
    for (const std::string& original :
         {read_text(folder.path() / "p.png"), read_text(folder.path() / "p.exr"),
          *decode_data_uri("data:;base64," + std::string(kJpegBase64), "")})
        for (int trial = 0; trial < 300; ++trial) {
            std::string bytes = original;
            for (std::size_t flips = 1 + next(4); flips > 0; --flips)
                bytes[next(bytes.size())] = static_cast<char>(next(256));
            fault_of([&] { read_texture(as_bytes(bytes), "t"); });
            fault_of([&] { read_image(folder.write("m", bytes)); });
        }
}

TEST(ImageFile, AnUnwritableTargetIsToldBeforehandAndNothingIsLost) {
    const TempFolder folder;
    const auto fault = [&](const std::filesystem::path& file) {
        return fault_of([&] { check_writable(file); });
    };
    EXPECT_EQ(fault(folder.path() / "new.png"), "");
    EXPECT_EQ(fault(folder.path() / "new.EXR"), "");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_NE(fault(folder.path() / "new.jpg").find("neither"), std::string::npos);
    EXPECT_NE(fault(folder.path() / "new"), "");
    EXPECT_NE(fault(folder.path() / "none" / "a.png").find("no folder"), std::string::npos);
    std::filesystem::create_directory(folder.path() / "dir.png");
    EXPECT_NE(fault(folder.path() / "dir.png").find("is a folder"), std::string::npos);

    const auto kept = folder.write("kept.png", "precious");
    EXPECT_EQ(fault(kept), "");
    EXPECT_EQ(read_text(kept), "precious");
    EXPECT_NE(fault(folder.path() / "kept.png" / "a.png"), "");
    write_png(kept, gradient(2, 2));
    EXPECT_EQ(read_image(kept).width, 2);
    EXPECT_NE(fault("/proc/a.png"), "");
}

TEST(ImageFile, AFileThatIsNoPictureIsRefused) {
    const TempFolder folder;
    EXPECT_NE(fault_of([&] { read_image(folder.write("a.exr", "hello")); }), "");
    EXPECT_NE(fault_of([&] { read_image(folder.write("a.exr", "")); }), "");
    EXPECT_NE(fault_of([&] { read_image(folder.path() / "none.exr"); }), "");
}

}  // namespace
}  // namespace chiaro
