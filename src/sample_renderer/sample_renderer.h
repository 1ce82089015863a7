// BOX Sample Renderer (3.2): "any suitable global illumination algorithm" behind one call.
#pragma once

#include "scene/surface.h"

#include <cstdint>
#include <optional>
#include <span>

namespace chiaro {

/// What part of the light a channel holds: irradiance [lux a colour channel], or radiance toward an
/// eye [cd/m2 a colour channel] by all that a surface does but diffuse reflection.
enum class Light : std::uint8_t {
    direct,    // straight from lights
    indirect,  // after at least one reflection
    total,     // both: the single channel of the paper's scheme
    glossy,    // radiance, of all light
    glint,     // radiance, of light straight from lights
};

/// A place in space that light is measured at, as by a lux meter: it need not lie on a surface.
struct MeterPlace {
    Vec3 position;
    Vec3 normal;  // unit
};

/// Asks for more samples of one channel at one surface point.
///
/// Samples are numbered; a request covers [first_sample, first_sample + samples) of the point's own
/// sequence, which `seed` names, so that asking in two parts or on two machines gives the same
/// values.
struct ShadeRequest {
    SurfacePoint where = {};  // a little inside its patch; the renderer lifts it off the surface
    bool front = true;        // which side of the surface
    std::optional<MeterPlace> place = std::nullopt;  // instead of these
    Light light = Light::direct;
    Vec3 eye = Vec3(0);      // `glossy` and `glint`: where the surface is seen from, world space
    std::uint32_t seed = 0;  // of the vertex and channel; equal seeds mean equal random numbers
    std::uint32_t first_sample = 0;
    std::uint32_t samples = 0;  // > 0, a multiple of kReplicates
    std::uint32_t indirect_samples =
        0;  // `total` only: `samples` go to direct light, these to indirect
};

/// Independently rotated copies of the sequence; sample i belongs to replicate i % kReplicates. The
/// variance comes from how the replicates differ.
inline constexpr std::uint32_t kReplicates = 4;

/// Mean over the requested samples.
struct ShadeResult {
    Rgb mean = Rgb(0);      // irradiance or radiance
    Rgb variance = Rgb(0);  // of `mean`, estimated from the replicates: 0 where
                            // they agree, as when all of them missed what is rare
    bool buried = false;    // most rays met the inside of something: the point lies in a solid
};

/// Variance of the luminance of a mean whose channels have `variance`, taken as fully correlated:
/// the channels of one path rise and fall together.
inline float luminance_variance(Rgb variance) {
    const float deviation = luminance(glm::sqrt(glm::max(variance, Rgb(0))));
    return deviation * deviation;
}

/// Processor time that samples take in a furnished room, to begin with [seconds].
struct SampleCosts {
    float direct;
    float indirect;
    float glossy = 1e-6f;
};

/// The one seam. To be called from the update thread only; it spreads its own work.
class SampleRenderer {
public:
    SampleRenderer() = default;
    SampleRenderer(const SampleRenderer&) = delete;
    SampleRenderer& operator=(const SampleRenderer&) = delete;
    virtual ~SampleRenderer() = default;
    /// One result a request; both spans of one length. The same requests give the same bits on any
    /// number of threads and, unless it remembers(), in any batch.
    virtual void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) = 0;
    virtual SampleCosts typical_costs() const = 0;
    /// True if a result depends on what was asked for in calls before.
    virtual bool remembers() const { return false; }
};

}  // namespace chiaro
