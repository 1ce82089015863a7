#include "sample_renderer/reference_renderer.h"

#include "base/parallel.h"
#include "sample_renderer/path_wave.h"

#include <algorithm>
#include <array>

namespace chiaro {
namespace {

constexpr int kTile = 16;       // pixels across: a wave
constexpr int kPacketSide = 4;  // pixels across that share a packet of camera rays

// All samples belong to the first replicate: they are spread best together, and nobody asks for
// their variance.
void add_camera_path(const View& view, int x, int y, const Sequence& sequence, std::uint32_t sample,
                     std::uint32_t slot, PathWave& wave) {
    const std::uint32_t number = kReplicates * sample;
    const Vec2 in_pixel = sequence.pair(number, kFirstDirection);
    wave.add(view.ray(static_cast<float>(x) + in_pixel.x, static_cast<float>(y) + in_pixel.y),
             make_path(sequence, number, slot));
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
            const Sequence sequence(hash32(settings_.seed, static_cast<std::uint32_t>(pixel)));
            pixels[count] = pixel;
            add_camera_path(view_, x, y, sequence, s, count++, wave);
        }

        wave.hits.resize(wave.rays.size());
        lit_.caster.intersect_coherent(wave.rays, wave.hits, RayKind::camera);
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
