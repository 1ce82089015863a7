// What polish shows by chance, as means over passes that go on while the view rests.
#pragma once

#include "image_generator/ray_view.h"

#include <vector>

namespace chiaro {

/// Processor time of one pixel of a pass, to begin with, and for good in cycles of fixed size
/// [seconds].
inline constexpr double kSecondsAPolishedPixel = 40e-6;

/// A mean for each of IdMap::chance_pixels, by entry.
///
/// Passes look up a cache that is still refined, so that old ones are forgotten: the mean is over
/// the latest complete window of passes and the one that is filled, and a window begins whenever
/// the number of passes has doubled. Between half and three quarters of all passes count, and as
/// much as one of them the first look, whose fragments show the cache as it is.
///
/// 24 bytes an entry, whatever the number of passes.
class PolishMeans {
public:
    /// Nothing but the first look, at so many pixels.
    void restart(std::size_t pixels);

    std::size_t size() const { return windows_.size(); }
    /// The pass that is under way, from 1, and its first pixel that was not looked at yet.
    std::uint32_t pass() const { return pass_; }
    std::size_t next() const { return next_; }

    /// Adds what the pass shows by chance in the next light.size() pixels [cd/m2 a channel]. Goes
    /// on to the next pass behind the last.
    void add(std::span<const Rgb> light);

    /// Puts the means into a picture of the map, in pixels that a pass has looked at.
    void show(const ShadingCache& cache, const IdMap& map, int threads, const FadeIn* fade,
              Image& picture) const;

    std::size_t bytes() const { return windows_.capacity() * sizeof(Windows); }

private:
    struct Windows {
        Rgb complete = Rgb(0), filled = Rgb(0);  // sums of radiance over passes
    };
    std::vector<Windows> windows_;
    std::uint32_t pass_ = 1;
    std::size_t next_ = 0;
};

}  // namespace chiaro
