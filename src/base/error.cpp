#include "base/error.h"

#include <cstdio>
#include <cstdlib>

namespace chiaro {

Error::Error(std::string where, std::string what, std::string remedy)
    : std::runtime_error(where + ": " + what + (remedy.empty() ? "" : "; " + remedy)),
      where_(std::move(where)),
      remedy_(std::move(remedy)) {}

void check_failed(const char* message) {
    std::fprintf(stderr, "chiaro: internal error: %s\n", message);
    std::abort();
}

}  // namespace chiaro
