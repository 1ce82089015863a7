#include "import/glb.h"
#include "import/gltf_accessor.h"
#include "import/import_testing.h"

#include <limits>

namespace chiaro {
namespace {

using nlohmann::json;

std::string fault(const GltfMaker& maker) {
    return fault_of_file(TempFolder(), "a.gltf", maker.text());
}

// The triangle with `change` made to its document.
template <typename Change>
std::string fault_after(const Change& change) {
    GltfMaker maker = triangle_gltf();
    change(maker);
    return fault(maker);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(GltfFaults, FilesThatAreNoneAreRefused) {
    const TempFolder folder;
    EXPECT_EQ(fault_of_file(folder, "a.gltf", ""), "a.gltf: the file is empty");
    EXPECT_TRUE(contains(fault_of_file(folder, "a.gltf", "{\"asset\": \n!}"), "JSON: parse error"));
    EXPECT_EQ(fault_of_file(folder, "a.gltf", "[]"), "a.gltf: JSON: the document is not an object");
    EXPECT_EQ(fault_of_file(folder, "a.gltf", "{}"), "a.gltf: asset: is missing");
    EXPECT_TRUE(contains(fault_of_file(folder, "a.txt", "x"), "not a kind of scene"));
    EXPECT_TRUE(contains(fault_of([&] { load_scene(folder.path()); }), "is a folder"));
    EXPECT_TRUE(contains(fault_of([&] { load_scene(folder.path() / "no.glb"); }), "no such file"));
    EXPECT_TRUE(contains(fault_of([&] { load_scene("/dev/null"); }), "not a kind of scene"));
    std::filesystem::create_directory(folder.path() / "dir.obj");
    EXPECT_TRUE(contains(fault_of([&] { load_scene(folder.path() / "dir.obj"); }), "is a folder"));
}

TEST(GltfFaults, OptionsWithoutSenseAreRefused) {
    const TempFolder folder;
    const auto file = folder.write("a.gltf", triangle_gltf().text());
    EXPECT_TRUE(fault_of([&] { load_scene(file, {.up = Vec3(0)}); }).starts_with("--up"));
    for (const float scale : {0.0f, -1.0f, kInfinity, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_TRUE(fault_of([&] { load_scene(file, {.scale = scale}); }).starts_with("--scale"));
}

TEST(GltfFaults, NestingDeeperThan64IsRefusedBeforeItIsParsed) {
    const auto nested = [](int depth) {
        return "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(depth, '[') +
               std::string(depth, ']') + "}";
    };
    const TempFolder folder;
    EXPECT_EQ(fault_of_file(folder, "a.gltf", nested(63)), "");
    for (const int depth : {64, 100000}) {
        EXPECT_TRUE(contains(fault_of_file(folder, "a.gltf", nested(depth)), "deeper than 64"));
        EXPECT_TRUE(contains(fault_of_file(folder, "a.glb", make_glb(nested(depth), "")),
                             "deeper than 64"));
    }
    EXPECT_TRUE(contains(fault_of_file(folder, "a.gltf", std::string(100000, '{')), "deeper"));
}

TEST(GltfFaults, BracketsInStringsDoNotNest) {
    EXPECT_NO_THROW(
        check_json_depth("\"" + std::string(1000, '[') + "\\\"" + std::string(99, '{'), "a"));
}

TEST(GltfFaults, BrokenContainersAreRefused) {
    const TempFolder folder;
    const std::string whole = make_glb(triangle_gltf().text(), "1234");
    EXPECT_EQ(fault_of_file(folder, "a.glb", whole), "");
    for (std::size_t length = 0; length < whole.size(); length += length < 40 ? 1 : 97)
        EXPECT_NE(fault_of_file(folder, "a.glb", whole.substr(0, length)), "") << length;
    std::string version = whole;
    version[4] = 1;
    EXPECT_TRUE(contains(fault_of_file(folder, "a.glb", version), "version 1"));
    std::string chunk = whole;
    chunk[15] = '\x7f';  // a chunk of 2 GB
    EXPECT_TRUE(contains(fault_of_file(folder, "a.glb", chunk), "beyond the end"));
}

TEST(GltfFaults, IndicesAndNumbersAreChecked) {
    EXPECT_EQ(fault_after([](GltfMaker& m) {
                  m.primitive()["indices"] = m.add_indices({0, 1, 3});
              }),
              "a.gltf: meshes[0].primitives[0].indices: index 2 names point 3 of 3");
    EXPECT_EQ(fault_after([](GltfMaker& m) {
                  m.primitive()["indices"] = m.add_indices({0, 1, 65535});
              }),
              "a.gltf: meshes[0].primitives[0].indices: index 2 restarts the primitive");
    EXPECT_EQ(
        fault_after([](GltfMaker& m) {
            const float nan = std::numeric_limits<float>::quiet_NaN();
            m.primitive()["attributes"]["POSITION"] = m.add_vec3({0, 0, 0, nan, 0, 0, 0, 1, 0});
        }),
        "a.gltf: accessors[1]: element 1 is not finite");
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) {
                             m.primitive()["attributes"]["POSITION"] =
                                 m.add_vec3({0, 0, 0, 3e38f, 0, 0, 0, 3e38f, 0});
                         }),
                         "beyond 1e9"));
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) { m.root["nodes"][0]["mesh"] = 7; }),
                         "nodes[0].mesh: 7 names one that is not there"));
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) { m.root["nodes"][0]["mesh"] = -1; }),
                         "is not an index"));
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) {
                             m.root["nodes"][0]["scale"] = {1, 1};
                         }),
                         "array of 3 numbers"));
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) {
                             m.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
                         }),
                         "no direction"));
    EXPECT_TRUE(contains(
        fault_after([](GltfMaker& m) { m.root["nodes"][0]["matrix"] = std::vector<int>(16, 1); }),
        "is not affine"));
}

