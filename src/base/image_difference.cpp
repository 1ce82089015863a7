#include "base/image_difference.h"

#include "base/tone_map.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

void check_comparable(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error("diff",
                    "the pictures are " + std::to_string(a.width) + "x" + std::to_string(a.height) +
                        " and " + std::to_string(b.width) + "x" + std::to_string(b.height),
                    "compare pictures of one size");
    for (const Image* image : {&a, &b})
        for (const Rgb& pixel : image->pixels)
            if (!is_finite(pixel)) throw Error("diff", "a pixel is not a finite number");
}

double shown(double x) {
    return std::pow(1 - std::exp(-std::max(x, 0.0)), 1 / 2.2);
}

}  // namespace

ImageDifference difference(const Image& a, const Image& b) {
    return difference(a, b, b);
}

ImageDifference difference(const Image& a, const Image& half_1, const Image& half_2) {
    check_comparable(a, half_1);
    check_comparable(a, half_2);
    Image mean = half_1;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = 0.5f * (half_1.pixels[i] + half_2.pixels[i]);

    ImageDifference result;
    result.k = comparison_exposure(mean);
    double square = 0, relative = 0, tone = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double x = result.k * a.pixels[i][c];
            const double r1 = result.k * half_1.pixels[i][c];
            const double r2 = result.k * half_2.pixels[i][c];
            const double r = 0.5 * (r1 + r2);
            square += (x - r1) * (x - r2);
            relative += (x - r1) * (x - r2) / (r * r + 0.01);
            tone += (shown(x) - shown(r1)) * (shown(x) - shown(r2));
        }
    const double count = 3.0 * static_cast<double>(std::max<std::size_t>(a.pixels.size(), 1));
    result.rmse = std::sqrt(std::max(square / count, 0.0));
    result.relmse = std::max(relative / count, 0.0);
    result.psnr = -10 * std::log10(std::max(tone / count, 0.0));
    return result;
}

}  // namespace chiaro
