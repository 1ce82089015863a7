// `chiaro play`: scripts and animations, replayed.
#include "apps/command.h"
#include "import/image_file.h"

namespace chiaro {
namespace {

struct Played {
    TempFolder folder;
    std::string frames = (folder.path() / "frames").string();
    std::string figures = (folder.path() / "figures.json").string();
    std::string script(const std::string& text) const {
        return folder.write("script.json", text).string();
    }
    Image frame(const char* name) const { return read_image(folder.path() / "frames" / name); }
};

double mean(const Image& image) {
    double sum = 0;
    for (const Rgb& p : image.pixels) sum += luminance(p) / double(image.pixels.size());
    return sum;
}

Arguments play_cornell(const Played& played, const std::string& script) {
    return {"play",        "builtin:cornell", "--script", script,          "-o",
            played.frames, "--size",          "32x24",    "--fixed-cycles"};
}

// The lamp goes to a quarter after half a second, and with it the picture: exactly in the limit,
// and within 4 % after ten cycles.
TEST(Play, PicturesAreOfTheAskedInstants) {
    const Played played;
    const std::string script = played.script(
        R"({"edits": [{"t": 0.5, "light": "lamp", "intensity_scale": 0.25}], "frames": [0.5, 1]})");
    Arguments arguments = play_cornell(played, script);
    arguments.insert(arguments.end(), {"--stats", played.figures});
    expect_done(arguments);
    EXPECT_NEAR(mean(played.frame("frame_001.exr")) / mean(played.frame("frame_000.exr")), 0.25,
                0.01);
    EXPECT_EQ(played.frame("frame_000.png").width, 32);

    const auto j = nlohmann::json::parse(read_text(played.figures));
    ASSERT_EQ(j["frames"].size(), 2u);
    EXPECT_EQ(j["frames"][0]["t"], 0.5);
    EXPECT_GT(j["frames"][1]["points_shaded"], j["frames"][0]["points_shaded"]);
}

// In cycles of fixed size a replay is the same bits, whatever the machine does meanwhile.
TEST(Play, FixedCyclesGiveTheSameBits) {
    std::vector<Image> pictures;
    for (const char* threads : {"1", "2"}) {
        const Played played;
        const std::string script = played.script(
            R"({"edits": [{"t": 0.2, "object": "tall block", "translate": [0.3, 0, 0]}],
                "frames": [0.6]})");
        Arguments arguments = play_cornell(played, script);
        arguments.insert(arguments.end(), {"--threads", threads});
        expect_done(arguments);
        pictures.push_back(played.frame("frame_000.exr"));
    }
    EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
}

// The built-in scenes' walk is an animation; it moves the eye, so that pictures differ.
TEST(Play, AnimationsArePlayedByName) {
    const Played played;
    const std::string script = played.script(R"({"edits": [], "frames": [0.1, 4]})");
    expect_done({"play", "builtin:indirect", "--animation", "path", "--script", script, "-o",
                 played.frames, "--size", "32x24", "--fixed-cycles"});
    EXPECT_NE(played.frame("frame_000.exr").pixels, played.frame("frame_001.exr").pixels);
}

// A script that asks for no pictures gives one, 2 s after its last edit.
TEST(Play, TheLastPictureIsTheDefault) {
    const Played played;
    const std::string script = played.script(R"({"edits": [{"t": 0.1, "remove": "short block"}]})");
    expect_done(play_cornell(played, script));
    EXPECT_GT(mean(played.frame("frame_000.exr")), 0);
    EXPECT_FALSE(std::filesystem::exists(played.frames + "/frame_001.exr"));
}

TEST(Play, SaysWhatIsWrong) {
    const Played played;
    const std::string script = played.script(R"({"edits": [{"t": 1, "remove": "short block"}]})");
    expect_refused({"play", "builtin:cornell", "-o", played.frames}, "--script", 2);
    expect_refused({"play", "builtin:cornell", "--script", script}, "--output", 2);
    expect_refused({"play", "builtin:room", "--animation", "dance", "-o", played.frames}, "path",
                   2);
    expect_refused({"play", "builtin:cornell", "--animation", "dance", "-o", played.frames},
                   "dance", 2);
    const std::string unknown =
        played.folder.write("unknown.json", R"({"edits": [{"remove": "Vase"}]})").string();
    expect_refused({"play", "builtin:cornell", "--script", unknown, "-o", played.frames},
                   "tall block", 2);
    const std::string file = played.folder.write("file", "x").string();
    expect_refused({"play", "builtin:cornell", "--script", script, "-o", file}, "-o", 2);
    EXPECT_EQ(read_text(file), "x");
}

}  // namespace
}  // namespace chiaro
