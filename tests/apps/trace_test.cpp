// chiaro trace: light at points, a line in and a line out, as Radiance's rtrace.
#include "apps/command.h"

namespace chiaro {
namespace {

std::vector<float> numbers(const std::string& text) {
    std::vector<float> values;
    std::istringstream in(text);
    for (float v; in >> v;) values.push_back(v);
    return values;
}

// Under 100 cd at a height of 2: E = 100 x 2 / (4 + r^2)^1.5, exactly, since the floor is alone.
constexpr char kLamp[] = R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":100}]}},
    "nodes":[{"translation":[0,2,0],"extensions":{"KHR_lights_punctual":{"light":0}}}],
    "scenes":[{"nodes":[0]}]})";

TEST(Trace, IlluminanceIsExactUnderAPointLight) {
    const TempFolder folder;
    const std::string scene = folder.write("lamp.gltf", kLamp).string();
    const std::string points = "0 0 0 0 1 0\n1 0 0 0 2 0\n\n  0 0 -3 0 1e-3 0\r\n0 0 0 0 -1 0\n";
    const auto lux = numbers(expect_done({"trace", "-I", "--lux", scene}, points).out);
    ASSERT_EQ(lux.size(), 4u);  // a blank line is no point
    EXPECT_NEAR(lux[0], 25, 1e-3);
    EXPECT_NEAR(lux[1], 200 / std::pow(5, 1.5), 1e-3);
    EXPECT_NEAR(lux[2], 200 / std::pow(13, 1.5), 1e-3);
    EXPECT_EQ(lux[3], 0);
    const auto rgb = numbers(expect_done({"trace", "-I", scene}, "0 0 0 0 1 0").out);
    ASSERT_EQ(rgb.size(), 3u);
    for (const float v : rgb) EXPECT_NEAR(v, 25, 1e-3);
    EXPECT_EQ(expect_done({"trace", "-I", scene}, "").out, "");
}

// Along rays: the Cornell box's lamp shines with (17, 12, 4) cd/m2, and beside the box is nothing.
TEST(Trace, RadianceAlongRays) {
    const auto rgb = numbers(expect_done({"trace", "builtin:cornell", "--indirect-samples", "4"},
                                         "2.78 2.7 2.8 0 1 0\n2.78 2.7 -8 0 0 -1\n")
                                 .out);
    ASSERT_EQ(rgb.size(), 6u);
    EXPECT_NEAR(rgb[0], 17, 1e-3);
    EXPECT_NEAR(rgb[1], 12, 1e-3);
    EXPECT_NEAR(rgb[2], 4, 1e-3);
    EXPECT_EQ(rgb[3] + rgb[4] + rgb[5], 0);
}

// The same seed gives the same bytes on any number of threads; another seed gives others.
TEST(Trace, TheSameBytesOnAnyNumberOfThreads) {
    std::string points;
    for (int i = 0; i < 1500; ++i) points += std::to_string(0.5 + 0.003 * i) + " 0.001 1 0 1 0\n";
    const auto out = [&](const char* threads, const char* seed) {
        return expect_done({"trace", "-I", "builtin:cornell", "--direct-samples", "16",
                            "--indirect-samples", "16", "--threads", threads, "--seed", seed},
                           points)
            .out;
    };
    const std::string one = out("1", "3");
    EXPECT_EQ(numbers(one).size(), 4500u);
    EXPECT_EQ(one, out("2", "3"));
    EXPECT_NE(one, out("2", "4"));
}

// A malformed line is named by its number, and what stood before it in the same batch is not half
// answered.
TEST(Trace, MalformedLinesAreNamed) {
    const char* const table[] = {"1 2 3 4 5",       "1 2 3 0 1 0 7", "1 2 x 0 1 0",  "1 2 3 0 0 0",
                                 "1 2 nan 0 1 0",   "1 2 inf 0 1 0", "1,2,3,0,1,0",  "hello",
                                 "1 2 3 0 1 1e999", "0x1 2 3 0 1 0", "1 2 3 0 1 0x", "+ 1 2 3 0 1"};
    for (const char* line : table) {
        const Outcome outcome =
            chiaro_with({"trace", "-I", "builtin:cornell"},
                        "1 1 1 0 1 0\n" + std::string(line) + "\n1 1 1 0 1 0\n");
        EXPECT_EQ(outcome.status, 2) << line;
        EXPECT_EQ(outcome.err.rfind("chiaro: stdin:2: ", 0), 0u) << line << ": " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << line;
        EXPECT_EQ(outcome.out, "") << line;
    }
}

// Radiance 6.1a, rtrace -I, converged: five points of the Cornell box's floor. Y of its r g b.
TEST(Trace, AgreesWithRadiance) {
    const std::string folder = CHIARO_REFERENCES;
    if (!std::filesystem::exists(folder + "/floor.pts")) GTEST_SKIP() << "no references here";
    const double rgb[5][3] = {{0.20387, 0.09896, 0.02872},
                              {0.83502, 0.49900, 0.15955},
                              {0.76103, 0.61675, 0.16395},
                              {0.53719, 0.35864, 0.09638},
                              {1.03982, 0.66359, 0.21275}};
    for (const std::string& scene : {std::string("builtin:cornell"), folder + "/cornell.obj"}) {
        const auto lux = numbers(expect_done({"trace", "-I", "--lux", scene, "--direct-samples",
                                              "16384", "--indirect-samples", "65536"},
                                             read_text(folder + "/floor.pts"))
                                     .out);
        ASSERT_EQ(lux.size(), 5u);
        for (int i = 0; i < 5; ++i) {
            const double y = 0.2126 * rgb[i][0] + 0.7152 * rgb[i][1] + 0.0722 * rgb[i][2];
            EXPECT_NEAR(lux[i] / y, 1, 0.015) << scene << " point " << i;
        }
    }
}

}  // namespace
}  // namespace chiaro