TEST(GltfFaults, HugeCountsAreRefusedWithoutMemoryForThem) {
    for (const double count : {1e6, 4e9, 9e15}) {
        EXPECT_NE(fault_after([&](GltfMaker& m) {
                      m.root["accessors"][0]["count"] = static_cast<std::int64_t>(count);
                  }),
                  "");
        EXPECT_NE(fault_after([&](GltfMaker& m) {
                      m.root["accessors"][0]["count"] = static_cast<std::int64_t>(2 * count);
                      m.root["accessors"][0].erase("bufferView");
                  }),
                  "");
        EXPECT_NE(fault_after([&](GltfMaker& m) {
                      m.root["buffers"][0]["byteLength"] = static_cast<std::int64_t>(count);
                  }),
                  "");
        EXPECT_NE(fault_after([&](GltfMaker& m) {
                      m.root["bufferViews"][0]["byteOffset"] = static_cast<std::int64_t>(count);
                  }),
                  "");
    }
    EXPECT_NE(fault_after([&](GltfMaker& m) { m.root["bufferViews"][0]["byteLength"] = 1e300; }),
              "");
}

TEST(GltfFaults, HierarchiesThatAreNoneAreRefused) {
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) {
                             m.root["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
                         }),
                         "below itself"));
    EXPECT_TRUE(
        contains(fault_after([](GltfMaker& m) {
                     m.root["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
                 }),
                 "two parents"));
}

TEST(GltfFaults, ARequiredExtensionThatIsNotSupportedIsNamed) {
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) {
                             m.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
                         }),
                         "KHR_draco_mesh_compression is not supported"));
}

TEST(GltfFaults, WhatTheSpecificationForbidsOfNumbersAndPartsIsRefused) {
    struct Fault {
        const char* path;  // a JSON pointer
        json value;
        const char* said;
    };
    const auto spot = [](double inner, double outer) {
        return json{{"type", "spot"},
                    {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}};
    };
    const char* const kLight = "/extensions/KHR_lights_punctual/lights/0";
    const Fault table[] = {
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", {5, 0, 0, 1}, "5 is out of range"},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", {0, -1, 0, 1}, "-1 is out of range"},
        {"/materials/0/emissiveFactor", {0, 0, 3}, "emissiveFactor[2]: 3 is out of range"},
        {kLight, {{"type", "point"}, {"color", {2, 0, 0}}}, "2 is out of range"},
        {kLight, spot(0.5, 0.4), "innerConeAngle is beyond outerConeAngle"},
        {kLight, spot(0, 1.6), "1.6 is out of range"},
        {kLight, {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.8}}}}, "beyond outerConeAngle"},
        {"/extensionsRequired",
         {"KHR_materials_ior"},
         "KHR_materials_ior is not in extensionsUsed"},
        {"/nodes/0",
         {{"mesh", 0},
          {"scale", {1, 1, 1}},
          {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}},
         "nodes[0]: has a matrix and a scale"},
        {"/scenes", {{{"nodes", {0, 0}}}}, "scenes[0].nodes: names a node twice"},
    };
    for (const Fault& wrong : table) {
        const auto change = [&](GltfMaker& m) {
            m.root[json::json_pointer(wrong.path)] = wrong.value;
        };
        EXPECT_TRUE(contains(fault_after(change), wrong.said)) << fault_after(change);
    }
    // Equal angles are a sharp edge.
    EXPECT_EQ(
        fault_after([&](GltfMaker& m) { m.root[json::json_pointer(kLight)] = spot(0.4, 0.4); }),
        "");
}

