#include "import/import_testing.h"
#include "scene/surface.h"

namespace chiaro {
namespace {

// A unit square, texture coordinates as positions, of material `m`.
std::string square(const std::string& libraries) {
    return libraries +
           "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "usemtl m\nf 1/1 2/2 3/3 4/4\n";
}

Material material_of(const TempFolder& folder, const std::string& properties) {
    folder.write("m.mtl", "newmtl m\n" + properties);
    const Scene scene = folder.load("a.obj", square("mtllib m.mtl"));
    return scene.material(scene.meshes[0].primitives[0].material);
}

TEST(ReadMtl, ColoursLightAndGlossAreReadAsTheyStand) {
    const Material m = material_of(TempFolder(),
                                   "Kd 0.1 0.2 0.3 # rgb\nKs .4\n\tKe 17 12 4\nNs 50\nNi 1.3\n"
                                   "illum 5\nPr 0.25\nPm 1\nTf 1 .5 0\n");
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.base_color, Rgb(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.emission, Rgb(17, 12, 4));
    EXPECT_TRUE(m.double_sided);
    EXPECT_FALSE(m.emits_backward);
    EXPECT_EQ(m.gloss.specular, Rgb(0.4f));
    EXPECT_EQ(m.gloss.shininess, 50);
    EXPECT_EQ(m.gloss.ior, 1.3f);
    EXPECT_EQ(m.gloss.illumination_model, 5);
    EXPECT_EQ(m.gloss.roughness, 0.25f);
    EXPECT_EQ(m.gloss.metallic, 1);
    EXPECT_EQ(m.gloss.transmission_color, Rgb(1, 0.5f, 0));
    EXPECT_EQ(m.gloss.model, GlossModel::metallic_roughness);
    EXPECT_EQ(material_of(TempFolder(), "Ks 1 1 1\n").gloss.model, GlossModel::phong);
}

// illum 4, 6 and 7 are glass; an index of 1 is that of other surfaces.
TEST(ReadMtl, GlassTransmits) {
    const TempFolder folder;
    for (const std::string model : {"4", "6", "7"}) {
        const Material m = material_of(folder, "d 0.1\nNi 1.5\nillum " + model + "\n");
        EXPECT_FALSE(m.see_through()) << model;
        EXPECT_EQ(m.gloss.transmission, 1);
        EXPECT_TRUE(m.gloss.thin);  // a single square encloses nothing
    }
    for (const std::string other : {"Ni 1.0\nillum 4\n", "Ni 1.5\nillum 2\n"}) {
        const Material m = material_of(folder, "d 0.1\n" + other);
        EXPECT_EQ(m.gloss.transmission, 0);
        EXPECT_EQ(m.alpha_mode, AlphaMode::blend);
    }
}

TEST(ReadMtl, GlassThatEnclosesAVolumeIsSolid) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl m\nillum 7\n");
    const Scene scene = folder.load("a.obj",
                                    "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    EXPECT_FALSE(scene.materials[0].gloss.thin);
}

TEST(ReadMtl, OpacityBelowOneBlends) {
    const TempFolder folder;
    EXPECT_EQ(material_of(folder, "d 1\n").alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(material_of(folder, "Tr 0\n").alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(material_of(folder, "d 0.25\n").alpha_mode, AlphaMode::blend);
    EXPECT_EQ(material_of(folder, "d 0.25\n").alpha, 0.25f);
    EXPECT_EQ(material_of(folder, "Tr 0.25\n").alpha, 0.75f);
}

TEST(ReadMtl, AMapIsReadFromItsBottomLeft) {
    const TempFolder folder;
    Image image(1, 2);
    image.at(0, 0) = Rgb(1, 0, 0);  // top
    image.at(0, 1) = Rgb(0, 0, 1);
    write_png(folder.path() / "two.png", image);
    folder.write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd -clamp on two.png\n");
    const Scene scene = folder.load("a.obj", square("mtllib m.mtl"));
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp_to_edge);
    const Vec4 bottom = base_color(scene, {ObjectId{0}, 0, 0.0f, 0.0f});
    const Vec4 top = base_color(scene, {ObjectId{0}, 0, 0.0f, 1.0f});
    EXPECT_NEAR(bottom.z, 1, 1e-5);
    EXPECT_NEAR(bottom.x, 0, 1e-5);
    EXPECT_NEAR(top.x, 1, 1e-5);
}

TEST(ReadMtl, OptionsOfAMapMoveAndScaleIt) {
    const TempFolder folder;
    folder.write_picture("with space.png");
    const Material m = material_of(
        folder, "Kd 1 1 1\nmap_Kd -s 2 4 1 -o 0.25 0.5 -mm 0 0.5 -bm 1 with space.png\n");
    ASSERT_TRUE(m.base_color_texture.used());
    EXPECT_EQ(m.base_color, Rgb(0.5f));
    // OBJ's (u, v) looks up (2 u + 1/4, 4 v + 1/2), counted from the bottom.
    const Vec2 found = m.base_color_texture.transform(Vec2(0.1f, 1 - 0.2f));
    EXPECT_NEAR(found.x, 2 * 0.1f + 0.25f, 1e-6);
    EXPECT_NEAR(1 - found.y, 4 * 0.2f + 0.5f, 1e-6);
}

TEST(ReadMtl, AMapBesideBlackCountsFully) {
    const TempFolder folder;
    folder.write_picture("p.png");
    const Material m = material_of(folder, "Kd 0 0 0\nmap_Kd p.png\nKe 0 0 0\nmap_Ke p.png\n");
    EXPECT_EQ(m.base_color, Rgb(1));
    EXPECT_EQ(m.emission, Rgb(1));
    EXPECT_EQ(m.emission_texture.texture, m.base_color_texture.texture);
}

TEST(ReadMtl, AnOpacityMapInTheColourMapMasks) {
    const TempFolder folder;
    folder.write_picture("p.png");
    EXPECT_EQ(material_of(folder, "map_Kd p.png\nmap_d p.png\n").alpha_mode, AlphaMode::mask);
}

TEST(ReadMtl, LibrariesMayBeSeveralHaveSpacesAndLieInAFolder) {
    const TempFolder folder;
    folder.write_picture("maps/textures/p.png");
    folder.write("a b.mtl", "newmtl other\n");
    folder.write("maps/m.mtl", "newmtl m\nKd 1 0 0\nmap_Kd textures\\p.png\n");
    const Scene scene = folder.load("a.obj", square("mtllib a b.mtl\nmtllib none.mtl maps/m.mtl"));
    EXPECT_EQ(scene.textures.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("none.mtl"), std::string::npos);
}

TEST(ReadMtl, AMissingLibraryOrMaterialLeavesGreyAndAWarning) {
    const TempFolder folder;
    const Scene scene = folder.load("a.obj", square("mtllib gone.mtl"));
    EXPECT_EQ(scene.warnings.size(), 2u);
    EXPECT_EQ(scene.material(scene.meshes[0].primitives[0].material).base_color, Rgb(0.8f));
}

TEST(ReadMtl, AnAbsentOrBrokenMapIsRefusedOnlyWhereASurfaceNeedsIt) {
    const TempFolder folder;
    folder.write("broken.png", "\x89PNG\r\n\x1a\nxx");
    folder.write("m.mtl", "newmtl unused\nmap_Kd gone.png\nnewmtl m\nKd 1 1 1\n");
    EXPECT_NO_THROW(folder.load("a.obj", square("mtllib m.mtl")));
    for (const std::string map : {"gone.png", "broken.png", "../up.png", "/etc/passwd"}) {
        folder.write("m.mtl", "newmtl m\nmap_Kd " + map + "\n");
        const std::string fault = fault_of_file(folder, "a.obj", square("mtllib m.mtl"));
        EXPECT_TRUE(fault.starts_with("m.mtl:2: ")) << fault;
    }
}

// What stands behind a # may be a comment or, as in "Material #25", part of a name.
TEST(ReadMtl, NamesMayBeFollowedByCommentsAndHoldNumberSigns) {
    const TempFolder folder;
    folder.write_picture("p.png");
    folder.write_picture("p #2.png");
    folder.write("m.mtl",
                 "\xef\xbb\xbfnewmtl m\nKd 1 0 0\nmap_Kd p.png # wood\n"
                 "newmtl Material #25\nKd 0 1 0\nmap_Kd p #2.png\n");
    const Scene scene = folder.load("a.obj",
                                    "mtllib m.mtl # ours\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                    "usemtl m # red\nf 1 2 3\nusemtl Material #25\nf 1 2 3\n");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].base_color, Rgb(1, 0, 0));
    EXPECT_EQ(scene.materials[1].base_color, Rgb(0, 1, 0));
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_EQ(scene.textures[1].name, "p #2.png");
}

// A surface needs a material once it has a polygon with an area.
TEST(ReadMtl, AMaterialOfNoSurfaceMayNameMapsThatAreAbsent) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl gone\nmap_Kd gone.png\nnewmtl m\nKd 1 1 1\n");
    EXPECT_NO_THROW(folder.load("a.obj", square("mtllib m.mtl\nusemtl gone")));
    EXPECT_NO_THROW(folder.load("a.obj", square("mtllib m.mtl") + "usemtl gone\nf 1 2 1\n"));
    EXPECT_NE(fault_of_file(folder, "a.obj", square("mtllib m.mtl") + "usemtl gone\nf 1 2 3\n")
                  .find("gone.png"),
              std::string::npos);
    EXPECT_TRUE(folder.load("a.obj", square("mtllib m.mtl\nusemtl absent")).warnings.empty());
}

// A definition that comes later is of those who come after it.
TEST(ReadMtl, AMaterialDefinedAgainLeavesEarlierSurfacesAsTheyWere) {
    const TempFolder folder;
    folder.write_picture("p.png");
    folder.write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd p.png\n");
    folder.write("n.mtl", "newmtl m\nKd 0 1 0\n");
    const Scene scene =
        folder.load("a.obj", square("mtllib m.mtl") + "mtllib n.mtl\nusemtl m\nf 1/1 2/2 3/3\n");
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_TRUE(scene.materials[0].base_color_texture.used());
    EXPECT_FALSE(scene.materials[1].base_color_texture.used());
    EXPECT_EQ(scene.materials[1].base_color, Rgb(0, 1, 0));
}

TEST(ReadMtl, BumpMapsAreLeftOutWithOneWarning) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl m\nbump b.png\nnewmtl n\nmap_Bump -bm 1 b.png\nnorm n.png\n");
    const Scene scene = folder.load("a.obj", square("mtllib m.mtl"));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("m.mtl:2: bump"), std::string::npos);
}

TEST(ReadMtl, LightTooBrightToSquareIsRefusedByName) {
    const TempFolder folder;
    folder.write_picture("p.png");
    const auto fault = [&](const std::string& properties) {
        folder.write("m.mtl", "newmtl m\n" + properties);
        return fault_of_file(folder, "a.obj", square("mtllib m.mtl"));
    };
    EXPECT_EQ(fault("Ke 0 1e15 0\n"), "");
    for (const std::string bright :
         {"Ke 0 1.1e15 0\n", "Ke 3e38\n", "Ke 1\nmap_Ke -mm 0 1e16 p.png\n"})
        EXPECT_EQ(fault(bright), "a.obj: material \"m\" emits more than 1e15 cd/m2");
}

// Those who put a file into the folder do not choose what else is read.
TEST(ReadMtl, ALinkThatLeadsOutOfTheFolderIsRefused) {
    const TempFolder folder;
    folder.write_picture("p.png");
    folder.write_picture("scene/real.png");
    std::filesystem::create_symlink("../p.png", folder.path() / "scene/out.png");
    std::filesystem::create_symlink("real.png", folder.path() / "scene/in.png");
    std::filesystem::create_symlink("..", folder.path() / "scene/up");
    const auto fault = [&](const std::string& map) {
        folder.write("scene/m.mtl", "newmtl m\nmap_Kd " + map + "\n");
        return fault_of_file(folder, "scene/a.obj", square("mtllib m.mtl"));
    };
    EXPECT_EQ(fault("in.png"), "");
    for (const char* map : {"out.png", "up/p.png"})
        EXPECT_NE(fault(map).find("leads out of the scene's folder"), std::string::npos) << map;
}

// A link to a scene is that scene, with what lies beside it there.
TEST(ReadMtl, ASceneThatIsALinkNamesFilesFromWhereItReallyIs) {
    const TempFolder folder;
    folder.write("real/m.mtl", "newmtl m\nKd 1 0 0\n");
    folder.write("real/a.obj", square("mtllib m.mtl"));
    std::filesystem::create_symlink("real/a.obj", folder.path() / "link.obj");
    EXPECT_TRUE(load_scene(folder.path() / "link.obj").warnings.empty());
}

TEST(ReadMtl, FaultsNameTheLineOfTheLibrary) {
    const TempFolder folder;
    const auto fault = [&](const std::string& properties) {
        folder.write("m.mtl", "newmtl m\n" + properties);
        return fault_of_file(folder, "a.obj", square("mtllib m.mtl"));
    };
    EXPECT_EQ(fault("Kd 1 x 1\n"), "m.mtl:2: Kd: \"x\" is not a number");
    EXPECT_EQ(fault("\nKd 1 1\n"), "m.mtl:3: Kd is missing");
    EXPECT_EQ(fault("Ke nan\n"), "m.mtl:2: Ke: \"nan\" is not finite");
    EXPECT_EQ(fault("Kd spectral f.rfl\n"), "m.mtl:2: Kd spectral is not supported");
    EXPECT_EQ(fault("map_Kd\n"), "m.mtl:2: a map without the name of a file");
}

}  // namespace
}  // namespace chiaro
