#include "base/tone_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chiaro {
namespace {

constexpr float kContrast = 32;  // k of the s-shaped operator

// Narkowicz's fit of a filmic curve (2015), of a luminance; 0.4 comes out near a mid grey.
float filmic(float x) {
    return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

}  // namespace

float tumblin_s_curve(float x) {
    const float floor = 1.0f / (kContrast * kContrast);
    const float s = (x + 1.0f / kContrast) / (x + kContrast);
    return (s - floor) / (1.0f - floor);
}

float paper_tone_value(Rgb color, float exposure) {
    return 5.0f / 16 * tumblin_s_curve(color.r * exposure) +
           9.0f / 16 * tumblin_s_curve(color.g * exposure) +
           2.0f / 16 * tumblin_s_curve(color.b * exposure);
}

float comparison_curve(float x) {
    return std::pow(1.0f - std::exp(-x), 1.0f / 2.2f);
}

float comparison_slope(float x) {
    // Steeper than this only below 1/200 of the median, where nobody looks.
    x = std::max(x, 0.002f);
    const float e = std::exp(-x);
    return std::pow(1.0f - e, 1.0f / 2.2f - 1.0f) * e / 2.2f;
}

float comparison_exposure(const Image& image) {
    std::vector<float> values;
    values.reserve(image.pixels.size());
    for (const Rgb& pixel : image.pixels)
        if (const float y = luminance(pixel); y > 0) values.push_back(y);
    if (values.empty()) return 1;
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return 0.4f / *middle;
}

Image tone_mapped(const Image& linear, float exposure) {
    // White long before; beyond it the curve's squares would overflow, and black times infinity is
    // no number.
    constexpr float kWhite = 1e9f;
    exposure = std::min(exposure, std::numeric_limits<float>::max());
    Image result = linear;
    for (Rgb& pixel : result.pixels) {
        // Compressing the largest channel and scaling the others with it keeps the hue; what is far
        // over white goes to white, as a film's layers saturate.
        const Rgb exposed = glm::clamp(pixel * exposure, 0.0f, kWhite);
        const float peak = max_component(exposed);
        if (!(peak > 0)) {
            pixel = Rgb(0);
            continue;
        }
        const float shown = std::min(filmic(0.6f * peak), 1.0f);
        const float to_white = std::clamp((peak - 4.0f) / 16.0f, 0.0f, 1.0f);
        const Rgb color = glm::mix(exposed / peak, Rgb(1), to_white) * shown;
        for (int c = 0; c < 3; ++c) pixel[c] = linear_to_srgb(std::clamp(color[c], 0.0f, 1.0f));
    }
    return result;
}

float automatic_exposure(const Image& linear) {
    std::vector<float> values;
    for (const Rgb& pixel : linear.pixels)
        if (const float y = luminance(pixel); y > 0) values.push_back(y);
    if (values.empty()) return 1;
    const auto bright = values.begin() + values.size() * 9 / 10;
    std::nth_element(values.begin(), bright, values.end());
    constexpr float kOverWhite = 6;
    return std::min(comparison_exposure(linear), kOverWhite / *bright);
}

}  // namespace chiaro
