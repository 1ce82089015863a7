#include "import/import_testing.h"
#include "scene/surface.h"

namespace chiaro {
namespace {

using nlohmann::json;

std::string png_uri() {
    const TempFolder folder;
    folder.write_picture("p.png");
    return "data:image/png;base64," + base64(read_text(folder.path() / "p.png"));
}

// The triangle with texture coordinates and a material that the test fills.
GltfMaker textured_triangle(const json& material) {
    GltfMaker maker = triangle_gltf();
    maker.primitive()["attributes"]["TEXCOORD_0"] = maker.add_vec2({0, 0, 1, 0, 0, 1});
    maker.primitive()["material"] = 0;
    maker.root["materials"] = {material};
    maker.root["images"] = {{{"uri", png_uri()}}};
    maker.root["textures"] = {{{"source", 0}}};
    return maker;
}

Material material_of(const GltfMaker& maker) {
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    return scene.material(scene.meshes.at(0).primitives.at(0).material);
}

TEST(ReadGltf, ATriangleIsRead) {
    const Scene scene = TempFolder().load("a.gltf", triangle_gltf().text());
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "object 1");
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1u);
    EXPECT_NEAR(primitive_area(scene, ObjectId{0}, 0), 0.5f, 1e-6f);
    // glTF's own default material.
    EXPECT_EQ(scene.materials[0].base_color, Rgb(1));
    EXPECT_FALSE(scene.materials[0].double_sided);
}

TEST(ReadGltf, ABinaryFileKeepsItsBufferInTheSecondChunk) {
    GltfMaker maker = triangle_gltf();
    maker.root["buffers"][0].erase("uri");
    const auto binary = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    EXPECT_EQ(TempFolder().load("a.GLB", make_glb(maker.text(), binary)).objects.size(), 1u);
}

TEST(ReadGltf, ABufferMayBeAFileWithAnEncodedName) {
    const TempFolder folder;
    GltfMaker maker = triangle_gltf();
    maker.root["buffers"][0]["uri"] = "sub/my%20data.bin";
    folder.write("sub/my data.bin",
                 bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 7, 7, 7}));
    EXPECT_EQ(folder.load("a.gltf", maker.text()).objects.size(), 1u);
}

TEST(ReadGltf, NodesMoveTheirChildrenByMatrixOrByParts) {
    GltfMaker maker = triangle_gltf();
    const double half = std::sqrt(0.5);
    maker.root["nodes"] = {
        {{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {0, 0, half, half}}},
        {{"children", {2}}, {"scale", {2, 2, 2}}},
        {{"mesh", 0},
         {"name", "leaf"},
         {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1}}}};
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    EXPECT_EQ(scene.objects[0].name, "leaf");
    // The origin goes to (1, 0, 0), is scaled to (2, 0, 0), turned to (0, 2, 0) and moved.
    const Vec3 origin = Vec3(scene.objects[0].to_world[3]);
    EXPECT_NEAR(origin.x, 10, 1e-5);
    EXPECT_NEAR(origin.y, 2, 1e-5);
}

TEST(ReadGltf, InstancesShareTheirMeshAndHaveNamesOfTheirOwn) {
    GltfMaker maker = triangle_gltf();
    maker.root["meshes"][0]["name"] = "Chair";
    maker.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}, {{"mesh", 0}, {"name", "Chair.2"}}};
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "Chair");
    EXPECT_EQ(scene.objects[1].name, "Chair.2");
    EXPECT_EQ(scene.objects[2].name, "Chair.2.2");
}

TEST(ReadGltf, OnlyTheDefaultSceneIsRead) {
    GltfMaker maker = triangle_gltf();
    maker.root["nodes"] = {{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}};
    maker.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    const TempFolder folder;
    EXPECT_EQ(folder.load("a.gltf", maker.text()).objects[0].name, "a");
    maker.root["scene"] = 1;
    EXPECT_EQ(folder.load("a.gltf", maker.text()).objects[0].name, "b");
}

TEST(ReadGltf, ANestingOfAHundredThousandNodesIsWalked) {
    GltfMaker maker = triangle_gltf();
    const int depth = 100000;
    json nodes = json::array();
    for (int i = 0; i + 1 < depth; ++i) nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    maker.root["nodes"] = nodes;
    EXPECT_EQ(TempFolder().load("a.gltf", maker.text()).objects.size(), 1u);
}

