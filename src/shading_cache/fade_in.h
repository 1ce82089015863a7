// New values come in over a few frames, so that nothing pops.
#pragma once

#include "shading_cache/shading_cache.h"

namespace chiaro {

/// What a display shows of each vertex: it follows what the cache shows, a part of the way in each
/// frame. It belongs to surfaces, as the cache does, so that nothing is smeared when the camera or
/// an object moves.
///
/// Thread: one, while nobody changes the cache. Memory: 12 bytes a vertex and kind of light.
class FadeIn {
public:
    /// After so many frames nine tenths of a change are shown; > 0.
    explicit FadeIn(int frames);

    /// One frame further. A new vertex begins with what its parents show, which is what was seen
    /// there before it was made; those without any, and all once the cache was packed, with what
    /// the cache shows.
    void advance(const ShadingCache& cache, int threads);

    /// As the cache's: all channels of that kind of light together. Checks: the vertex was there at
    /// the last advance().
    Shown shown_total(VertexId vertex, Shading shading) const;

private:
    std::vector<Rgb>& shown(Shading shading) {
        return shading == Shading::glossy ? glossy_ : irradiance_;
    }
    void advance(const ShadingCache& cache, Shading shading, int threads);

    float part_;                            // of what is left of a change that a frame shows
    std::size_t packs_ = 0;                 // of the cache, when it was looked at last
    std::vector<Rgb> irradiance_, glossy_;  // by vertex, of those that were there then
};

}  // namespace chiaro
