// The commands. Each does its work and returns the exit status; what is wrong with the outside
// world leaves it as an Error.
#pragma once

#include "apps/options.h"

namespace chiaro {

int render_command(const Options& options);
int play_command(const Options& options);
int reference_command(const Options& options);
int trace_command(const Options& options);
int diff_command(const Options& options);
int info_command(const Options& options);

/// True once the user has pressed Ctrl-C (or SIGTERM came): work ends soon, and what there is is
/// written. catch_interrupts() must have been called; a second Ctrl-C ends the program at once.
bool interrupted();
void catch_interrupts();

}  // namespace chiaro
