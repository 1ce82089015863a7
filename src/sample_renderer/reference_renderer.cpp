#include "sample_renderer/reference_renderer.h"

#include "base/halton.h"
#include "base/parallel.h"
#include "sample_renderer/path_wave.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/sequence.h"

#include <algorithm>
#include <array>

namespace chiaro {
namespace {

constexpr int kTile = 16;       // pixels across: a wave
constexpr int kPacketSide = 4;  // pixels across that share a packet of camera rays

// Numbers of a pixel's sample: two for the place in the pixel, three for the first light asked.
enum PixelDimension : int { kJitter = 0, kLightPlaceInView = 2, kLightChoiceInView = 4 };

float pixel_number(std::uint32_t pixel_seed, std::uint32_t sample, int dimension) {
    return rotate_unit(halton(dimension, sample),
                       to_unit_float(hash32(pixel_seed, 0x71aeU + dimension)));
}

void add_camera_path(const View& view, int x, int y, std::uint32_t pixel_seed, std::uint32_t sample,
                     std::uint32_t slot, PathWave& wave) {
    const auto number = [&](int d) { return pixel_number(pixel_seed, sample, d); };
    const float px = static_cast<float>(x) + number(kJitter);
    const float py = static_cast<float>(y) + number(kJitter + 1);
    wave.add(view.ray(px, py),
             {.slot = slot,
              .key = sample_key(pixel_seed, sample),
              .light_place = {number(kLightPlaceInView), number(kLightPlaceInView + 1)},
              .light_choice = number(kLightChoiceInView)});
}

int tiles_across(int pixels) {
    return (pixels + kTile - 1) / kTile;
}

}  // namespace

ReferenceRenderer::ReferenceRenderer(const LitScene& lit, const View& view,
                                     const Settings& settings)
    : lit_(lit),
      view_(view),
      settings_(settings),
      sums_(static_cast<std::size_t>(view.width()) * view.height(), glm::dvec3(0)) {}

void ReferenceRenderer::add_pass(std::uint32_t samples) {
    const std::size_t tiles =
        static_cast<std::size_t>(tiles_across(view_.width())) * tiles_across(view_.height());
    parallel_for(settings_.threads, tiles, [&](std::size_t tile) { add_to_tile(tile, samples); });
    samples_ += samples;
}

void ReferenceRenderer::add_to_tile(std::size_t tile, std::uint32_t samples) {
    thread_local PathWave wave;
    const int across = tiles_across(view_.width());
    const int left = static_cast<int>(tile % across) * kTile;
    const int top = static_cast<int>(tile / across) * kTile;
    for (std::uint32_t s = samples_; s < samples_ + samples; ++s) {
        // Camera rays in the order of packets, blocks of 4 x 4 pixels.
        std::array<Rgb, kTile* kTile> radiance = {};
        std::array<std::size_t, kTile * kTile> pixels;
        std::uint32_t count = 0;
        wave.clear();
        for (int i = 0; i < kTile * kTile; ++i) {
            const int block = i / (kPacketSide * kPacketSide);
            const int inside = i % (kPacketSide * kPacketSide);
            const int x = left + block % kPacketSide * kPacketSide + inside % kPacketSide;
            const int y = top + block / kPacketSide * kPacketSide + inside / kPacketSide;
            if (x >= view_.width() || y >= view_.height()) continue;
            const std::size_t pixel = static_cast<std::size_t>(y) * view_.width() + x;
            const auto seed = hash32(settings_.seed, static_cast<std::uint32_t>(pixel));
            pixels[count] = pixel;
            add_camera_path(view_, x, y, seed, s, count++, wave);
        }

        wave.hits.resize(wave.rays.size());
        lit_.caster.intersect_coherent(wave.rays, wave.hits);
        pass_single_sided_backs(lit_.scene, lit_.caster, wave.rays, wave.hits);
        follow(lit_, wave, FirstEmission::counted, radiance);
        for (std::uint32_t i = 0; i < count; ++i) sums_[pixels[i]] += glm::dvec3(radiance[i]);
    }
}

Image ReferenceRenderer::image() const {
    Image image(view_.width(), view_.height());
    if (samples_ == 0) return image;
    for (std::size_t i = 0; i < sums_.size(); ++i)
        image.pixels[i] = Rgb(sums_[i] / static_cast<double>(samples_));
    return image;
}

}  // namespace chiaro
