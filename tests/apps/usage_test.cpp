// Wrong words on the command line: one line that says what is wrong, status 2, and no work done.
#include "apps/command.h"

namespace chiaro {
namespace {

struct Wrong {
    Arguments arguments;
    const char* said;
};

TEST(Usage, EachWrongWordIsNamed) {
    const Wrong table[] = {
        {{}, "command"},
        {{"paint"}, "paint"},
        {{"--paint"}, "--paint"},
        {{"render"}, "SCENE"},
        {{"info"}, "SCENE"},
        {{"diff", "a.exr"}, "B"},
        {{"info", "builtin:moon"}, "room, indirect, poolhall, cornell"},
        {{"info", "builtin:"}, "room, indirect, poolhall, cornell"},
        {{"info", ""}, "SCENE"},
        {{"info", "builtin:cornell", "--paint"}, "--paint"},
        {{"info", "builtin:cornell", "builtin:room"}, "builtin:room"},
        {{"info", "builtin:cornell", "--scale", "0"}, "--scale"},
        {{"info", "builtin:cornell", "--scale", "-1"}, "--scale"},
        {{"info", "builtin:cornell", "--scale", "nan"}, "--scale"},
        {{"trace", "builtin:cornell", "--curve-error", "0"}, "--curve-error"},
        {{"trace", "builtin:cornell", "--curve-error", "nan"}, "--curve-error"},
        {{"trace", "builtin:cornell", "--lux"}, "-I"},
        {{"trace", "-I", "builtin:cornell", "--direct-samples", "0"}, "--direct-samples"},
        {{"trace", "-I", "builtin:cornell", "--indirect-samples", "-4"}, "--indirect-samples"},
        {{"trace", "builtin:cornell", "--seed", "1", "--seed", "2"},
         "--seed: is given more than once"},
        {{"trace", "builtin:cornell", "--seed"}, "--seed: its value is missing"},
        {{"info", "builtin:cornell", "--up", "0,0,0"}, "--up"},
    };
    for (const Wrong& wrong : table) expect_refused(wrong.arguments, wrong.said);
}

// Of `render` and `reference`: what is wrong is found before rendering, and no picture is written.
TEST(Usage, EachWrongOptionOfAPictureIsNamed) {
    const TempFolder folder;
    const std::string output = (folder.path() / "a.png").string();
    const Arguments table[] = {
        {"--size", "0x0"},
        {"--size", "800"},
        {"--size", "800x"},
        {"--size", "20000x10"},
        {"--size", "8x8x8"},
        {"--size", "-8x8"},
        {"--eye", "1,2"},
        {"--eye", "1,2,3,4"},
        {"--eye", "1,nan,2"},
        {"--eye", "1, 2, 3"},
        {"--target", "here"},
        {"--vfov", "0"},
        {"--vfov", "180"},
        {"--vfov", "wide"},
        {"--vfov", "nan"},
        {"--camera", "Nobody"},
        {"--camera", "7"},
        {"--camera", "-1"},
        {"--threads", "-1"},
        {"--threads", "1.5"},
        {"--threads", "9999"},
        {"--time", "-1"},
        {"--time", "nan"},
        {"--time", "soon"},
        {"--renderer", "magic"},
        {"--seed", "-1"},
        {"--seed", "x"},
        {"--exposure", "nan"},
        {"--exposure", "x"},
        {"--up", "0,0"},
        {"--up", "0,0,0"},
        {"--eye", "1e18,0,0"},
        {"--eye", "1e20,0,0"},
        {"--target", "0,-2e9,0"},
        {"--seed", "18446744073709551616"},
        {"--seed"},
    };
    for (const char* command : {"render", "reference"})
        for (const Arguments& option : table) {
            Arguments arguments = {command, "builtin:cornell", "-o", output};
            arguments.insert(arguments.end(), option.begin(), option.end());
            expect_refused(arguments, option[0]);
            EXPECT_FALSE(std::filesystem::exists(output)) << words(arguments);
        }
    for (const Arguments& option : std::initializer_list<Arguments>{{"--scheme", "worst"},
                                                                    {"--aov", "depth"},
                                                                    {"--samples", "-5"},
                                                                    {"--samples", "1e3"},
                                                                    {"--samples", "0"},
                                                                    {"--direct-samples", "0"}})
        expect_refused({"render", "builtin:cornell", "-o", output, option[0], option[1]},
                       option[0]);
    for (const char* spp : {"0", "-1", "many", "99999999"})
        expect_refused({"reference", "builtin:cornell", "-o", output, "--spp", spp}, "--spp");
    EXPECT_FALSE(std::filesystem::exists(output));
}

TEST(Usage, ViewsThatSeeNothingAreRefused) {
    const TempFolder folder;
    const std::string output = (folder.path() / "a.png").string();
    expect_refused(
        {"render", "builtin:cornell", "-o", output, "--eye", "1,1,1", "--target", "1,1,1"},
        "--target");
    expect_refused(
        {"render", "builtin:cornell", "-o", output, "--eye", "1,1,1", "--target", "1,5,1"}, "--up");
    // It is the eye that is too far away, not the vertical that is wrong; and a vertical may be
    // long.
    expect_refused({"render", "builtin:cornell", "-o", output, "--eye", "1e20,0,0"}, "--eye");
    expect_done({"render", "builtin:cornell", "-o", output, "--samples", "100", "--size", "16x16",
                 "--eye", "+1,+2,3", "--up", "0,1e30,0"});
}

// An output that cannot be written is found before rendering (the time asked for is a minute), and
// what is there is left alone.
TEST(Usage, AnUnwritableOutputIsRefusedBeforeRendering) {
    const TempFolder folder;
    const std::string there = folder.write("there.png", "precious").string();
    for (const char* command : {"render", "reference"}) {
        const auto refused = [&](const std::string& output, const std::string& said) {
            expect_refused({command, "builtin:cornell", "--time", "60", "-o", output}, said);
        };
        refused((folder.path() / "no" / "a.png").string(), "no");
        refused(folder.path().string() + "/a.jpg", ".jpg");
        refused(folder.path().string() + "/a", ".png");
        refused("", "-o");
        refused((folder.path() / "there.png" / "a.png").string(), "there.png");
        std::filesystem::create_directories(folder.path() / "folder.png");
        refused((folder.path() / "folder.png").string(), "folder");
        refused("/proc/a.png", "/proc");
    }
    expect_refused({"render", "builtin:cornell", "-o", there, "--time", "60", "--stats",
                    (folder.path() / "no" / "s.json").string()},
                   "s.json");
    expect_refused({"render", "builtin:cornell", "-o", there, "--time", "60", "--stats",
                    folder.path().string()},
                   "is a folder");
    expect_refused({"render", "builtin:cornell", "-o", there, "--time", "60", "--stats",
                    (folder.path() / "." / "there.png").string()},
                   "--stats");
    expect_refused({"render", "nowhere.gltf", "-o", there}, "nowhere.gltf");
    expect_refused({"render", "builtin:cornell", "-o", there, "--vfov", "200"}, "--vfov");
    EXPECT_EQ(read_text(there), "precious");
}

TEST(Usage, CommandsThatComeLaterSaySo) {
    for (const Arguments& later : std::initializer_list<Arguments>{
             {"view"}, {"view", "builtin:room"}, {"compare", "builtin:room"}, {"worker"}})
        expect_refused(later, later[0], 1);
    // A scene alone means: view it.
    expect_refused({"builtin:room"}, "chiaro render builtin:room", 1);
    expect_refused({"room.gltf"}, "chiaro render room.gltf", 1);
    expect_refused({"ROOM.OBJ"}, "chiaro render ROOM.OBJ", 1);
}

TEST(Usage, HelpHoldsExamples) {
    const Outcome help = expect_done({"--help"});
    EXPECT_NE(help.out.find("Example"), std::string::npos);
    for (const char* command : {"render", "reference", "trace", "diff", "info"}) {
        EXPECT_NE(help.out.find(command), std::string::npos);
        const Outcome own = expect_done({command, "--help"});
        EXPECT_NE(own.out.find("Example"), std::string::npos) << command;
        EXPECT_NE(own.out.find(std::string("chiaro ") + command), std::string::npos);
    }
    EXPECT_EQ(expect_done({"--version"}).out.rfind("chiaro ", 0), 0u);
}

}  // namespace
}  // namespace chiaro
