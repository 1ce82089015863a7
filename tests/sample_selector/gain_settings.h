// What gains are reckoned with in tests.
#pragma once

#include "sample_selector/gain.h"

namespace chiaro::tiny {

/// A microsecond a sample and 32 first samples, in every channel.
inline GainSettings settings() {
    GainSettings s;
    s.seconds_a_sample.fill(1e-6f);
    s.first_samples.fill(32);
    return s;
}

}  // namespace chiaro::tiny
