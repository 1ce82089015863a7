// chiaro trace: light at points, a line in and a line out, as Radiance's rtrace.
#include "apps/command.h"

#include <poll.h>

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
    const char* const table[] = {"1 2 3 4 5",        "1 2 3 0 1 0 7",   "1 2 x 0 1 0",
                                 "1 2 3 0 0 0",      "1 2 nan 0 1 0",   "1 2 inf 0 1 0",
                                 "1,2,3,0,1,0",      "hello",           "1 2 3 0 1 1e999",
                                 "0x1 2 3 0 1 0",    "1 2 3 0 1 0x",    "+ 1 2 3 0 1 0",
                                 "+-1 2 3 0 1 0",    "1 2 3 0 1 0 +",   "1e18 0 0 0 1 0",
                                 "0 -1.1e9 0 0 1 0", "0 0 1e300 0 1 0", "1 2 3 0 1e-400 0"};
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

// A direction's length means nothing, be its square beyond what floats or doubles hold.
TEST(Trace, DirectionsMayHaveAnyLength) {
    const TempFolder folder;
    const std::string scene = folder.write("lamp.gltf", kLamp).string();
    const std::string points =
        "0 0 0 0 1e20 0\n0 0 0 0 1e-30 0\n0 0 0 0 1e300 0\n0 0 0 0 1e-300 0\n"
        "+0 0 0 3e-200 4e-200 +0\n1e9 1e9 -1e9 0 1 0\n";
    const auto lux = numbers(expect_done({"trace", "-I", "--lux", scene}, points).out);
    ASSERT_EQ(lux.size(), 6u);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(lux[i], 25, 1e-3) << i;
    EXPECT_NEAR(lux[4], 20, 1e-3);
    EXPECT_EQ(lux[5], 0);  // above the lamp, and looking up
    for (const char* length : {"1e20", "1e-30"}) {
        const std::string ray = "2.78 2.7 2.8 0 " + std::string(length) + " 0\n";
        EXPECT_NEAR(numbers(expect_done({"trace", "builtin:cornell"}, ray).out).at(0), 17, 1e-3);
    }
}

// Both halves of a seed count, and one that is too large is refused, not cut.
TEST(Trace, ASeedHas64Bits) {
    const auto out = [](const char* seed) {
        return expect_done(
                   {"trace", "-I", "builtin:cornell", "--indirect-samples", "16", "--seed", seed},
                   "1 0.001 1 0 1 0\n")
            .out;
    };
    EXPECT_NE(out("1"), out("4294967297"));  // 2^32 + 1
    EXPECT_NE(out("4294967297"), out("8589934593"));
    EXPECT_EQ(out("18446744073709551615"), out("18446744073709551615"));
    for (const char* seed : {"18446744073709551616", "-1", "1.5", "0x10", ""})
        expect_refused({"trace", "-I", "builtin:cornell", "--seed", seed}, "--seed");
}

// A `chiaro trace` at the other end of two pipes.
class Conversation {
public:
    explicit Conversation(const Arguments& arguments) {
        int to[2], from[2];
        if (::pipe(to) != 0 || ::pipe(from) != 0) throw std::runtime_error("no pipes");
        std::vector<char*> argv = {const_cast<char*>(CHIARO_BINARY)};
        for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
        argv.push_back(nullptr);
        pid_ = ::fork();
        if (pid_ == 0) {
            ::dup2(to[0], STDIN_FILENO);
            ::dup2(from[1], STDOUT_FILENO);
            for (const int end : {to[0], to[1], from[0], from[1]}) ::close(end);
            ::execv(argv[0], argv.data());
            ::_exit(127);
        }
        ::close(to[0]);
        ::close(from[1]);
        to_ = to[1];
        from_ = from[0];
    }
    ~Conversation() {
        ::close(to_);
        ::close(from_);
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }

    // Says `line` and waits for an answer; empty if none comes for 20 s.
    std::string answer(const std::string& line) {
        if (::write(to_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) return "";
        std::string text;
        pollfd answer = {from_, POLLIN, 0};
        while (!text.ends_with('\n') && ::poll(&answer, 1, 20'000) == 1) {
            char c = 0;
            if (::read(from_, &c, 1) != 1) break;
            text += c;
        }
        return text;
    }

private:
    pid_t pid_ = -1;
    int to_ = -1, from_ = -1;
};

// Who waits for an answer before the next question gets it, and it is the one that a file would
// get.
TEST(Trace, AnswersComeWhenNoMoreIsAsked) {
    const std::vector<std::string> lines = {"1 0.001 1 0 1 0\n", "\n2 0.001 1 0 1 0\n",
                                            "3 0.001 1 0 1 0\n"};
    for (const Arguments& arguments : std::initializer_list<Arguments>{
             {"trace", "-I", "builtin:cornell"},
             {"trace", "builtin:cornell", "--indirect-samples", "4"}}) {
        std::string together;
        Conversation conversation(arguments);
        for (const std::string& line : lines) together += conversation.answer(line);
        EXPECT_EQ(together, expect_done(arguments, lines[0] + lines[1] + lines[2]).out);
    }
}

// Radiance 6.1a, rtrace -I, converged: five points of the Cornell box's floor. Y of its r g b.
TEST(Trace, AgreesWithRadiance) {
    const std::string folder = CHIARO_REFERENCES;
    if (!std::filesystem::exists(folder + "/floor.pts"))
        GTEST_SKIP() << "no floor.pts in " << folder;
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
