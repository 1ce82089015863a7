// Radiance pictures: every coding and orientation, what the header says of values, and files with
// faults.
#include "base/random.h"
#include "import/image_codecs.h"
#include "import/import_testing.h"
#include "import/load_environment.h"

#include <array>

namespace chiaro {
namespace {

using Quad = std::array<int, 4>;

std::string bytes_of_quad(Quad q) {
    std::string bytes;
    for (const int b : q) bytes += static_cast<char>(b);
    return bytes;
}

// Ten different pixels and a run of six: `length` of them, or that many times the seventh.
Quad pixel(int x) {
    return x < 10 ? Quad{10 * x, 200 - x, x == 3 ? 0 : 128, 120 + x} : Quad{7, 8, 9, 130};
}
constexpr int kWidth = 16;

std::string header(const std::string& size, const std::string& lines = "") {
    return "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n" + lines + "\n" + size + "\n";
}

// A row of kWidth pixels in each of the three codings.
std::string flat_row() {
    std::string row;
    for (int x = 0; x < kWidth; ++x) row += bytes_of_quad(pixel(x));
    return row;
}
std::string old_row() {
    std::string row;
    for (int x = 0; x <= 10; ++x) row += bytes_of_quad(pixel(x));
    return row + bytes_of_quad({1, 1, 1, 5});
}
std::string new_row() {
    std::string row = bytes_of_quad({2, 2, 0, kWidth});
    for (int channel = 0; channel < 4; ++channel) {
        row += char(10);
        for (int x = 0; x < 10; ++x) row += static_cast<char>(pixel(x)[channel]);
        row += char(128 + 6);
        row += static_cast<char>(pixel(10)[channel]);
    }
    return row;
}

Image read(const std::string& bytes) {
    return decode_hdr(bytes, "a.hdr");
}
std::string fault(const std::string& bytes) {
    return fault_of([&] { read(bytes); });
}

TEST(ImageHdr, EachCodingOfAScanlineGivesItsPixels) {
    const TempFolder folder;
    const Image image = read_image(
        folder.write("a.hdr", header("-Y 3 +X 16") + flat_row() + old_row() + new_row()));
    ASSERT_EQ(image.width, kWidth);
    ASSERT_EQ(image.height, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(double(image.at(x, y)[c]),
                          pixel(x)[c] * std::pow(2.0, pixel(x)[3] - 136.0));
}

// (128, 128, 128, 129) is 1; without an exponent all is black.
TEST(ImageHdr, AnExponentIsAPowerOfTwo) {
    const Image image = read(header("-Y 1 +X 4") + bytes_of_quad({128, 128, 64, 129}) +
                             bytes_of_quad({9, 9, 9, 0}) + bytes_of_quad({255, 0, 0, 255}) +
                             bytes_of_quad({1, 255, 3, 1}));
    EXPECT_EQ(image.at(0, 0), Rgb(1, 1, 0.5f));
    EXPECT_EQ(image.at(1, 0), Rgb(0));
    EXPECT_EQ(image.at(2, 0), Rgb(255 * 0x1p119f, 0, 0));
    EXPECT_EQ(image.at(3, 0), Rgb(0x1p-135f, 255 * 0x1p-135f, 3 * 0x1p-135f));
}

// Old runs longer than 255 are digits: 1 + (44 + 256) pixels.
TEST(ImageHdr, OldRunsCountInDigits) {
    const Image image =
        read(header("-Y 1 +X 302") + bytes_of_quad({9, 9, 9, 129}) + bytes_of_quad({1, 1, 1, 44}) +
             bytes_of_quad({1, 1, 1, 1}) + bytes_of_quad({128, 0, 0, 129}));
    EXPECT_EQ(image.at(300, 0), Rgb(9 / 128.0f));
    EXPECT_EQ(image.at(301, 0), Rgb(1, 0, 0));
}

// A picture of 3 x 2 pixels, 0 1 2 over 3 4 5, in all ways in which Radiance may write it.
TEST(ImageHdr, EachOrientationShowsTheSamePicture) {
    const std::pair<const char*, const char*> table[] = {
        {"-Y 2 +X 3", "012345"}, {"-Y 2 -X 3", "210543"}, {"+Y 2 +X 3", "345012"},
        {"+Y 2 -X 3", "543210"}, {"+X 3 -Y 2", "031425"}, {"+X 3 +Y 2", "304152"},
        {"-X 3 -Y 2", "251403"}, {"-X 3 +Y 2", "524130"}};
    for (const auto& [size, pixels] : table) {
        std::string bytes = header(size);
        for (const char* p = pixels; *p != 0; ++p) bytes += bytes_of_quad({*p - '0', 0, 0, 136});
        const Image image = read(bytes);
        ASSERT_EQ(image.width, 3) << size;
        ASSERT_EQ(image.height, 2) << size;
        for (int i = 0; i < 6; ++i)
            EXPECT_EQ(image.pixels[i].r, float(i)) << size << " pixel " << i;
    }
}

TEST(ImageHdr, ExposuresAndColourCorrectionsAreUndone) {
    const Image image = read(header("-Y 1 +X 1",
                                    "EXPOSURE=2\nVIEW= -vtv\nEXPOSURE= 4.0\r\n"
                                    "COLORCORR= 1 2 .5\n\tEXPOSURE=77\n") +
                             bytes_of_quad({128, 128, 128, 129}));
    EXPECT_EQ(image.at(0, 0), Rgb(1 / 8.0f, 1 / 16.0f, 1 / 4.0f));
}

// D65 white in CIE XYZ is white; a colour beyond Rec. 709 has no negative channels.
TEST(ImageHdr, XyzIsConverted) {
    const std::string start = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n";
    const Image image =
        read(start + bytes_of_quad({122, 128, 139, 129}) + bytes_of_quad({0, 128, 0, 129}));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(0, 0)[c], 1, 0.015);  // mantissas of 7 bits
    EXPECT_EQ(image.at(1, 0).r, 0);
    EXPECT_NEAR(image.at(1, 0).g, 1.8758, 1e-4);
}

TEST(ImageHdr, TheFormatMayBeLeftOutAndTheSignatureMayBeThatOfOtherPrograms) {
    const std::string one = bytes_of_quad({128, 128, 128, 129});
    EXPECT_EQ(read("#?RADIANCE\n\n-Y 1 +X 1\n" + one).at(0, 0), Rgb(1));
    EXPECT_EQ(read("#?RGBE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 1\n" + one).at(0, 0), Rgb(1));
}

TEST(ImageHdr, EachFaultIsNamedWithItsPlace) {
    const std::string one = bytes_of_quad({128, 128, 128, 129});
    const std::string eight = bytes_of_quad({2, 2, 0, 8});
    const std::pair<std::string, const char*> table[] = {
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe", "a.hdr:2: Radiance: the header does not end"},
        {"#?RADIANCE\nFORMAT=tiff\n\n-Y 1 +X 1\n" + one, "a.hdr:2: Radiance: there is no format"},
        {header("-Y 1 +X 1", "EXPOSURE=0\n") + one, "a.hdr:4: Radiance: '0'"},
        {header("-Y 1 +X 1", "EXPOSURE=nan\n") + one, "a.hdr:4: "},
        {header("-Y 1 +X 1", "COLORCORR=1 2\n") + one, "a.hdr:4: "},
        {header("-Y 1 +X 1", "EXPOSURE=1e30\nEXPOSURE=1e30\n") + one, "exposures together"},
        {header("-Y 1 +X 1", "EXPOSURE=1e-30\n") + bytes_of_quad({9, 0, 0, 255}),
         "pixel (0, 0) is too bright"},
        {header("-Y 1 +Y 1") + one, "a.hdr:5: Radiance: '-Y 1 +Y 1' is no resolution"},
        {header("-Y 1") + one, "resolution"},
        {header("-Y 1 +X 1 +Z 1") + one, "resolution"},
        {header("-Y -1 +X 1") + one, "resolution"},
        {header("-Y 1.5 +X 1") + one, "resolution"},
        {header("Y 1 X 1") + one, "resolution"},
        {header("") + one, "resolution"},
        {header("-Y 0 +X 1") + one, "no pixels"},
        {header("-Y 16385 +X 1") + one, "too large"},
        {header("-Y 16384 +X 16384") + one, "too large"},
        {header("-Y 99999999999999999999 +X 1") + one, "resolution"},
        {header("-Y 2 +X 1") + one, "a.hdr: Radiance: scanline 1: the file ends too early"},
        {header("-Y 1 +X 9") + eight, "not as long as the picture is wide"},
        {header("-Y 1 +X 8") + eight + "\x89x", "run of a wrong length"},
        {header("-Y 1 +X 8") + eight + std::string(9, '\0'), "run of a wrong length"},
        {header("-Y 1 +X 2") + bytes_of_quad({1, 1, 1, 1}) + one, "run of a wrong length"},
        {header("-Y 1 +X 2") + one + bytes_of_quad({1, 1, 1, 2}), "run of a wrong length"},
    };
    for (const auto& [bytes, said] : table)
        EXPECT_NE(fault(bytes).find(said), std::string::npos) << fault(bytes) << " lacks " << said;
}

TEST(ImageHdr, CutFilesAreRefused) {
    const std::string whole = header("-Y 3 +X 16") + flat_row() + old_row() + new_row();
    EXPECT_EQ(fault(whole), "");
    EXPECT_EQ(fault(whole + "more"), "");
    for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_NE(fault(whole.substr(0, n)), "") << n;
}

TEST(ImageHdr, MutatedFilesAreReadOrRefused) {
    const std::string whole =
        header("-Y 3 +X 16", "EXPOSURE=1.5\n") + flat_row() + old_row() + new_row();
    Rng rng(2002);
    int refused = 0;
    constexpr int kCount = 20'000;
    for (int i = 0; i < kCount; ++i) {
        std::string bytes = whole;
        for (std::uint32_t changes = 1 + rng.below(4); changes > 0; --changes) {
            const std::size_t at = rng.below(static_cast<std::uint32_t>(bytes.size()));
            if (rng.below(3) == 0)
                bytes.erase(at, 1 + rng.below(3));
            else
                bytes[at] =
                    static_cast<char>(rng.below(3) == 0 ? '0' + rng.below(10) : rng.below(256));
        }
        refused += fault(bytes).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, kCount);
}

TEST(LoadEnvironment, RefusesWhatIsNoLightAndNamesThePixel) {
    const TempFolder folder;
    const auto fault_with = [&](Rgb odd) {
        Image image(4, 3);
        image.at(2, 1) = odd;
        write_exr(folder.path() / "e.exr", image);
        return fault_of([&] { load_environment(folder.path() / "e.exr"); });
    };
    EXPECT_EQ(fault_with({0, 1e15f, 0}), "");
    EXPECT_NE(fault_with({0, -1e-9f, 1}).find("e.exr: pixel (2, 1) is negative"),
              std::string::npos);
    EXPECT_NE(fault_with({std::nanf(""), 0, 0}).find("(2, 1) is not a number"), std::string::npos);
    EXPECT_NE(fault_with({0, 0, kInfinity}).find("brighter"), std::string::npos);
    EXPECT_NE(fault_with({0, 2e15f, 0}).find("brighter"), std::string::npos);
    const auto bright =
        folder.write("b.hdr", header("-Y 1 +X 1") + bytes_of_quad({128, 0, 0, 200}));
    EXPECT_NE(fault_of([&] { load_environment(bright); }).find("(0, 0) is brighter"),
              std::string::npos);
    EXPECT_NE(fault_of([&] { load_environment(folder.path() / "none.hdr"); }), "");
}

TEST(LoadEnvironment, TakesAPngWithWhiteOfOne) {
    const TempFolder folder;
    folder.write_picture("p.png");
    EXPECT_EQ(load_environment(folder.path() / "p.png").map.at(0, 0), Rgb(1, 0, 0));
}

// Photographs of rooms, as they are shared.
TEST(LoadEnvironment, ReadsRealMaps) {
    const std::filesystem::path folder = std::filesystem::path(CHIARO_SCENES) / "hdr";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    const Environment studio = load_environment(folder / "studio_small_05_256.hdr");
    EXPECT_EQ(studio.map.width, 256);
    EXPECT_EQ(studio.map.height, 128);
    EXPECT_FALSE(is_dark(studio));
    EXPECT_EQ(load_environment(folder / "vestibule_1k.hdr").map.width, 1024);
}

}  // namespace
}  // namespace chiaro
