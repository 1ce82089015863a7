// Edit scripts as text: what they say, and how what is wrong is named.

#include "import/read_edits.h"

#include "base/random.h"
#include "import/import_testing.h"

namespace chiaro {
namespace {

std::string fault(const std::string& text) {
    return fault_of([&] { parse_edits(text, "e.json"); });
}

// One of everything.
std::string rich_script() {
    return R"({"edits": [
{"t": 1.0, "object": "Chair", "translate": [0.5,0,0], "rotate": [0,1,0,30], "scale": 1.5},
{"t": 2.0, "light": "Lamp", "position": [0,2,1], "intensity_scale": 0.5, "color": [1,0.8,0.6], "on": true},
{"t": 3.0, "camera": {"eye": [0,0,1], "target": [0,0,0], "up": [0,1,0], "vfov": 45}},
{"t": 4.0, "material": "Wall", "base_color": [0,0.5,1], "roughness": 0.3, "emission_scale": 2},
{"t": 5.0, "remove": "Vase"},
{"t": 5.5, "add": {"light": "Spot", "type": "spot", "position": [0,1,2], "direction": [0,-1,0], "candela": 100, "cone": [20,30]}},
{"t": 0.5, "add": {"light": "Panel", "type": "area", "position": [0,1,2], "size": [1,2], "nits": 100}},
{"add": {"object": "Chair 2", "copy": "Chair", "translate": [1,0,0]}}],
"frames": [0.5, 1.5, 6]})";
}

TEST(ReadEdits, AllOfTheContractIsRead) {
    const EditScript script = parse_edits(rich_script(), "e.json");
    ASSERT_EQ(script.edits.size(), 8u);
    EXPECT_EQ(script.frames, (std::vector<double>{0.5, 1.5, 6}));

    // By time, whatever the order in the file; without a time, at the start.
    const auto& copy = std::get<CopyObject>(script.edits[0].edit);
    EXPECT_EQ(copy.original, "Chair");
    EXPECT_EQ(copy.place.translate, Vec3(1, 0, 0));
    EXPECT_EQ(script.edits[0].where, "e.json: edits[7]");
    const auto& panel = std::get<NewLight>(script.edits[1].edit);
    EXPECT_EQ(panel.kind, NewLightKind::area);
    EXPECT_EQ(panel.size, Vec2(1, 2));
    const auto& chair = std::get<ChangeObject>(script.edits[2].edit);
    EXPECT_EQ(chair.place.rotate, Vec4(0, 1, 0, 30));
    EXPECT_EQ(chair.place.scale, 1.5f);
    const auto& lamp = std::get<ChangeLight>(script.edits[3].edit);
    EXPECT_EQ(lamp.position, Vec3(0, 2, 1));
    EXPECT_EQ(lamp.on, true);
    EXPECT_FALSE(lamp.candela);
    EXPECT_EQ(std::get<ChangeCamera>(script.edits[4].edit).vertical_fov, 45);
    EXPECT_EQ(std::get<ChangeMaterial>(script.edits[5].edit).roughness, 0.3f);
    EXPECT_EQ(std::get<Remove>(script.edits[6].edit).name, "Vase");
    EXPECT_EQ(std::get<NewLight>(script.edits[7].edit).cone[1], 30);
}

TEST(ReadEdits, EditsOfOneTimeKeepTheirOrder) {
    const EditScript script = parse_edits(
        R"({"edits": [{"t": 1, "remove": "a"}, {"remove": "b"}, {"t": 1, "remove": "c"}]})", "e");
    std::string order;
    for (const TimedEdit& edit : script.edits) order += std::get<Remove>(edit.edit).name;
    EXPECT_EQ(order, "bac");
}

TEST(ReadEdits, EmptyScriptsAreFine) {
    for (const char* text : {"{}", R"({"edits": []})", R"({"edits": [], "frames": []})"})
        EXPECT_TRUE(parse_edits(text, "e").edits.empty());
}

