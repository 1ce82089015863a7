// `--edits`: what a script changes in what the commands say.
#include "apps/command.h"

namespace chiaro {
namespace {

// Illuminance straight below the lamp of the Cornell box.
double lux_under_the_lamp(const Arguments& more) {
    Arguments arguments = {"trace", "-I", "--lux", "builtin:cornell"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::stod(expect_done(arguments, "2.78 0.01 2.8 0 1 0\n").out);
}

TEST(Edits, TwiceTheLampIsTwiceTheLight) {
    const TempFolder folder;
    const auto j = nlohmann::json::parse(expect_done({"info", "--json", "builtin:cornell"}).out);
    std::string lamp;
    for (const auto& name : j["objects"])
        if (name.get<std::string>().find("amp") != std::string::npos) lamp = name;
    ASSERT_FALSE(lamp.empty());
    const std::string script = folder
                                   .write("e.json", R"({"edits": [{"t": 9, "light": ")" + lamp +
                                                        R"(", "intensity_scale": 2}]})")
                                   .string();
    const double once = lux_under_the_lamp({});
    EXPECT_NEAR(lux_under_the_lamp({"--edits", script}), 2 * once, 1e-3 * once);
}

TEST(Edits, InfoDescribesTheEditedScene) {
    const TempFolder folder;
    const std::string file =
        folder.write("two.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\no A\nf 1 2 3\no B\nf 3 2 1\n").string();
    const std::string script =
        folder
            .write("e.json", R"({"edits": [{"remove": "A"}, {"add": {"light": "L", "type": "point",
                                 "position": [0, 0, 1], "candela": 3}}]})")
            .string();
    const auto j =
        nlohmann::json::parse(expect_done({"info", "--json", file, "--edits", script}).out);
    EXPECT_EQ(j["objects"], nlohmann::json({"B"}));
    EXPECT_EQ(j["lights"], nlohmann::json({"L"}));
    EXPECT_EQ(j["primitives"], 1);
}

// A lamp that the script adds is a light: no headlamp is needed.
TEST(Edits, AreMadeBeforeAnybodyLooksForLight) {
    const TempFolder folder;
    const std::string file = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").string();
    const std::string picture = (folder.path() / "a.png").string();
    const std::string script =
        folder
            .write("e.json", R"({"edits": [{"add": {"light": "L", "type": "point",
                                 "position": [0, 0, 1], "candela": 3}},
                                 {"camera": {"eye": [0, 0, 3]}}]})")
            .string();
    const Arguments render = {"render", file, "-o", picture, "--samples", "20", "--size", "16x16"};
    EXPECT_NE(expect_done(render).err.find("the scene has no light"), std::string::npos);
    Arguments edited = render;
    edited.insert(edited.end(), {"--edits", script});
    EXPECT_EQ(expect_done(edited).err.find("the scene has no light"), std::string::npos);
}

TEST(Edits, AWrongScriptIsOneLineAndStatus2) {
    const TempFolder folder;
    const std::string script =
        folder.write("e.json", R"({"edits": [{"object": "Vase", "scale": 2}]})").string();
    for (const Arguments& command :
         {Arguments{"info", "builtin:cornell"}, Arguments{"trace", "builtin:cornell"},
          Arguments{"reference", "builtin:cornell", "-o", (folder.path() / "a.exr").string()}}) {
        Arguments arguments = command;
        arguments.insert(arguments.end(), {"--edits", script});
        const Outcome outcome = Command(arguments).finish();
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find("e.json: edits[0].object: there is no object \"Vase\"; there"),
                  std::string::npos)
            << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1);
    }
}

}  // namespace
}  // namespace chiaro
