// chiaro render, diff and info: what they write can be relied on.
#include "apps/command.h"

namespace chiaro {
namespace {

double number(const std::string& json, const char* key) {
    return nlohmann::json::parse(json).at(key).get<double>();
}

// With --samples and a seed the picture is the same bytes on any number of threads; another seed
// gives another.
TEST(Render, TheSameBytesOnAnyNumberOfThreads) {
    const TempFolder folder;
    const auto bytes = [&](const char* threads, const char* seed, const char* scheme) {
        const std::string file = (folder.path() / "a.exr").string();
        expect_done({"render", "builtin:cornell", "--samples", "3000", "--seed", seed, "--size",
                     "160x120", "--threads", threads, "--scheme", scheme, "--indirect-samples",
                     "64", "-o", file});
        return read_text(file);
    };
    for (const char* scheme : {"best", "paper"}) {
        const std::string one = bytes("1", "7", scheme);
        EXPECT_EQ(one, bytes("2", "7", scheme)) << scheme;
        EXPECT_NE(one, bytes("2", "8", scheme)) << scheme;
    }
}

// --stats holds every key that is promised, and figures that agree with one another.
TEST(Render, TheStatisticsHoldWhatIsPromised) {
    const TempFolder folder;
    const std::string file = (folder.path() / "s.json").string();
    for (const char* scheme : {"best", "paper"}) {
        expect_done({"render", "builtin:cornell", "--samples", "2000", "--size", "80x60",
                     "--scheme", scheme, "--indirect-samples", "32", "--stats", file, "-o",
                     (folder.path() / "a.png").string()});
        const auto j = nlohmann::json::parse(read_text(file));
        for (const char* key :
             {"cycles", "points_shaded", "points_per_second", "patches", "vertices",
              "bytes_per_patch", "peak_rss_bytes", "first_picture_seconds"}) {
            ASSERT_TRUE(j.contains(key)) << key;
            EXPECT_GT(j[key].get<double>(), 0) << key;
        }
        double sum = 0;
        for (const char* step : {"sample_selection", "patch_subdivision", "tessellation", "aging",
                                 "update_display_meshes", "rendering"}) {
            ASSERT_TRUE(j["cycle_ms"].contains(step)) << step;
            EXPECT_GE(j["cycle_ms"][step].get<double>(), 0) << step;
            sum += j["cycle_ms"][step].get<double>();
        }
        // The steps are all of a cycle but for what is between them.
        EXPECT_GE(j["cycle_ms"]["total"].get<double>(), (1 - 1e-6) * sum);
        EXPECT_GE(j["points_shaded"].get<int>(), 2000);
    }
}

// An existing picture is replaced; .exr is linear, .png tone-mapped: in [0, 1], and of that size.
TEST(Render, PicturesCanBeRead) {
    const TempFolder folder;
    for (const char* name : {"a.exr", "a.png", "b.EXR", "b.PNG"}) {
        const std::string file = folder.write(name, "old").string();
        expect_done(
            {"render", "builtin:cornell", "--samples", "500", "--size", "48x32", "-o", file});
        const Image picture = read_image(file);
        EXPECT_EQ(picture.width, 48);
        EXPECT_EQ(picture.height, 32);
        float brightest = 0;
        for (const Rgb& p : picture.pixels) {
            EXPECT_TRUE(is_finite(p) && p.r >= 0 && p.g >= 0 && p.b >= 0);
            brightest = std::max(brightest, p.r);
        }
        // The lamp, of 17 cd/m2 in red, is in view.
        if (std::string_view(name).ends_with("g") || std::string_view(name).ends_with("G"))
            EXPECT_LE(brightest, 1);
        else
            EXPECT_GT(brightest, 10);
    }
}

// Two stops more: four times the light before the tone map, so brighter wherever it is not white.
TEST(Render, ExposureBrightens) {
    const TempFolder folder;
    double means[2] = {};
    for (int i = 0; i < 2; ++i) {
        const std::string file = (folder.path() / "a.png").string();
        expect_done({"render", "builtin:cornell", "--samples", "500", "--size", "32x32",
                     "--exposure", i == 0 ? "-2" : "0", "-o", file});
        for (const Rgb& p : read_image(file).pixels) means[i] += double(luminance(p));
    }
    EXPECT_GT(means[1], 1.5 * means[0]);
}

// Ctrl-C, or SIGTERM, ends a long render soon, and what there is is written.
TEST(Render, AnInterruptEndsItWithAPicture) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const TempFolder folder;
        const std::string file = (folder.path() / "a.exr").string();
        Command render(
            {"render", "builtin:cornell", "--time", "60", "--size", "80x60", "-o", file});
        std::this_thread::sleep_for(std::chrono::milliseconds(1000));
        render.send(signal);
        const Outcome outcome = render.finish(20);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_LT(outcome.seconds, 6);
        const Image picture = read_image(file);
        EXPECT_EQ(picture.width, 80);
        EXPECT_GT(luminance(picture.at(40, 40)), 0);
    }
}

