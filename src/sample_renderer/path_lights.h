// The lights that a path asks at a bounce, whatever surface it is on.
#pragma once

#include "sample_renderer/mirror_light.h"
#include "sample_renderer/path_wave.h"

namespace chiaro {

/// Lamps in mirrors that are tried at a bounce.
inline constexpr std::size_t kImagesABounce = 64;

/// Asks one light of each kind: none takes samples from another, which may be hidden where it seems
/// brightest. Calls add(LightConnection). All kinds, and all but area lights.
template <typename Add>
void connect_other_lights(const LitScene& lit, const Receiver& receiver, const Path& path,
                          const Add& add) {
    if (!lit.punctual.lamps().empty())
        if (const auto found = connect_lamp(lit, receiver, path.light_choice)) add(*found);
    if (!lit.punctual.suns().empty())
        if (const auto found = connect_sun(lit, receiver, path.light_choice)) add(*found);
    if (!lit.environment.empty())
        if (const auto found = connect_environment(lit, receiver, path.sky_place)) add(*found);
    for_each_image(lit, receiver, path.light_choice, kImagesABounce, add);
}
template <typename Add>
void connect_lights(const LitScene& lit, const Receiver& receiver, const Path& path,
                    const Add& add) {
    if (!lit.area_lights.empty())
        if (const auto found =
                connect_area_light(lit, receiver, path.light_choice, path.light_place))
            add(*found);
    connect_other_lights(lit, receiver, path, add);
}

/// Weight of a light sample against a ray of density `pdf` in its direction.
inline float light_weight(const LightConnection& connection, float pdf) {
    const float of_light = connection.pdf_solid_angle;
    return of_light > 0 ? of_light / (of_light + pdf) : 1.0f;
}

/// Numbers of their own, so that those of all else stay what they are without an environment.
inline void draw_sky_numbers(const LitScene& lit, std::uint32_t bounce, Path& path) {
    constexpr std::uint32_t kSkySalt = 0x5c1e5a17;
    if (!lit.environment.empty())
        path.sky_place = BounceNumbers(path.key ^ kSkySalt, bounce).next_pair();
}

}  // namespace chiaro
