// Files that are wrong: one line, `file: where: what`, status 2, never a crash.
#include "apps/command.h"
#include "import/malformed_table.h"

namespace chiaro {
namespace {

const std::string kTriangle = R"("asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0}],"buffers":[{"byteLength":42,"uri":"data:;base64,)";

// A glTF file of one triangle with these indices and this corner.
std::string gltf_triangle(std::vector<std::uint16_t> indices, float x,
                          const std::string& more = R"("materials":[{}])") {
    const std::vector<float> positions = {x, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes = bytes_of(positions) + bytes_of(indices);
    return "{" + kTriangle + base64(bytes) + R"("}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                      "min":[0,0,0],"max":[1,1,0]},
                     {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)" +
           more + "}";
}

TEST(BadFiles, EachIsRefusedInOneLine) {
    const TempFolder folder;
    const auto refused = [&](const std::string& name, const std::string& bytes,
                             const std::string& said) {
        const std::string file = folder.write(name, bytes).string();
        expect_refused({"info", file}, file);
        expect_refused({"info", file}, said);
        expect_refused({"render", file, "-o", (folder.path() / "a.png").string()}, said);
    };
    refused("empty.gltf", "", "empty");
    refused("empty.glb", "", "empty");
    refused("empty.obj", "", "empty");
    refused("scene.fbx", "FBX", ".gltf, .glb and .obj");
    refused("scene", "?", ".gltf, .glb and .obj");
    refused("noise.gltf", "\x01\x02\xff\xfe", "noise.gltf");
    refused("noise.glb", "\x01\x02\xff\xfe", "noise.glb");
    refused("deep.gltf", std::string(100'000, '['), "64");
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    refused("deep_objects.gltf", objects, "64");
    refused("index.gltf", gltf_triangle({0, 1, 3}, 0), "indices");
    refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "index.obj:4");
    refused("nan.gltf", gltf_triangle({0, 1, 2}, NAN), "accessors[0]");
    refused("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "nan.obj:1");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.png"));
}

TEST(BadFiles, AnAbsentTextureIsNamed) {
    const TempFolder folder;
    folder.write("a.mtl", "newmtl m\nmap_Kd wood.png\n");
    const std::string obj = folder
                                .write("a.obj",
                                       "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\n"
                                       "f 1/1 2/1 3/1\n")
                                .string();
    expect_refused({"info", obj}, "wood.png");
    const std::string gltf =
        folder
            .write("a.gltf", gltf_triangle({0, 1, 2}, 0,
                                           R"("materials":[{"emissiveTexture":{"index":0},
            "emissiveFactor":[1,1,1]}],"textures":[{"source":0}],"images":[{"uri":"wood.png"}])"))
            .string();
    expect_refused({"info", gltf}, "wood.png");
}

TEST(BadFiles, NoFileAndNoFolder) {
    const TempFolder folder;
    expect_refused({"info", "nowhere.gltf"}, "nowhere.gltf: there is no such file");
    expect_refused({"info", folder.path().string()}, "folder");
    std::filesystem::create_directories(folder.path() / "scene.gltf");
    expect_refused({"info", (folder.path() / "scene.gltf").string()}, "folder");
    expect_refused({"diff", "a.exr", "b.exr"}, "a.exr");
    expect_refused({"diff", folder.write("a.exr", "v/1").string(), "b.exr"}, "a.exr");
}

// Names come from files: a line break or an escape in one must not break the one line or reach the
// terminal.
TEST(BadFiles, NamesCannotBreakTheLine) {
    const TempFolder folder;
    const std::string file = folder.write("a\n\x1b[31mb.obj", "f 1 2 3\n").string();
    expect_refused({"info", file}, "b.obj");
    const Outcome outcome = chiaro_with({"info", file});
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
}

// Every file of the collection, as the importer's table says; an accepted one ends with status 0.
TEST(BadFiles, TheMalformedCollection) {
    if (!std::filesystem::exists(malformed::kFolder)) GTEST_SKIP() << "the collection is not here";
    for (const auto& [name, verdict] : malformed::kExpected) {
        const std::string file = (malformed::kFolder / name).string();
        if (verdict == malformed::refused)
            expect_refused({"info", file}, file);
        else
            expect_done({"info", "--json", file});
    }
}

}  // namespace
}  // namespace chiaro