TEST(ReadGltf, EveryWayToListTrianglesGivesThem) {
    const auto triangles = [](int mode, const std::vector<std::uint16_t>& indices) {
        GltfMaker maker = triangle_gltf();
        maker.primitive()["attributes"]["POSITION"] =
            maker.add_vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        maker.primitive()["mode"] = mode;
        if (!indices.empty()) maker.primitive()["indices"] = maker.add_indices(indices);
        const Scene scene = TempFolder().load("a.gltf", maker.text());
        double area = 0;  // signed: shows that the winding is kept
        for (std::uint32_t i = 0; !scene.objects.empty() && i < scene.meshes[0].primitives.size();
             ++i) {
            const SurfaceGeometry g = surface_geometry(scene, {ObjectId{0}, i, 0.3f, 0.3f});
            area += g.geometric_normal.z * primitive_area(scene, ObjectId{0}, i);
        }
        return area;
    };
    EXPECT_NEAR(triangles(4, {0, 1, 2, 0, 2, 3}), 1, 1e-6);  // triangles
    EXPECT_NEAR(triangles(5, {0, 1, 3, 2}), 1, 1e-6);        // strip
    EXPECT_NEAR(triangles(6, {0, 1, 2, 3}), 1, 1e-6);        // fan
    EXPECT_NEAR(triangles(6, {}), 1, 1e-6);                  // fan without indices
    EXPECT_NEAR(triangles(4, {0, 1, 2, 0}), 0.5, 1e-6);      // one corner left over
    EXPECT_EQ(triangles(0, {0, 1, 2}), 0);                   // points
    EXPECT_EQ(triangles(1, {0, 1}), 0);                      // lines
}

TEST(ReadGltf, IndicesOfEverySizeAreRead) {
    for (const int component : {5121, 5123, 5125}) {
        GltfMaker maker = triangle_gltf();
        maker.primitive()["indices"] =
            component == 5121   ? maker.add_accessor<std::uint8_t>({0, 1, 2}, "SCALAR", 5121, 1)
            : component == 5123 ? maker.add_indices({0, 1, 2})
                                : maker.add_accessor<std::uint32_t>({0, 1, 2}, "SCALAR", 5125, 1);
        EXPECT_EQ(TempFolder().load("a.gltf", maker.text()).objects.size(), 1u);
    }
}

TEST(ReadGltf, NormalsAreMadeUnitAndTheFacesOwnWhereTheyAreZeroOrAbsent) {
    GltfMaker maker = triangle_gltf();
    json flat = maker.primitive();
    maker.primitive()["attributes"]["NORMAL"] = maker.add_vec3({0, 3, 4, 0, 0, 0, 0, 0, 2});
    maker.root["meshes"][0]["primitives"].push_back(flat);
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    const Mesh& mesh = scene.meshes[0];
    const auto& first = mesh.primitives[0].corners;
    EXPECT_NEAR(glm::distance(mesh.normals[first[0]], Vec3(0, 0.6f, 0.8f)), 0, 1e-6);
    EXPECT_EQ(mesh.normals[first[1]], Vec3(0, 0, 1));
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(mesh.normals[mesh.primitives[1].corners[i]], Vec3(0, 0, 1));
}

TEST(ReadGltf, PrimitivesOfOneMeshBecomeOneMeshThatSharesItsPoints) {
    GltfMaker maker = triangle_gltf();
    maker.root["materials"] = {{{"name", "red"}}, {{"name", "red"}}};
    json second = maker.primitive();
    second["indices"] = maker.add_indices({0, 2, 1});
    second["material"] = 1;
    maker.primitive()["material"] = 0;
    maker.root["meshes"][0]["primitives"].push_back(second);
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    EXPECT_EQ(scene.meshes[0].primitives.size(), 2u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 3u);
    EXPECT_EQ(scene.materials[0].name, "red");
    EXPECT_EQ(scene.materials[1].name, "red.2");
}

