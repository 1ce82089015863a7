#include "update/polish_means.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>

namespace chiaro {
namespace {

// Passes that count after so many: a window begins with pass 1, 2, 4, 8 ...
std::uint32_t passes_in_windows(std::uint32_t passes) {
    const std::uint32_t first_of_filled = std::bit_floor(passes);
    return passes - first_of_filled + 1 + first_of_filled / 2;
}

}  // namespace

void PolishMeans::restart(std::size_t pixels) {
    windows_.assign(pixels, {});
    pass_ = 1;
    next_ = 0;
}

void PolishMeans::add(std::span<const Rgb> light) {
    for (const Rgb& shown : light) {
        auto& [complete, filled] = windows_[next_++];
        if (std::has_single_bit(pass_)) {
            complete = filled;
            filled = Rgb(0);
        }
        filled += shown;
    }
    if (next_ < windows_.size()) return;
    next_ = 0;
    ++pass_;
}

void PolishMeans::show(const ShadingCache& cache, const IdMap& map, int threads, const FadeIn* fade,
                       Image& picture) const {
    constexpr std::size_t kBlock = 1024;
    parallel_for(threads, (windows_.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
        const std::size_t last = std::min(windows_.size(), (block + 1) * kBlock);
        for (std::size_t i = block * kBlock; i < last; ++i) {
            const std::uint32_t passes = i < next_ ? pass_ : pass_ - 1;
            if (passes == 0) continue;
            const auto& [complete, filled] = windows_[i];
            const ChancePixel& pixel = map.chance_pixels[i];
            Rgb steady = pixel.steady_background;
            Rgb chance =
                glm::max(map.background.pixels[pixel.pixel] - pixel.steady_background, Rgb(0));
            for (const Fragment& f : map.at_pixel(pixel.pixel))
                (f.by_chance ? chance : steady) += shown_by(cache, f, fade);
            const auto looks = static_cast<float>(1 + passes_in_windows(passes));
            picture.pixels[pixel.pixel] = steady + (chance + complete + filled) / looks;
        }
    });
}

}  // namespace chiaro
