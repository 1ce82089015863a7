// From options to the settings of a session.
#pragma once

#include "apps/options.h"
#include "update/session.h"

namespace chiaro {

/// Of `render` and `play`. Warns of options that mean nothing with the others. Throws Errors.
SessionSettings session_settings(const Options& options);

}  // namespace chiaro