TEST(GltfFaults, LightTooBrightToSquareIsRefusedByName) {
    const auto emission = [](double strength) {
        return fault_after([&](GltfMaker& m) {
            m.primitive()["material"] = 0;
            m.root["materials"] = {
                {{"name", "Lamp"},
                 {"emissiveFactor", {0.5, 0, 0}},
                 {"extensions",
                  {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}}};
        });
    };
    EXPECT_EQ(emission(1.9e15), "");
    EXPECT_EQ(emission(2.1e15), "a.gltf: material \"Lamp\" emits more than 1e15 cd/m2");
    const auto light = [](const char* type, double intensity) {
        return fault_after([&](GltfMaker& m) {
            m.root["extensions"]["KHR_lights_punctual"]["lights"] = {
                {{"type", type}, {"intensity", intensity}}};
            m.root["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
        });
    };
    EXPECT_EQ(light("point", 1e15), "");
    EXPECT_EQ(light("point", 3e38), "a.gltf: light \"light 1\" is brighter than 1e15 cd");
    EXPECT_EQ(light("directional", 1e37), "a.gltf: light \"light 1\" is brighter than 1e15 lux");
}

// One coordinate of a corner, in the file and in the world.
TEST(GltfFaults, AWorldTooWideForFloatsIsRefused) {
    const auto corner = [](float x, double scale) {
        return fault_after([&](GltfMaker& m) {
            m.primitive()["attributes"]["POSITION"] = m.add_vec3({0, 0, 0, x, 0, 0, 0, x, 0});
            m.root["nodes"][0]["scale"] = {scale, scale, scale};
        });
    };
    EXPECT_EQ(corner(1e9f, 1), "");
    EXPECT_EQ(corner(1e6f, 1000), "");
    EXPECT_TRUE(contains(corner(1.001e9f, 1), "\"object 1\" has coordinates beyond 1e9"));
    EXPECT_TRUE(contains(corner(1e6f, 1001), "\"object 1\" has coordinates beyond 1e9"));
    EXPECT_TRUE(contains(corner(2e9f, 0.1), "\"object 1\" has coordinates beyond 1e9"));
    EXPECT_TRUE(contains(fault_after([](GltfMaker& m) {
                             m.root["cameras"] = {{{"type", "perspective"},
                                                   {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
                             m.root["nodes"][0]["camera"] = 0;
                             m.root["nodes"][0]["translation"] = {0, -2e9, 0};
                             m.root["nodes"][0].erase("mesh");
                         }),
                         "\"camera 1\" has coordinates beyond 1e9"));
}

TEST(GltfFaults, ATinyWorldIsWarnedOf) {
    const auto warnings = [](float scale) {
        return TempFolder().load("a.gltf", triangle_gltf().text(), {.scale = scale}).warnings;
    };
    EXPECT_TRUE(warnings(1e-3f).empty());  // 0.0014 across
    ASSERT_EQ(warnings(1e-4f).size(), 1u);
    EXPECT_TRUE(contains(warnings(1e-4f)[0], "light is wrong below 0.001"));
}

// Many accessors may name the same bytes, so the numbers that are held against bounds have an end.
TEST(GltfFaults, BoundsAreCheckedOfSoManyNumbersAndNoMore) {
    GltfMaker maker = triangle_gltf();
    maker.add_accessor(std::vector<std::uint8_t>(1 << 20, 2), "SCALAR", 5121, 1);
    json accessor = maker.root["accessors"][1];
    accessor["min"] = accessor["max"] = {2};
    const auto fault_after_right_ones = [&](std::uint64_t numbers) {
        maker.root["accessors"] = {maker.root["accessors"][0]};
        for (std::uint64_t n = 0; n < numbers; n += 1 << 20)
            maker.root["accessors"].push_back(accessor);
        maker.root["accessors"].push_back(accessor);
        maker.root["accessors"].back()["max"] = {1};
        return fault(maker);
    };
    EXPECT_TRUE(contains(fault_after_right_ones(0), "not within its min and max"));
    EXPECT_EQ(fault_after_right_ones(kMostCheckedNumbers), "");
}

TEST(GltfFaults, FilesOutsideTheFolderAreRefused) {
    for (const std::string uri :
         {"../x.bin", "a/../../x.bin", "/etc/passwd", "%2e%2e/x.bin", "http://x/y.bin",
          "file:x.bin", "C:\\x.bin", "x%zz.bin", "", "data:,abc", "data:text/plain;base64,!!!!"})
        EXPECT_TRUE(contains(fault_after([&](GltfMaker& m) { m.root["buffers"][0]["uri"] = uri; }),
                             "buffers[0]"))
            << uri;
}

GltfMaker with_image(const std::string& uri) {
    GltfMaker maker = triangle_gltf();
    maker.root["images"] = {{{"uri", uri}}};
    maker.root["textures"] = {{{"source", 0}}};
    maker.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    return maker;
}

TEST(GltfFaults, AnAbsentOrBrokenImageIsRefusedOnlyWhereASurfaceNeedsIt) {
    for (const std::string uri :
         {"gone.png", "data:image/png;base64,iVBORw0KGgoAAAA=",
          "data:image/jpeg;base64,/9j/2wBDAAI=", "data:image/png;base64,"}) {
        GltfMaker maker = with_image(uri);
        EXPECT_EQ(fault(maker), "") << uri;
        maker.primitive()["material"] = 0;
        EXPECT_TRUE(contains(fault(maker), "images[0]")) << uri;
    }
    const Scene scene = TempFolder().load("a.gltf", with_image("gone.png").text());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(contains(scene.warnings[0], "gone.png"));
}

TEST(GltfFaults, NamesInMessagesCannotBreakTheLine) {
    GltfMaker maker = with_image("a\nb\x1b[31m\u0085.png");
    maker.primitive()["material"] = 0;
    EXPECT_TRUE(contains(fault(maker), "a\\nb\\x1b[31m\\xc2\\x85.png"));
}

}  // namespace
}  // namespace chiaro
