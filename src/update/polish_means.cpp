#include "update/polish_means.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>

namespace chiaro {
void PolishMeans::restart(std::size_t pixels) {
    windows_.assign(pixels, {});
    pass_ = 1;
    next_ = 0;
}

void PolishMeans::add(const IdMap& map, std::span<const Rgb> light) {
    for (const Rgb& shown : light) {
        const ChancePixel& pixel = map.chance_pixels[next_];
        auto& [complete, filled] = windows_[next_++];
        if (std::has_single_bit(pass_)) {
            complete = filled;
            filled = {};
        }
        const auto rays = static_cast<float>(pixel.rays);
        filled.sum += shown * rays;
        filled.rays += rays;
    }
    if (next_ < windows_.size()) return;
    next_ = 0;
    ++pass_;
}

void PolishMeans::show(const ShadingCache& cache, const IdMap& map, int threads,
                       Image& picture) const {
    constexpr std::size_t kBlock = 1024;
    parallel_for(threads, (windows_.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
        const std::size_t last = std::min(windows_.size(), (block + 1) * kBlock);
        for (std::size_t i = block * kBlock; i < last; ++i) {
            const auto& [complete, filled] = windows_[i];
            if (filled.rays == 0) continue;
            const ChancePixel& pixel = map.chance_pixels[i];
            Rgb steady = pixel.steady_background;
            Rgb chance =
                glm::max(map.background.pixels[pixel.pixel] - pixel.steady_background, Rgb(0));
            for (const Fragment& f : map.at_pixel(pixel.pixel))
                (f.by_chance ? chance : steady) += shown_by(cache, f);
            const auto rays = static_cast<float>(pixel.rays);
            picture.pixels[pixel.pixel] = steady + (rays * chance + complete.sum + filled.sum) /
                                                       (rays + complete.rays + filled.rays);
        }
    });
}

}  // namespace chiaro