// --time is wall time after loading.
TEST(Render, TakesTheTimeItIsGiven) {
    const TempFolder folder;
    const Outcome outcome = expect_done({"render", "builtin:cornell", "--time", "1", "--size",
                                         "80x60", "-o", (folder.path() / "a.exr").string()});
    EXPECT_GT(outcome.seconds, 1);
    EXPECT_LT(outcome.seconds, 10);
}

constexpr char kQuad[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

// A scene without lights gets a lamp at the eye, and says so; `reference` shows the truth: black.
TEST(Render, ASceneWithoutLightsGetsAHeadlamp) {
    const TempFolder folder;
    const std::string scene = folder.write("dark.obj", kQuad).string();
    const std::string file = (folder.path() / "a.exr").string();
    const Arguments rest = {scene,     "-o",       file,      "--size", "16x16", "--eye",
                            ".5,.5,3", "--target", ".5,.5,0", "--vfov", "15"};
    Arguments render = {"render", "--samples", "100"}, reference = {"reference", "--spp", "1"};
    render.insert(render.end(), rest.begin(), rest.end());
    reference.insert(reference.end(), rest.begin(), rest.end());

    const Outcome outcome = expect_done(render);
    EXPECT_NE(outcome.err.find("chiaro: warning: the scene has no light"), std::string::npos);
    for (const Rgb& p : read_image(file).pixels) EXPECT_GT(luminance(p), 0);
    expect_done(reference);
    for (const Rgb& p : read_image(file).pixels) EXPECT_EQ(luminance(p), 0);
}

// So does one whose only lamp is switched off, or whose emission is multiplied by black.
TEST(Render, LightsOfNoIntensityAreNoLights) {
    const TempFolder folder;
    const std::string file = (folder.path() / "a.exr").string();
    const auto expect_headlamp = [&](const std::string& scene) {
        const Outcome outcome =
            expect_done({"render", scene, "-o", file, "--samples", "100", "--size", "8x8", "--eye",
                         ".3,.3,2", "--target", ".3,.3,0", "--vfov", "10"});
        EXPECT_NE(outcome.err.find("the scene has no light"), std::string::npos) << scene;
        for (const Rgb& p : read_image(file).pixels) EXPECT_GT(luminance(p), 0) << scene;
    };
    GltfMaker maker = triangle_gltf();
    maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 0}}};
    maker.root["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
    expect_headlamp(folder.write("off.gltf", maker.text()).string());

    write_png(folder.path() / "black.png", Image(2, 2));
    folder.write("black.mtl", "newmtl m\nKe 9 9 9\nmap_Ke black.png\n");
    expect_headlamp(folder
                        .write("black.obj",
                               "mtllib black.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                               "vt 0 0\nf 1/1 2/1 3/1\n")
                        .string());
}

// A closed room of 2 units a side with a lamp under its ceiling and something on its floor.
constexpr char kRoom[] =
    "mtllib room.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n"
    "v -1 1 1\nv -.3 .9 -.3\nv .3 .9 -.3\nv .3 .9 .3\nv -.3 .9 .3\nv -.6 -1 0\nv 0 -.3 .2\n"
    "v .5 -1 -.2\nusemtl wall\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n"
    "f 13 14 15\nusemtl lamp\nf 9 10 11 12\n";

std::string write_room(const TempFolder& folder, const std::string& emission) {
    folder.write("room.mtl", "newmtl wall\nKd .7 .6 .5\nnewmtl lamp\nKe " + emission + "\n");
    return folder.write("room.obj", kRoom).string();
}

// Radiance does not depend on the unit of length: as far as coordinates go, the picture is the same
// but for rounding. Beyond, and where light grows too bright to square, the file is refused.
TEST(Render, AWorldOfAnySizeThatIsAllowedLooksTheSame) {
    const TempFolder folder;
    const std::string room = write_room(folder, "10");
    const auto at_scale = [&](const char* command, int exponent) {
        const std::string e = "e" + std::to_string(exponent);
        const std::string file = (folder.path() / (std::string(command) + e + ".exr")).string();
        const std::string eye = ".9" + e + ",.2" + e + ",.8" + e,
                          target = "-.3" + e + ",-.5" + e + ",-.5" + e;
        Arguments arguments = {command, room,    "-o", file,       "--scale", "1" + e,  "--size",
                               "32x32", "--eye", eye,  "--target", target,    "--vfov", "60"};
        const bool cache = std::string_view(command) == "render";
        for (const char* word : {cache ? "--samples" : "--spp", cache ? "4000" : "16"})
            arguments.push_back(word);
        EXPECT_EQ(expect_done(arguments).err, "");
        return file;
    };
    for (const char* command : {"reference", "render"}) {
        const std::string one = at_scale(command, 0);
        // The cache's cycles may choose other points where a number is rounded the other way.
        const double most = std::string_view(command) == "render" ? 1e-3 : 1e-5;
        for (const int exponent : {3, 9})
            EXPECT_LT(number(expect_done({"diff", at_scale(command, exponent), one}).out, "relmse"),
                      most)
                << command << exponent;
    }
    expect_refused({"info", room, "--scale", "1.01e9"}, "beyond 1e9");
}

// Light is proportional to the lamps up to the brightest that is allowed, and the cache can hold
// it.
TEST(Render, LampsMayBeAsBrightAsIsAllowed) {
    const TempFolder folder;
    const auto lux = [&](const std::string& emission) {
        return std::stod(expect_done({"trace", "-I", "--lux", write_room(folder, emission)},
                                     ".5 -.999 .5 0 1 0\n")
                             .out);
    };
    EXPECT_NEAR(lux("1e15") / lux("10"), 1e14, 1e9);
    for (const char* scheme : {"best", "paper"})
        expect_done({"render", write_room(folder, "1e15"), "-o", (folder.path() / "a.png").string(),
                     "--scheme", scheme, "--samples", "2000", "--size", "32x32"});
    expect_refused({"info", write_room(folder, "1e20")}, "\"lamp\" emits more than 1e15 cd/m2");
}

// --up is of cameras that the program chooses: it turns a view from --eye, not a camera of the
// file.
TEST(Render, TheVerticalIsThatOfAFilesOwnCamera) {
    const TempFolder folder;
    const auto picture = [&](const Arguments& more) {
        const std::string file = (folder.path() / "a.exr").string();
        Arguments all = {"reference", "builtin:cornell", "-o",   file, "--spp",
                         "1",         "--size",          "16x16"};
        all.insert(all.end(), more.begin(), more.end());
        expect_done(all);
        return read_image(file).pixels;
    };
    EXPECT_EQ(picture({}), picture({"--up", "1,0,0"}));
    const auto upright = picture({"--eye", "2.78,2.73,-8"});
    EXPECT_NE(upright, picture({"--eye", "2.78,2.73,-8", "--up", "1,0,0"}));
    EXPECT_EQ(upright, picture({"--eye", "2.78,2.73,-8", "--up", "0,2,0"}));
}

// --scale is of built-in scenes too.
TEST(Render, ScaleIsOfEveryScene) {
    const auto height = [](const Arguments& more) {
        Arguments all = {"info", "--json", "builtin:cornell"};
        all.insert(all.end(), more.begin(), more.end());
        return nlohmann::json::parse(expect_done(all).out)["bounds"][1][1].get<double>();
    };
    EXPECT_NEAR(height({"--scale", "3"}), 3 * height({}), 1e-5);
}

// What an option cannot do is said.
TEST(Render, SampleCountsWithoutThePapersSchemeAreWarnedOf) {
    const TempFolder folder;
    const auto err = [&](const char* scheme) {
        return expect_done({"render", "builtin:cornell", "-o", (folder.path() / "a.png").string(),
                            "--samples", "100", "--size", "16x16", "--direct-samples", "8",
                            "--scheme", scheme})
            .err;
    };
    EXPECT_NE(err("best").find("--scheme paper"), std::string::npos);
    EXPECT_EQ(err("paper"), "");
}

TEST(Diff, APictureIsEqualToItself) {
    const TempFolder folder;
    const std::string a = (folder.path() / "a.exr").string(),
                      b = (folder.path() / "b.exr").string();
    Image image(3, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(0.1f + float(i));
    write_exr(a, image);
    const Outcome same = expect_done({"diff", a, a});
    const auto j = nlohmann::json::parse(same.out);
    EXPECT_TRUE(j.at("psnr").is_null());
    EXPECT_EQ(j.at("relmse"), 0);
    EXPECT_EQ(j.at("rmse"), 0);
    EXPECT_EQ(std::count(same.out.begin(), same.out.end(), '\n'), 1);

    // All 10 % brighter: relMSE is 0.01 (kb)^2 / ((kb)^2 + 0.01), a little below 0.01.
    for (Rgb& p : image.pixels) p *= 1.1f;
    write_exr(b, image);
    const Outcome brighter = expect_done({"diff", b, a});
    EXPECT_GT(number(brighter.out, "relmse"), 0.005);
    EXPECT_LT(number(brighter.out, "relmse"), 0.01);
    EXPECT_NEAR(number(brighter.out, "k"), 0.4 / 4.1, 1e-5);

    write_exr(b, Image(3, 4));
    expect_refused({"diff", a, b}, "size");
    image.pixels[5] = Rgb(NAN);
    write_exr(b, image);
    expect_refused({"diff", b, a}, "finite");
}

// The Cornell box has 16 quads in 8 objects of 4 materials, one of them a lamp.
TEST(Info, CountsTheCornellBox) {
    const auto j = nlohmann::json::parse(expect_done({"info", "builtin:cornell", "--json"}).out);
    EXPECT_EQ(j.at("primitives"), 16);
    EXPECT_EQ(j.at("quads"), 16);
    EXPECT_EQ(j.at("triangles"), 0);
    EXPECT_EQ(j.at("emissive_primitives"), 1);
    EXPECT_EQ(j.at("objects").size(), 8u);
    EXPECT_EQ(j.at("materials").size(), 4u);
    EXPECT_EQ(j.at("lights").size(), 0u);
    EXPECT_EQ(j.at("cameras").size(), 1u);
    EXPECT_EQ(j.at("warnings").size(), 0u);
    EXPECT_EQ(expect_done({"info", "builtin:cornell"}).out.rfind("primitives 16: 16 quads", 0), 0u);
}

}  // namespace
}  // namespace chiaro
