#include "apps/commands.h"

#include <atomic>
#include <csignal>

namespace chiaro {
namespace {

std::atomic<bool> g_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int signal) {
    g_interrupted = true;
    std::signal(signal, SIG_DFL);
}

}  // namespace

bool interrupted() {
    return g_interrupted;
}

void catch_interrupts() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

}  // namespace chiaro