TEST(ReadGltf, VertexColoursOfEveryFormatAreRead) {
    const auto color = [](std::size_t (*add)(GltfMaker&)) {
        GltfMaker maker = triangle_gltf();
        const std::size_t accessor = add(maker);
        maker.primitive()["attributes"]["COLOR_0"] = accessor;
        maker.root["accessors"][accessor]["normalized"] =
            maker.root["accessors"][accessor]["componentType"] != 5126;
        return TempFolder().load("a.gltf", maker.text()).meshes[0].colors.at(0);
    };
    const Vec4 expected(1, 0.2f, 0, 1);
    const auto near = [&](Vec4 c) { return glm::length(c - expected) < 1e-6f; };
    EXPECT_TRUE(near(color([](GltfMaker& m) {
        return m.add_vec3({1, 0.2f, 0, 0, 0, 0, 0, 0, 0});
    })));
    EXPECT_TRUE(near(color([](GltfMaker& m) {
        return m.add_accessor<std::uint8_t>({255, 51, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 5121,
                                            4);
    })));
    EXPECT_TRUE(near(color([](GltfMaker& m) {
        return m.add_accessor<std::uint16_t>({65535, 13107, 0, 65535, 0, 0, 0, 0, 0, 0, 0, 0},
                                             "VEC4", 5123, 4);
    })));
}

TEST(ReadGltf, SparseAccessorsReplaceElementsOfADenseOneOrOfZeros) {
    GltfMaker maker = triangle_gltf();
    const std::size_t places = maker.add_accessor<std::uint8_t>({1}, "SCALAR", 5121, 1);
    const std::size_t values = maker.add_vec3({5, 0, 0});
    maker.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", places}, {"componentType", 5121}}},
        {"values", {{"bufferView", values}}}};
    const TempFolder folder;
    EXPECT_EQ(folder.load("a.gltf", maker.text()).meshes[0].positions[1], Vec3(5, 0, 0));
    EXPECT_EQ(folder.load("a.gltf", maker.text()).meshes[0].positions[2], Vec3(0, 1, 0));

    const std::size_t far = maker.add_accessor<std::uint8_t>({9}, "SCALAR", 5121, 1);
    maker.root["accessors"][0]["sparse"]["indices"]["bufferView"] = far;
    EXPECT_EQ(fault_of_file(folder, "a.gltf", maker.text()),
              "a.gltf: accessors[0].sparse.indices: element 9 is not there");

    auto& sparse = maker.root["accessors"][0]["sparse"];
    sparse["count"] = 2;
    sparse["values"]["bufferView"] = maker.add_vec3({0, 1, 0, 5, 0, 0});
    sparse["indices"]["bufferView"] = maker.add_accessor<std::uint8_t>({2, 1}, "SCALAR", 5121, 1);
    EXPECT_EQ(
        fault_of_file(folder, "a.gltf", maker.text()),
        "a.gltf: accessors[0].sparse.indices: element 1 does not come after the one before it");
}

TEST(ReadGltf, QuantizedPositionsNeedTheirExtension) {
    GltfMaker maker = triangle_gltf();
    const std::size_t accessor = maker.add_accessor<std::int16_t>(
        {0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0}, "VEC3", 5122, 4);
    maker.root["accessors"][accessor]["count"] = 3;
    maker.root["accessors"][accessor]["normalized"] = true;
    maker.root["bufferViews"][1]["byteStride"] = 8;
    maker.primitive()["attributes"]["POSITION"] = accessor;
    const TempFolder folder;
    EXPECT_NE(fault_of_file(folder, "a.gltf", maker.text()).find("format"), std::string::npos);
    maker.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    maker.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(folder.load("a.gltf", maker.text()).meshes[0].positions[1], Vec3(1, 0, 0));
}

