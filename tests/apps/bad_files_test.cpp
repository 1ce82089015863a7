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

constexpr char kPoints[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";

// What may be wrong with a scene, the status that `render` ends with and what it says.
struct Kind {
    const char* name;  // of the file in the test's folder
    std::string bytes;
    int status;
    const char* said;
};

std::vector<Kind> kinds() {
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    const std::string face = kPoints + std::string("f 1 2 3\n");
    const std::string textured = kPoints + std::string("usemtl m\nf 1/1 2/1 3/1\n");
    const char* const wood = R"("materials":[{"emissiveTexture":{"index":0},
        "emissiveFactor":[1,1,1]}],"textures":[{"source":0}],"images":[{"uri":"wood.png"}])";
    return {
        {"empty.gltf", "", 2, "empty"},
        {"empty.glb", "", 2, "empty"},
        {"empty.obj", "", 2, "empty"},
        {"scene.fbx", "FBX", 2, ".gltf, .glb, .obj and .bpt"},
        {"scene", "?", 2, ".gltf, .glb, .obj and .bpt"},
        {"noise.gltf", "\x01\x02\xff\xfe", 2, "noise.gltf"},
        {"noise.glb", "\x01\x02\xff\xfe", 2, "noise.glb"},
        {"deep.gltf", std::string(100'000, '['), 2, "64"},
        {"deep_objects.gltf", objects, 2, "64"},
        {"index.gltf", gltf_triangle({0, 1, 3}, 0), 2, "indices"},
        {"index.obj", kPoints + std::string("f 1 2 4\n"), 2, "index.obj:5"},
        {"nan.gltf", gltf_triangle({0, 1, 2}, NAN), 2, "accessors[0]"},
        {"inf.gltf", gltf_triangle({0, 1, 2}, INFINITY), 2, "accessors[0]"},
        {"nan.obj", "v 0 0 nan\n" + face, 2, "nan.obj:1"},
        {"far.obj", "v 0 0 -1e13\nv 1e13 0 0\nv 0 1e13 0\nf 1 2 3\n", 2, "beyond 1e9"},
        {"texture.obj", "mtllib wood.mtl\n" + textured, 2, "wood.png"},
        {"texture.gltf", gltf_triangle({0, 1, 2}, 0, wood), 2, "wood.png"},
        {"count.bpt", "1000000000000\n3 3\n", 2, "patch 1 of 1000000000000"},
        {"degrees.bpt", "1\n2 2\n", 2, "degrees.bpt:2"},
        {"surface.obj", kPoints + std::string("surf 0 1 0 1 1 2 3\n"), 2, "surface.obj:5"},
        {"tag.obj", face + "t crease 2/1/0 0\n", 2, "tag.obj:6"},
        {"library.obj", "mtllib gone.mtl\n" + face, 0, "gone.mtl"},
        {"dark.gltf", gltf_triangle({0, 1, 2}, 0), 0, "no light"},
        {"dark.obj", face, 0, "no light"},
        {"sound.gltf", gltf_triangle({0, 1, 2}, 0), 0, ""},
    };
}

TEST(BadFiles, EachKindIsRefusedInOneLineOrRendered) {
    const TempFolder folder;
    folder.write("wood.mtl", "newmtl m\nmap_Kd wood.png\n");
    const std::string picture = (folder.path() / "a.png").string();
    for (const Kind& kind : kinds()) {
        const std::string file = folder.write(kind.name, kind.bytes).string();
        const Arguments render = {"render", file,    "-o",        picture,
                                  "--size", "16x16", "--samples", "9"};
        if (kind.status == 0) {
            const Outcome outcome = expect_done(render);
            EXPECT_NE(outcome.err.find(kind.said), std::string::npos) << kind.name << outcome.err;
        } else {
            expect_refused({"info", file}, folder.path().string() + "/");
            expect_refused({"info", file}, kind.said);
            expect_refused(render, kind.said);
        }
        EXPECT_EQ(std::filesystem::remove(picture), kind.status == 0) << kind.name;
    }
}

TEST(BadFiles, NoFileAFolderAndNowhereToWrite) {
    const TempFolder folder;
    expect_refused({"info", "nowhere.gltf"}, "nowhere.gltf: there is no such file");
    expect_refused({"info", folder.path().string()}, "folder");
    std::filesystem::create_directories(folder.path() / "scene.gltf");
    expect_refused({"info", (folder.path() / "scene.gltf").string()}, "folder");
    expect_refused({"diff", "a.exr", "b.exr"}, "a.exr");
    expect_refused({"diff", folder.write("a.exr", "v/1").string(), "b.exr"}, "a.exr");
    const std::string sound = folder.write("a.gltf", gltf_triangle({0, 1, 2}, 0)).string();
    expect_refused({"render", sound, "-o", "/proc/a.png"}, "/proc/a.png");
    expect_refused({"render", sound, "-o", (folder.path() / "no" / "a.png").string()}, "no folder");
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
    if (!std::filesystem::exists(malformed::kFolder))
        GTEST_SKIP() << "the malformed collection is not in " << malformed::kFolder;
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
