#include "scene/perceived_gloss.h"

#include <cmath>

namespace chiaro {

PerceivedGloss perceived_gloss(const Bsdf& bsdf) {
    if (!has_specular(bsdf)) return {};
    const float half_diffuse = 0.5f * luminance(bsdf.diffuse);
    const float specular = bsdf.glass + (1 - bsdf.glass) * luminance(bsdf.f0);
    return {std::cbrt(specular + half_diffuse) - std::cbrt(half_diffuse), 1 - bsdf.alpha};
}

float PerceivedGloss::strength() const {
    constexpr float kDistinct = 1.78f;
    return contrast > 0 ? std::hypot(contrast, kDistinct * distinctness) : 0.0f;
}

}  // namespace chiaro