TEST(ReadGltf, AMaterialsFieldsAreReadAsTheyStand) {
    const Material m = material_of(
        textured_triangle({{"name", "Wall"},
                           {"pbrMetallicRoughness",
                            {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}},
                             {"metallicFactor", 0.5},
                             {"roughnessFactor", 0.25},
                             {"metallicRoughnessTexture", {{"index", 0}}}}},
                           {"emissiveFactor", {1, 0.5, 0}},
                           {"alphaMode", "MASK"},
                           {"alphaCutoff", 0.3},
                           {"doubleSided", true},
                           {"extensions",
                            {{"KHR_materials_emissive_strength", {{"emissiveStrength", 100}}},
                             {"KHR_materials_ior", {{"ior", 1.4}}},
                             {"KHR_materials_specular",
                              {{"specularFactor", 0.7}, {"specularColorFactor", {1, 0.9, 0.8}}}},
                             {"KHR_materials_transmission", {{"transmissionFactor", 0.6}}}}}}));
    EXPECT_EQ(m.name, "Wall");
    EXPECT_EQ(m.base_color, Rgb(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(m.alpha, 0.75f);
    EXPECT_EQ(m.emission, Rgb(100, 50, 0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.3f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_TRUE(m.emits_backward);
    EXPECT_EQ(m.gloss.metallic, 0.5f);
    EXPECT_EQ(m.gloss.roughness, 0.25f);
    EXPECT_TRUE(m.gloss.metallic_roughness.used());
    EXPECT_EQ(m.gloss.ior, 1.4f);
    EXPECT_EQ(m.gloss.specular_factor, 0.7f);
    EXPECT_EQ(m.gloss.specular_color, Rgb(1, 0.9f, 0.8f));
    EXPECT_EQ(m.gloss.transmission, 0.6f);
    EXPECT_EQ(m.gloss.model, GlossModel::metallic_roughness);
    EXPECT_TRUE(m.gloss.thin);
}

// KHR_materials_volume: the surface of a solid where the thickness is above 0.
TEST(ReadGltf, AThicknessMakesGlassSolid) {
    for (const double thickness : {0.0, 0.1}) {
        const Material m = material_of(
            textured_triangle({{"extensions",
                                {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                                 {"KHR_materials_volume", {{"thicknessFactor", thickness}}}}}}));
        EXPECT_EQ(m.gloss.thin, thickness == 0);
    }
}

TEST(ReadGltf, ATextureKeepsItsSamplerAndItsUseTheTransform) {
    GltfMaker maker = textured_triangle({{"pbrMetallicRoughness",
                                          {{"baseColorTexture",
                                            {{"index", 0},
                                             {"texCoord", 0},
                                             {"extensions",
                                              {{"KHR_texture_transform",
                                                {{"offset", {0.5, 0.25}},
                                                 {"scale", {2, 3}},
                                                 {"rotation", 0.1},
                                                 {"texCoord", 1}}}}}}}}}});
    maker.root["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
    maker.root["textures"][0]["sampler"] = 0;
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    const Texture& texture = scene.textures.at(0);
    EXPECT_EQ(texture.width, 2);
    EXPECT_EQ(texture.texels[1], (std::array<std::uint8_t, 4>{0, 255, 0, 255}));
    EXPECT_TRUE(texture.nearest);
    EXPECT_TRUE(texture.srgb);
    EXPECT_EQ(texture.wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(texture.wrap_v, Wrap::mirrored_repeat);
    const TextureUse& use = scene.materials[0].base_color_texture;
    EXPECT_EQ(use.uv_set, 1);
    EXPECT_EQ(use.offset, Vec2(0.5f, 0.25f));
    EXPECT_EQ(use.scale, Vec2(2, 3));
    EXPECT_EQ(use.rotation, 0.1f);
}

TEST(ReadGltf, LightsShineAlongMinusZInCandelaAndLux) {
    GltfMaker maker = triangle_gltf();
    const double half = std::sqrt(0.5);
    maker.root["extensionsUsed"] = {"KHR_lights_punctual"};
    maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 100}, {"range", 5}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}},
        {{"type", "directional"}, {"name", "Sun"}, {"intensity", 1000}},
        {{"type", "spherical"}}};
    for (int i = 0; i < 4; ++i)
        maker.root["nodes"].push_back({{"translation", {1, 2, 3}},
                                       {"scale", {3, 3, 3}},
                                       {"rotation", {-half, 0, 0, half}},  // -z becomes -y
                                       {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const Scene scene = TempFolder().load("a.gltf", maker.text(), {.scale = 2});
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].intensity, Rgb(100, 50, 0));
    EXPECT_EQ(scene.lights[0].position, Vec3(2, 4, 6));
    EXPECT_EQ(scene.lights[0].range, 10);
    EXPECT_EQ(scene.lights[1].kind, LightKind::spot);
    EXPECT_EQ(scene.lights[1].intensity, Rgb(1));
    EXPECT_EQ(scene.lights[1].inner_cone, 0.2f);
    EXPECT_EQ(scene.lights[1].outer_cone, 0.4f);
    EXPECT_NEAR(glm::distance(scene.lights[1].direction, Vec3(0, -1, 0)), 0, 1e-6);
    EXPECT_EQ(scene.lights[2].name, "Sun");
    EXPECT_EQ(scene.lights[2].intensity, Rgb(1000));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(ReadGltf, ACameraLooksAlongItsNodesMinusZ) {
    GltfMaker maker = triangle_gltf();
    maker.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 1}}}}};
    maker.root["nodes"].push_back({{"camera", 0}, {"name", "View"}, {"translation", {0, 1, 5}}});
    maker.root["nodes"].push_back({{"camera", 1}});
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "View");
    EXPECT_EQ(camera.eye, Vec3(0, 1, 5));
    EXPECT_LT(camera.target.z, camera.eye.z);
    EXPECT_EQ(camera.target.y, 1);
    EXPECT_EQ(camera.up, Vec3(0, 1, 0));
    EXPECT_NEAR(camera.vertical_fov, 28.6479f, 1e-3f);
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(ReadGltf, WhatIsLeftOutIsSaidOnce) {
    GltfMaker maker = triangle_gltf();
    maker.root["nodes"].push_back({{"name", "joint"}});
    maker.root["skins"] = {{{"joints", {1}}}, {{"joints", {1}}}};
    maker.root["animations"] = {
        {{"samplers", {{{"input", 0}, {"output", 0}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"path", "weights"}}}}}}}};
    maker.primitive()["targets"] = {{{"POSITION", 0}}};
    maker.root["extensionsUsed"] = {"KHR_materials_sheen", "EXT_x\ny"};
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    EXPECT_EQ(scene.warnings.size(), 4u);
    for (const std::string& warning : scene.warnings)
        EXPECT_EQ(warning.find('\n'), std::string::npos);
}

