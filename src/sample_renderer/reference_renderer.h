// The reference picture: path tracing a pixel at a time, which converges to the truth and to
// nothing else.
#pragma once

#include "base/image.h"
#include "sample_renderer/next_event.h"

namespace chiaro {

/// Accumulates samples a pixel of one still view, with a box filter as wide as the pixel.
///
/// Thread: one; spreads its own work. Passes of any sizes that add up to the same number of samples
/// give the same bits, on any number of threads. What the LitScene names must outlive it, unedited.
class ReferenceRenderer {
public:
    struct Settings {
        std::uint32_t seed = 0;
        int threads = 1;
    };
    ReferenceRenderer(const LitScene& lit, const View& view, const Settings& settings);

    /// Takes `samples` more paths in every pixel.
    void add_pass(std::uint32_t samples);

    std::uint32_t samples() const { return samples_; }
    /// Mean radiance so far [cd/m2 a channel]; black before the first pass.
    Image image() const;

private:
    void add_to_tile(std::size_t tile, std::uint32_t samples);

    LitScene lit_;
    View view_;
    Settings settings_;
    std::uint32_t samples_ = 0;
    std::vector<glm::dvec3> sums_;  // by pixel, rows from the top
};

}  // namespace chiaro
