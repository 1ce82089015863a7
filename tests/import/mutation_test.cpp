// Files with bytes changed at random, from fixed seeds: each loads or is refused with an Error.

#include "base/random.h"
#include "import/import_testing.h"

namespace chiaro {
namespace {

// A document with something of everything that is read.
std::string rich_gltf() {
    GltfMaker maker = triangle_gltf();
    auto& primitive = maker.primitive();
    primitive["attributes"]["NORMAL"] = maker.add_vec3({0, 0, 1, 0, 0, 1, 0, 0, 0});
    primitive["attributes"]["TEXCOORD_0"] = maker.add_vec2({0, 0, 1, 0, 0, 1});
    primitive["attributes"]["COLOR_0"] = maker.add_vec3({1, 1, 1, 1, 0, 0, 0, 1, 0});
    primitive["indices"] = maker.add_indices({0, 1, 2});
    primitive["material"] = 0;
    const TempFolder folder;
    folder.write_picture("p.png");
    const std::string png = base64(read_text(folder.path() / "p.png"));
    maker.root["images"] = {{{"uri", "data:image/png;base64," + png}}};
    maker.root["samplers"] = {{{"wrapS", 33071}}};
    maker.root["textures"] = {{{"source", 0}, {"sampler", 0}}};
    maker.root["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
         {"emissiveFactor", {1, 1, 1}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}}}}}};
    maker.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
    maker.root["nodes"][0]["children"] = {1};
    maker.root["nodes"].push_back(
        {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    maker.root["scenes"] = {{{"nodes", {0}}}};
    const auto times = maker.add_accessor(std::vector<float>{0, 1}, "SCALAR", 5126, 1);
    const auto places = maker.add_vec3({0, 0, 0, 1, 2, 3});
    maker.root["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"path", "translation"}, {"node", 1}}}}}},
         {"samplers", {{{"input", times}, {"output", places}, {"interpolation", "LINEAR"}}}}}};
    return maker.text();
}

std::string rich_obj() {
    return "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .3 .3 0 1 0 0\nvt 0 0\nvt 1 0\n"
           "vt 1 1\nvn 0 0 1\no A\nusemtl m\nf 1/1/1 2/2/1 3/3/1\ng b\nf 1 2 3 4\nf 1 2 5 4\n"
           "f -1 -2 -3 \\\n -4 -5\ns 1\nl 1 2\n";
}

// Both kinds of curved surface: free-form, and a cage with tags.
std::string curved_obj() {
    std::string text;
    for (int k = 0; k < 16; ++k)
        text += "v " + std::to_string(k % 4) + " " + std::to_string(k / 4) + " 0 1\n";
    return text +
           "cstype rat bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\n"
           "parm u 0 1\nparm v 0 1\nend\nvt 0 0\nf 1/1 2/1 6/1 5/1\nf 2/1 3/1 7/1 6/1\n"
           "f 5/1 6/1 10/1\nt crease 2/1/0 1 5 2.5\nt corner 1/1/0 0 3\nt hole 1/0/0 1\n"
           "t interpolateboundary 1/0/0 1\n";
}

std::string one_bpt() {
    std::string text = "1\n3 3\n";
    for (int k = 0; k < 16; ++k)
        text += std::to_string(k % 4) + " " + std::to_string(k / 4) + " 0\n";
    return text;
}

std::string rich_mtl() {
    return "newmtl m\nKd .1 .2 .3\nKe 1 1 1\nNs 5\nNi 1.2\nillum 2\nd .5\nmap_Kd -s 1 2 p.png\n";
}

// Changes a few bytes: to any, to one that means something, by cutting out or by doubling.
std::string mutate(std::string bytes, Rng& rng) {
    constexpr std::string_view kMeaningful = "{}[]\",:-+.eE0123456789/\\# \n\r\xff\x7f";
    for (std::uint32_t changes = 1 + rng.below(4); changes > 0 && !bytes.empty(); --changes) {
        const std::size_t at = rng.below(static_cast<std::uint32_t>(bytes.size()));
        const std::size_t length = 1 + rng.below(12);
        const auto pick = rng.below(static_cast<std::uint32_t>(kMeaningful.size()));
        switch (rng.below(5)) {
            case 0:
                bytes[at] = static_cast<char>(rng.below(256));
                break;
            case 1:
                bytes[at] = kMeaningful[pick];
                break;
            case 2:
                bytes.erase(at, length);
                break;
            case 3:
                bytes.insert(at, bytes.substr(at, length));
                break;
            default:
                bytes.insert(at, 1, kMeaningful[pick]);
        }
    }
    return bytes;
}

// Loads `name` after each of `count` mutations of `original`, which is that file or `sidecar`.
void expect_loaded_or_refused(const std::string& name, const std::string& original, int count,
                              const std::string& sidecar = "") {
    const TempFolder folder;
    folder.write_picture("p.png");
    folder.write("m.mtl", rich_mtl());
    const std::string changed = sidecar.empty() ? name : sidecar;
    if (!sidecar.empty()) folder.write(name, rich_obj());
    folder.write(changed, original);
    ASSERT_EQ(fault_of([&] { load_scene(folder.path() / name); }), "");

    Rng rng(2002);
    int refused = 0;
    for (int i = 0; i < count; ++i) {
        const std::string bytes = mutate(original, rng);
        folder.write(changed, bytes);
        try {
            load_scene(folder.path() / name);
        } catch (const Error&) {
            ++refused;
        } catch (const std::exception& other) {
            FAIL() << "mutation " << i << ": " << other.what() << "\n" << bytes;
        }
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, count);
}

TEST(Mutation, OfGltfIsLoadedOrRefused) {
    expect_loaded_or_refused("a.gltf", rich_gltf(), 6000);
}

TEST(Mutation, OfBinaryGltfIsLoadedOrRefused) {
    nlohmann::json root = nlohmann::json::parse(rich_gltf());
    root["buffers"][0].erase("uri");
    const auto binary = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    expect_loaded_or_refused("a.glb", make_glb(root.dump(), binary), 4000);
}

TEST(Mutation, OfObjIsLoadedOrRefused) {
    expect_loaded_or_refused("a.obj", rich_obj(), 6000);
}

TEST(Mutation, OfCurvedSurfacesIsLoadedOrRefused) {
    expect_loaded_or_refused("a.obj", curved_obj(), 2000);
    expect_loaded_or_refused("a.bpt", one_bpt(), 1000);
}

TEST(Mutation, OfMtlIsLoadedOrRefused) {
    expect_loaded_or_refused("a.obj", rich_mtl(), 3000, "m.mtl");
}

}  // namespace
}  // namespace chiaro
