// A scene file in memory, as the readers get it.
#pragma once

#include <filesystem>
#include <string>

namespace chiaro {

struct SceneFile {
    std::string where;             // how messages name the file
    std::filesystem::path folder;  // what the files that it names are relative to
    const std::string& bytes;      // not empty
};

}  // namespace chiaro
