#include "import/glb.h"
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
                         "more than 1e18"));
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
