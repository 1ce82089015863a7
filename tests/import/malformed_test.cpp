// The importer and the table of the malformed collection.

#include "import/malformed_table.h"

#include "import/import_testing.h"

#include <set>
#include <string>

namespace chiaro {
namespace {

using namespace malformed;

TEST(Malformed, EachFileIsAcceptedOrRefusedAsTheTableSays) {
    if (!std::filesystem::exists(kFolder))
        GTEST_SKIP() << "the malformed collection is not in " << kFolder;
    for (const Expectation& expected : kExpected) {
        const auto file = kFolder / expected.file;
        ASSERT_TRUE(std::filesystem::exists(file)) << expected.file;
        const std::string fault = fault_of([&] { load_scene(file); });
        EXPECT_EQ(fault.empty() ? accepted : refused, expected.verdict)
            << expected.file << " " << fault;
        EXPECT_TRUE(fault.empty() || fault.starts_with(file.string())) << fault;
    }
}

TEST(Malformed, TheTableNamesEverySceneFileOfTheCollection) {
    if (!std::filesystem::exists(kFolder))
        GTEST_SKIP() << "the malformed collection is not in " << kFolder;
    std::set<std::string> named;
    for (const Expectation& expected : kExpected) named.insert(expected.file);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kFolder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".obj" && extension != ".gltf" && extension != ".glb") continue;
        const std::string name = entry.path().lexically_relative(kFolder).string();
        EXPECT_TRUE(named.contains(name)) << name;
    }
}

// The table's only departures from the validator are the judgements that are explained in it.
TEST(Malformed, TheTableAgreesWithTheValidator) {
    if (!std::filesystem::exists(kFolder))
        GTEST_SKIP() << "the malformed collection is not in " << kFolder;
    for (const Expectation& expected : kExpected) {
        const auto report = kFolder / (std::string(expected.file) + ".report.json");
        if (!std::filesystem::exists(report)) continue;
        const auto issues = nlohmann::json::parse(read_text(report))["issues"];
        const bool valid = issues["numErrors"].get<int>() == 0;
        const bool judged = std::string_view(expected.file).find("non_unit") != std::string::npos;
        EXPECT_EQ(valid != judged, expected.verdict == accepted) << expected.file;
    }
}

}  // namespace
}  // namespace chiaro
