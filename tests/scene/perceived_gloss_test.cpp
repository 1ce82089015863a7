// The scale of gloss of Pellacini, Ferwerda and Greenberg (2000), against its formulas.
#include "scene/perceived_gloss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

Bsdf varnish(float diffuse, float f0, float alpha) {
    Bsdf b;
    b.diffuse = Rgb(diffuse);
    b.f0 = Rgb(f0);
    b.f90 = Rgb(1);
    b.alpha = alpha;
    return b;
}

// c = cbrt(rho_s + rho_d / 2) - cbrt(rho_d / 2), d = 1 - alpha: of 0.099 over a grey of 0.19, the
// paper's range of reflectances, and facets of 0.19.
TEST(PerceivedGloss, IsContrastAndDistinctness) {
    const PerceivedGloss gloss = perceived_gloss(varnish(0.19f, 0.099f, 0.19f));
    EXPECT_NEAR(gloss.contrast, std::cbrt(0.194) - std::cbrt(0.095), 1e-5);
    EXPECT_NEAR(gloss.distinctness, 0.81, 1e-5);
    EXPECT_NEAR(gloss.strength(), std::hypot(gloss.contrast, 1.78 * 0.81), 1e-5);
}

// A Lambertian has none; the same varnish looks glossier over black than over white, and polished
// than rough; a mirror is the most: hypot(1, 1.78).
TEST(PerceivedGloss, GrowsWithContrastAndPolish) {
    Bsdf matte;
    matte.diffuse = Rgb(0.5f);
    EXPECT_EQ(perceived_gloss(matte).strength(), 0);
    const auto strength = [](float diffuse, float alpha) {
        return perceived_gloss(varnish(diffuse, 0.04f, alpha)).strength();
    };
    EXPECT_GT(strength(0, 0.2f), strength(0.8f, 0.2f));
    EXPECT_GT(strength(0.5f, 0.1f), strength(0.5f, 0.4f));
    EXPECT_NEAR(perceived_gloss(varnish(0, 1, 0)).strength(), std::hypot(1, 1.78), 1e-5);
}

}  // namespace
}  // namespace chiaro