TEST(ReadEdits, WhatIsWrongIsNamedWithItsPlace) {
    const auto edit = [](const std::string& body) { return fault("{\"edits\": [" + body + "]}"); };
    EXPECT_EQ(fault("[]"), "e.json: the script is not an object");
    EXPECT_EQ(fault(R"({"edit": []})"),
              "e.json: edit: there is no such key here; there are edits, frames");
    EXPECT_EQ(fault(R"({"edits": {}})"), "e.json: edits: is not a list");
    EXPECT_EQ(fault(R"({"frames": [1, "x"]})"), "e.json: frames[1]: is not a number");
    EXPECT_EQ(fault(R"({"frames": [-1]})"), "e.json: frames[0]: -1 is not within 0 and 1e+09");
    EXPECT_EQ(edit("3"), "e.json: edits[0]: is not an object");
    EXPECT_EQ(edit("{}"),
              "e.json: edits[0]: does not say what it edits; there are object, light, camera, "
              "material, remove and add");
    EXPECT_EQ(edit(R"({"remove": "a"}, {"object": "a", "rotate": [0, 1, 0]})"),
              "e.json: edits[1].rotate: is not a list of 4 numbers");
    EXPECT_EQ(edit(R"({"object": "a", "rotate": [0, 0, 0, 9]})"),
              "e.json: edits[0].rotate: its axis has no direction; give an axis and degrees, as "
              "[0, 1, 0, 30]");
    EXPECT_EQ(edit(R"({"object": "a", "move": [0, 0, 0]})"),
              "e.json: edits[0].move: there is no such key here; there are t, object, translate, "
              "rotate, scale");
    EXPECT_EQ(edit(R"({"object": 3})"), "e.json: edits[0].object: is not a string");
    EXPECT_EQ(edit(R"({"object": "a", "scale": 0})"),
              "e.json: edits[0].scale: 0 is not within 1e-06 and 1e+06");
    EXPECT_EQ(edit(R"({"object": "a", "translate": [0, 1e300, 0]})"),
              "e.json: edits[0].translate[1]: 1e+300 is not within -1e+09 and 1e+09");
    EXPECT_EQ(edit(R"({"t": "x", "remove": "a"})"), "e.json: edits[0].t: is not a number");
    EXPECT_EQ(edit(R"({"object": "a", "remove": "b"})"),
              "e.json: edits[0]: edits both \"object\" and \"remove\"; make two edits of it");
    EXPECT_EQ(edit(R"({"light": "a", "color": [0, 0, 0]})"),
              "e.json: edits[0].color: is black; say \"on\": false");
    EXPECT_EQ(edit(R"({"light": "a", "on": 1})"), "e.json: edits[0].on: is not true or false");
    EXPECT_EQ(edit(R"({"light": "a", "candela": 1, "nits": 1})"),
              "e.json: edits[0]: candela, nits and intensity_scale exclude each other; give one");
    EXPECT_EQ(edit(R"({"camera": {"fov": 3}})"),
              "e.json: edits[0].camera.fov: there is no such key here; there are eye, target, up, "
              "vfov");
    EXPECT_EQ(edit(R"({"material": "a", "base_color": [0, 0, 2]})"),
              "e.json: edits[0].base_color[2]: 2 is not within 0 and 1");
    EXPECT_EQ(edit(R"({"add": {"light": "a", "type": "sun"}})"),
              "e.json: edits[0].add.type: is none of point, spot and area");
    EXPECT_EQ(edit(R"({"add": {"light": "a", "type": "point", "position": [0, 0, 0], "nits": 1}})"),
              "e.json: edits[0].add.candela: is missing");
    EXPECT_EQ(edit(R"({"add": {"light": "a", "type": "area", "position": [0, 0, 0], "nits": 1,
                       "size": [1, 1], "cone": [1, 2]}})"),
              "e.json: edits[0].add.cone: a spot alone has a cone");
    EXPECT_EQ(edit(R"({"add": {"object": "a"}})"),
              "e.json: edits[0].add.copy: is missing; add a \"light\", or an \"object\" that is a "
              "\"copy\"");
}

TEST(ReadEdits, DeepNestingIsRefused) {
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_NE(fault("{\"edits\": " + deep + "}").find("nested deeper than 64"), std::string::npos);
}

TEST(ReadEdits, NamesFromFilesAreShownOnOneLine) {
    EXPECT_EQ(fault("{\"a\\nb\\u001b\": 1}"),
              "e.json: a\\nb\\x1b: there is no such key here; there are edits, frames");
}

TEST(ReadEdits, MutatedScriptsAreReadOrRefused) {
    constexpr std::string_view kMeaningful = "{}[]\",:-+.eE0123456789tn\\\xff";
    const std::string original = rich_script();
    Rng rng(2002);
    int refused = 0;
    for (int i = 0; i < 6000; ++i) {
        std::string bytes = original;
        for (std::uint32_t changes = 1 + rng.below(3); changes > 0; --changes) {
            const std::size_t at = rng.below(static_cast<std::uint32_t>(bytes.size()));
            const auto pick = rng.below(static_cast<std::uint32_t>(kMeaningful.size()));
            if (rng.below(2) == 0)
                bytes[at] = kMeaningful[pick];
            else
                bytes.erase(at, 1 + rng.below(8));
        }
        refused += !fault(bytes).empty();
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, 6000);
}

}  // namespace
}  // namespace chiaro