TEST(ReadGltf, AnObjectScaledToNothingIsLeftOut) {
    for (const double scale : {0.0, 1e-30, 1e-9}) {
        GltfMaker maker = triangle_gltf();
        maker.root["nodes"].push_back({{"mesh", 0}, {"scale", {1, scale, 1}}});
        const Scene scene = TempFolder().load("a.gltf", maker.text());
        EXPECT_EQ(scene.objects.size(), 1u);
        EXPECT_EQ(scene.warnings.size(), 1u);
    }
}

TEST(ReadGltf, AMaterialOfNoSurfaceMayNameImagesThatAreAbsent) {
    GltfMaker maker =
        textured_triangle({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    maker.root["images"][0]["uri"] = "gone.png";
    const TempFolder folder;
    EXPECT_NE(fault_of_file(folder, "a.gltf", maker.text()).find("gone.png"), std::string::npos);
    maker.root["nodes"][0]["scale"] = {0, 0, 0};
    EXPECT_EQ(fault_of_file(folder, "a.gltf", maker.text()), "");
}

TEST(ReadGltf, NormalMapsAreLeftOutWithOneWarning) {
    GltfMaker maker = textured_triangle({{"normalTexture", {{"index", 0}}}});
    json second = maker.primitive();
    second["material"] = 1;
    maker.root["materials"].push_back(maker.root["materials"][0]);
    maker.root["meshes"][0]["primitives"].push_back(second);
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("materials[0].normalTexture: normal maps"), std::string::npos);
}

TEST(ReadGltf, TexturesOfExtensionsAreLeftOutWithAWarning) {
    const GltfMaker maker = textured_triangle(
        {{"extensions",
          {{"KHR_materials_transmission",
            {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}}}}});
    const Scene scene = TempFolder().load("a.gltf", maker.text());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("KHR_materials_transmission.transmissionTexture: textures"),
              std::string::npos);
}

}  // namespace
}  // namespace chiaro
