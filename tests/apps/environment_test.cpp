// --environment and --sky, as users give them.
#include "apps/command.h"

#include <nlohmann/json.hpp>

namespace chiaro {
namespace {

// A floor of 2 m that reflects half, looked at by a camera over it.
std::string floor_in(const TempFolder& folder) {
    folder.write("floor.mtl", "newmtl half\nKd .5 .5 .5\n");
    return folder
        .write("floor.obj",
               "mtllib floor.mtl\nusemtl half\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")
        .string();
}

std::vector<double> numbers(const std::string& text) {
    std::istringstream words(text);
    std::vector<double> values;
    for (double value; words >> value;) values.push_back(value);
    return values;
}

// pi L on the floor; half of L from it; L from where nothing is. 128 samples hold no chance.
TEST(EnvironmentOptions, TraceMeasuresTheSky) {
    const TempFolder folder;
    const std::string file = floor_in(folder);
    const auto lux =
        numbers(expect_done({"trace", file, "-I", "--sky", "1,2,3", "--direct-samples", "128"},
                            "0 0.001 0 0 1 0\n")
                    .out);
    ASSERT_EQ(lux.size(), 3u);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lux[c] / (double(kPi) * (c + 1)), 1, 1e-4);

    const auto seen =
        numbers(expect_done({"trace", file, "--sky", "1,2,3"}, "0 1 0 0 -1 0\n0 1 0 0 1 0\n").out);
    ASSERT_EQ(seen.size(), 6u);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(seen[c] / (0.5 * (c + 1)), 1, 0.05);
        EXPECT_NEAR(seen[3 + c], c + 1, 1e-5);
    }
}

// One map, in both kinds of files, gives one picture; and the vertical is that of the map.
TEST(EnvironmentOptions, BothKindsOfFilesAreRead) {
    const TempFolder folder;
    const std::string file = floor_in(folder);
    Image map(4, 2);
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
    for (int i = 0; i < 8; ++i) {
        map.pixels[i] = Rgb(float(i) / 8, 0.5f, i < 4 ? 1 : 0);
        const Rgb mantissas = 128.0f * map.pixels[i];
        for (int c = 0; c < 3; ++c) hdr += static_cast<char>(mantissas[c]);
        hdr += static_cast<char>(129);
    }
    write_exr(folder.path() / "m.exr", map);
    const std::string files[] = {(folder.path() / "m.exr").string(),
                                 folder.write("m.hdr", hdr).string()};
    const std::string rays = "0 1 0 1 1 0\n0 1 0 0 0 1\n";
    std::string answers[2];
    for (int i = 0; i < 2; ++i)
        answers[i] = expect_done({"trace", file, "--environment", files[i]}, rays).out;
    EXPECT_EQ(answers[0], answers[1]);
    const auto z_up =
        numbers(expect_done({"trace", file, "--up", "0,0,1", "--environment", files[0]}, rays).out);
    ASSERT_EQ(z_up.size(), 6u);
    EXPECT_EQ(z_up[5], 1);  // +z is at the top of the map
}

TEST(EnvironmentOptions, ASceneUnderTheSkyNeedsNoHeadlamp) {
    const TempFolder folder;
    const std::string output = (folder.path() / "a.exr").string();
    const Arguments view = {"--eye",  "0,2,0.5", "--target", "0,0,0",
                            "--size", "32x24",   "-o",       output};
    const auto run = [&](Arguments arguments) {
        arguments.insert(arguments.end(), view.begin(), view.end());
        return expect_done(arguments);
    };
    const std::string file = floor_in(folder);
    EXPECT_NE(run({"render", file, "--samples", "500", "--sky", "0,0,0"}).err.find("no light"),
              std::string::npos);
    const Arguments commands[] = {{"render", file, "--samples", "2000", "--sky", "2,2,2"},
                                  {"reference", file, "--spp", "64", "--sky", "2,2,2"}};
    for (const Arguments& command : commands) {
        EXPECT_EQ(run(command).err, "");
        const Image picture = read_image(output);
        EXPECT_NEAR(picture.at(16, 12).g, 1, 0.1) << command[0];
        EXPECT_NEAR(picture.at(0, 0).g, 2, 1e-5) << command[0];
    }
}

// White metal in an even sky: nothing can be seen of it.
TEST(EnvironmentOptions, ARealSceneUnderTheSky) {
    const std::filesystem::path file =
        std::filesystem::path(CHIARO_SCENES) / "gltf_small" / "03_all_animations.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
    const TempFolder folder;
    const std::string output = (folder.path() / "a.exr").string();
    expect_done({"render", file.string(), "--sky", "1,1,1", "--samples", "4000", "--size", "80x60",
                 "--eye", "8,5,8", "--target", "0,1,-2", "-o", output});
    double sum = 0;
    for (const Rgb& p : read_image(output).pixels) sum += double(luminance(p));
    EXPECT_NEAR(sum / (80 * 60), 1, 0.01);
}

TEST(EnvironmentOptions, InfoTellsOfIt) {
    const TempFolder folder;
    const std::string file = floor_in(folder);
    const auto described = [&](const Arguments& options) {
        Arguments arguments = {"info", "--json", file};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return nlohmann::json::parse(expect_done(arguments).out)["environment"];
    };
    EXPECT_TRUE(described({}).is_null());
    EXPECT_EQ(described({"--sky", "1,2,3"}).dump(),
              R"({"map":null,"mean_radiance":[1.0,2.0,3.0]})");
    write_exr(folder.path() / "m.exr", Image(8, 4));
    EXPECT_TRUE(described({"--environment", (folder.path() / "m.exr").string()}).is_null());
    Image even(8, 4);
    for (Rgb& pixel : even.pixels) pixel = Rgb(0.5f);
    write_exr(folder.path() / "m.exr", even);
    EXPECT_EQ(described({"--environment", (folder.path() / "m.exr").string()})["map"].dump(),
              "[8,4]");
}

TEST(EnvironmentOptions, EachFaultIsNamed) {
    const TempFolder folder;
    const std::string file = floor_in(folder);
    const std::string text = folder.write("no.hdr", "hello").string();
    expect_refused({"info", file, "--sky", "1,1"}, "--sky");
    expect_refused({"info", file, "--sky", "1,-1,1"}, "below 0");
    expect_refused({"info", file, "--sky", "1,nan,1"}, "--sky");
    expect_refused({"info", file, "--sky", "2e15,1,1"}, "brighter than 1e15");
    expect_refused({"trace", file, "--environment", text}, "no.hdr");
    expect_refused({"trace", file, "--environment", "nowhere.exr"}, "nowhere.exr");
    expect_refused({"trace", file, "--environment", text, "--sky", "1,1,1"},
                   "--environment and --sky");
    Image bad(2, 2);
    bad.at(1, 0).b = -1;
    write_exr(folder.path() / "bad.exr", bad);
    expect_refused({"reference", file, "-o", (folder.path() / "a.exr").string(), "--environment",
                    (folder.path() / "bad.exr").string()},
                   "bad.exr: pixel (1, 0) is negative");
}

}  // namespace
}  // namespace chiaro
