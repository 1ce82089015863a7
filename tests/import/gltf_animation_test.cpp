// Animations of glTF: what moves where, and what is refused.

#include "import/import_testing.h"
#include "scene/animate.h"
#include "scene/surface.h"

namespace chiaro {
namespace {

// A triangle whose node, a child of a node 10 to the right, is animated.
struct AnimatedGltf {
    GltfMaker maker = triangle_gltf();
    nlohmann::json channels = nlohmann::json::array(), samplers = nlohmann::json::array();

    AnimatedGltf() {
        maker.root["nodes"][0]["name"] = "moving";
        maker.root["nodes"].push_back({{"children", {0}}, {"translation", {10, 0, 0}}});
        maker.root["scenes"] = {{{"nodes", {1}}}};
    }
    std::size_t add_times(const std::vector<float>& times) {
        return maker.add_accessor(times, "SCALAR", 5126, 1);
    }
    void add(const std::string& path, const std::string& interpolation, std::size_t times,
             std::size_t values, int node = 0) {
        channels.push_back(
            {{"sampler", samplers.size()}, {"target", {{"path", path}, {"node", node}}}});
        samplers.push_back(
            {{"input", times}, {"output", values}, {"interpolation", interpolation}});
    }
    std::string text() {
        maker.root["animations"] = {
            {{"name", "a"}, {"channels", channels}, {"samplers", samplers}}};
        return maker.text();
    }
};

// Where the object's origin is at a time.
Vec3 place_at(const Scene& scene, double seconds) {
    const auto edits = animate(scene, scene.animations.at(0), seconds);
    EXPECT_EQ(edits.size(), 1u);
    return Vec3(std::get<SetTransform>(edits.at(0)).to_world[3]);
}

Scene moved_by(const std::string& interpolation, const std::vector<float>& values,
               const LoadOptions& options = {}) {
    AnimatedGltf made;
    made.add("translation", interpolation, made.add_times({0, 1, 3}), made.maker.add_vec3(values));
    const TempFolder folder;
    return folder.load("a.gltf", made.text(), options);
}

TEST(GltfAnimation, StepsAndLinesGoThroughTheirKeys) {
    const std::vector<float> ways = {0, 0, 0, 0, 2, 0, 0, 6, 0};
    const Scene line = moved_by("LINEAR", ways);
    ASSERT_EQ(line.animations.size(), 1u);
    EXPECT_EQ(line.animations[0].name, "a");
    EXPECT_EQ(line.animations[0].duration, 3);
    EXPECT_EQ(place_at(line, 0.5), Vec3(10, 1, 0));
    EXPECT_EQ(place_at(line, 2), Vec3(10, 4, 0));
    const Scene step = moved_by("STEP", ways);
    EXPECT_EQ(place_at(step, 0.99), Vec3(10, 0, 0));
    EXPECT_EQ(place_at(step, 1), Vec3(10, 2, 0));
    EXPECT_EQ(place_at(step, 2.9), Vec3(10, 2, 0));
}

// A spline whose tangents are its slope is the line.
TEST(GltfAnimation, SplinesHaveTheirTangents) {
    const Scene line = moved_by("CUBICSPLINE", {0, 2, 0, 0, 0, 0, 0, 2, 0,  //
                                                0, 2, 0, 0, 2, 0, 0, 2, 0,  //
                                                0, 2, 0, 0, 6, 0, 0, 2, 0});
    for (const float t : {0.f, 0.25f, 0.5f, 1.f, 1.7f, 2.9f})
        EXPECT_NEAR(place_at(line, double(t)).y, 2 * t, 1e-5f);
    // Without, it rests at its keys: halfway in the middle, a quarter of the way 10/64.
    const Scene ease = moved_by("CUBICSPLINE", std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0, 0,  //
                                                                  0, 0, 0, 0, 1, 0, 0, 0, 0,  //
                                                                  0, 0, 0, 0, 1, 0, 0, 0, 0});
    EXPECT_NEAR(place_at(ease, 0.5).y, 0.5f, 1e-6f);
    EXPECT_NEAR(place_at(ease, 0.25).y, 10 / 64.0f, 1e-6f);
}

TEST(GltfAnimation, StartsAgainAtItsEnd) {
    const Scene line = moved_by("LINEAR", {0, 0, 0, 0, 2, 0, 0, 6, 0});
    EXPECT_EQ(place_at(line, 3.5), place_at(line, 0.5));
    EXPECT_EQ(place_at(line, -1), place_at(line, 2));
}

TEST(GltfAnimation, ScaleOfTheSceneReachesIt) {
    const Scene line = moved_by("LINEAR", {0, 0, 0, 0, 2, 0, 0, 6, 0}, {.scale = 0.5f});
    EXPECT_EQ(place_at(line, 1), Vec3(5, 1, 0));
}

// A quarter turn about z by the shorter arc, in normalized bytes.
TEST(GltfAnimation, RotationsTurnByTheShorterArc) {
    AnimatedGltf made;
    const std::vector<std::int8_t> turns = {0, 0, 0, 127, 0, 0, -90, -90};
    const std::size_t values = made.maker.add_accessor(turns, "VEC4", 5120, 4);
    made.maker.root["accessors"][values]["normalized"] = true;
    made.add("rotation", "LINEAR", made.add_times({0, 1}), values);
    const TempFolder folder;
    const Scene scene = folder.load("a.gltf", made.text());
    const auto edits = animate(scene, scene.animations[0], 0.5);
    const Vec3 x(std::get<SetTransform>(edits.at(0)).to_world[0]);
    EXPECT_NEAR(x.x, std::sqrt(0.5f), 1e-5f);
    EXPECT_NEAR(x.y, std::sqrt(0.5f), 1e-5f);
}

// What hangs on an animated node moves with it: lights keep what else they are.
TEST(GltfAnimation, LightsAndCamerasHangOnNodes) {
    AnimatedGltf made;
    made.maker.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    made.maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
    made.maker.root["nodes"].push_back(
        {{"camera", 0}, {"name", "c"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    made.maker.root["nodes"][0]["children"] = {2};
    made.add("translation", "LINEAR", made.add_times({0, 1}),
             made.maker.add_vec3({0, 0, 0, 0, 4, 0}));
    const TempFolder folder;
    Scene scene = folder.load("a.gltf", made.text());
    scene.lights[0].on = false;
    const auto edits = animate(scene, scene.animations[0], 0.5);
    ASSERT_EQ(edits.size(), 3u);
    const auto& light = std::get<SetLight>(edits[1]).value;
    EXPECT_EQ(light.position, Vec3(10, 2, 0));
    EXPECT_EQ(light.direction, Vec3(0, 0, -1));
    EXPECT_FALSE(light.on);
    const Camera& camera = std::get<SetCamera>(edits[2]).camera;
    EXPECT_EQ(camera.name, "c");
    EXPECT_EQ(camera.eye, Vec3(10, 2, 0));
}

// An object that is scaled to nothing is very small: its place stays one.
TEST(GltfAnimation, ScaledToNothingIsNoPlaceButSmall) {
    AnimatedGltf made;
    made.add("scale", "LINEAR", made.add_times({0, 1}), made.maker.add_vec3({1, 1, 1, 0, 0, 0}));
    const TempFolder folder;
    Scene scene = folder.load("a.gltf", made.text());
    Camera camera;
    for (const double t : {0.0, 0.5, 0.9999999})
        for (const Edit& edit : animate(scene, scene.animations[0], t)) apply(scene, camera, edit);
    EXPECT_LT(bounds(scene).diagonal(), 1e-2f);
}

TEST(GltfAnimation, WhatIsNotSupportedIsNamed) {
    AnimatedGltf made;
    const auto times = made.add_times({0, 1});
    made.add("weights", "LINEAR", times, times);
    made.add("pointer", "LINEAR", times, times);
    const TempFolder folder;
    const Scene scene = folder.load("a.gltf", made.text());
    EXPECT_TRUE(scene.animations.empty());
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_NE(scene.warnings[0].find("the path \"pointer\" is not supported"), std::string::npos);
    EXPECT_NE(scene.warnings[1].find("weights of morph targets are not"), std::string::npos);
}

struct Fault {
    const char* interpolation;
    std::vector<float> times;
    std::size_t values;  // numbers
    const char* message;
};

TEST(GltfAnimation, FaultsAreNamed) {
    const Fault faults[] = {
        {"LINEAR", {0, 0}, 6, "samplers[0].input: times do not rise"},
        {"LINEAR", {1, 0}, 6, "samplers[0].input: times do not rise"},
        {"LINEAR", {-1, 0}, 6, "samplers[0].input: a time is below 0"},
        {"LINEAR", {0, 1}, 9, "samplers[0].output: has 3 values where the times ask for 2"},
        {"CUBICSPLINE", {0, 1}, 6, "samplers[0].output: has 2 values where the times ask for 6"},
        {"BEZIER", {0, 1}, 6, "samplers[0].interpolation: is none of STEP, LINEAR"},
    };
    const TempFolder folder;
    for (const Fault& fault : faults) {
        AnimatedGltf made;
        made.add("translation", fault.interpolation, made.add_times(fault.times),
                 made.maker.add_vec3(std::vector<float>(fault.values, 1.0f)));
        EXPECT_NE(fault_of_file(folder, "a.gltf", made.text()).find(fault.message),
                  std::string::npos)
            << fault.message;
    }
    AnimatedGltf turned;
    const auto times = turned.add_times({0, 1});
    turned.add("rotation", "LINEAR", times, turned.maker.add_vec3({0, 0, 0, 0, 0, 0}));
    EXPECT_NE(fault_of_file(folder, "a.gltf", turned.text()).find("rotations are not VEC4"),
              std::string::npos);
    AnimatedGltf matrix;
    matrix.maker.root["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    matrix.add("translation", "LINEAR", matrix.add_times({0}), matrix.maker.add_vec3({0, 0, 0}));
    EXPECT_NE(fault_of_file(folder, "a.gltf", matrix.text()).find("has a matrix"),
              std::string::npos);
}

// Every channel's last key is where the objects are just before the end.
TEST(GltfAnimation, ARealFileMovesAllItsParts) {
    const std::filesystem::path file =
        std::filesystem::path(CHIARO_SCENES) / "gltf_small/03_all_animations.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP();
    Scene scene = load_scene(file);
    ASSERT_FALSE(scene.animations.empty());
    Camera camera;
    for (const Animation& animation : scene.animations) {
        EXPECT_GT(animation.duration, 0);
        const auto start = animate(scene, animation, 0);
        const auto middle = animate(scene, animation, 0.4 * double(animation.duration));
        ASSERT_FALSE(start.empty());
        ASSERT_EQ(start.size(), middle.size());
        int moving = 0;
        for (std::size_t i = 0; i < start.size(); ++i)
            if (const auto* move = std::get_if<SetTransform>(&middle[i]))
                moving += move->to_world != std::get<SetTransform>(start[i]).to_world;
        EXPECT_GT(moving, 0) << animation.name;
        for (const Edit& edit : middle) apply(scene, camera, edit);
    }
    check_scene(scene);
}

}  // namespace
}  // namespace chiaro
