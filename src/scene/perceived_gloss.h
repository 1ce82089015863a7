// How glossy a surface looks, on a scale that is uniform to the eye.
#pragma once

#include "scene/bsdf.h"

namespace chiaro {

/// Pellacini, Ferwerda, Greenberg ("Toward a psychophysically-based light reflection model", 2000):
/// of the contrast of what is reflected, c = cbrt(rho_s + rho_d / 2) - cbrt(rho_d / 2), and how
/// distinct it is, d = 1 - alpha.
struct PerceivedGloss {
    float contrast = 0;
    float distinctness = 0;

    /// Distance from a matte surface in their space of c and 1.78 d; 0 without contrast, below 2.1.
    float strength() const;
};
PerceivedGloss perceived_gloss(const Bsdf& bsdf);

}  // namespace chiaro
