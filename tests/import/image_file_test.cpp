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

// A PNG file that says to be `width` x `height`. These are at bytes 16 and 20, and the checksum of
// bytes 12 to 28 is at 29 (PNG specification, 5.5 and annex D).
std::string png_of(std::uint32_t width, std::uint32_t height) {
    const TempFolder folder;
    folder.write_picture("p.png");
    std::string png = read_text(folder.path() / "p.png");
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (int i = 0; i < 4; ++i) png[at + i] = static_cast<char>(value >> (24 - 8 * i));
    };
    put(16, width);
    put(20, height);
    std::uint32_t crc = 0xffff'ffff;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= static_cast<std::uint8_t>(png[i]);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb8'8320 : 0);
    }
    put(29, ~crc);
    return png;
}

TEST(ImageFile, PicturesThatAreTooLargeAreRefusedBeforeTheyAreDecoded) {
    const TempFolder folder;
    const auto too_large = [](const std::string& fault) {
        return fault.find("too large") != std::string::npos;
    };
    const auto as_texture = [&](std::uint32_t width, std::uint32_t height) {
        return fault_of([&] { read_texture(as_bytes(png_of(width, height)), "p"); });
    };
    const auto as_picture = [&](std::uint32_t width, std::uint32_t height) {
        const auto file = folder.write("p.png", png_of(width, height));
        return fault_of([&] { read_image(file); });
    };
    EXPECT_EQ(as_texture(2, 1), "");  // the checksum is right
    EXPECT_TRUE(too_large(as_texture(32768, 1)));
    EXPECT_TRUE(too_large(as_texture(16384, 4097)));
    EXPECT_TRUE(too_large(as_picture(16385, 1)));
    EXPECT_TRUE(too_large(as_picture(8192, 4097)));
    // As large as render writes: it is another fault that so few bytes are not so many pixels.
    EXPECT_TRUE(as_picture(8192, 4096).find("PNG") != std::string::npos);
    EXPECT_FALSE(too_large(as_picture(8192, 4096)));

    std::string jpeg = *decode_data_uri("data:image/jpeg;base64," + std::string(kJpegBase64), "");
    const std::size_t frame = jpeg.find("\xff\xc0");
    jpeg.replace(frame + 5, 4, "\x7f\xff\x7f\xff");
    EXPECT_TRUE(too_large(fault_of([&] { read_texture(as_bytes(jpeg), "j"); })));
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

// What is replaced keeps its permissions and stays where it is, behind whatever link.
TEST(ImageFile, AReplacedFileKeepsItsPlaceAndItsPermissions) {
    const TempFolder folder;
    const auto kept = folder.write("real/kept.png", "old");
    const auto link = folder.path() / "link.png";
    std::filesystem::create_symlink(kept, link);
    using std::filesystem::perms;
    std::filesystem::permissions(kept, perms::owner_read | perms::owner_write);
    write_png(link, gradient(3, 2));
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(read_image(kept).width, 3);
    EXPECT_EQ(std::filesystem::status(kept).permissions(), perms::owner_read | perms::owner_write);
    for (const char* place : {"real", "."})
        for (const auto& entry : std::filesystem::directory_iterator(folder.path() / place))
            EXPECT_NE(entry.path().filename().string()[0], '.') << "left behind";
}

TEST(ImageFile, ANameAsLongAsTheSystemAllowsCanBeWritten) {
    const TempFolder folder;
    const auto name = [](std::size_t length) { return std::string(length - 4, 'a') + ".png"; };
    EXPECT_EQ(fault_of([&] { check_writable(folder.path() / name(255)); }), "");
    write_png(folder.path() / name(255), gradient(2, 2));
    EXPECT_NE(fault_of([&] { check_writable(folder.path() / name(256)); }), "");
}

TEST(ImageFile, AFileThatIsNoPictureIsRefused) {
    const TempFolder folder;
    EXPECT_NE(fault_of([&] { read_image(folder.write("a.exr", "hello")); }), "");
    EXPECT_NE(fault_of([&] { read_image(folder.write("a.exr", "")); }), "");
    EXPECT_NE(fault_of([&] { read_image(folder.path() / "none.exr"); }), "");
}

}  // namespace
}  // namespace chiaro
