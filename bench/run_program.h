// What main() of every measuring program does.
#pragma once

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace chiaro {

/// Calls `run` with main()'s arguments and returns its exit status. What it throws is printed to
/// standard error in one line that begins with the program's name, and the status is 2.
inline int run_program(int argc, char** argv, int (*run)(int, char**)) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        const std::string name = std::filesystem::path(argv[0]).filename().string();
        std::fprintf(stderr, "%s: %s\n", name.c_str(), e.what());
        return 2;
    }
}

}  // namespace chiaro
