// Lamps and suns as flat mirrors show them: light that no path finds by chance, since both its ends
// are points.
#pragma once

#include "sample_renderer/next_event.h"

#include <algorithm>

namespace chiaro {

/// The light of punctual light `light` by way of a mirror; nothing where it has no image there.
std::optional<LightConnection> connect_image(const LitScene& lit, const Receiver& receiver,
                                             const FlatMirror& mirror, std::uint32_t light);

/// Pairs of a mirror and a light.
inline std::size_t image_count(const LitScene& lit) {
    return lit.mirrors.size() * lit.scene.lights.size();
}

/// Calls add(LightConnection) for the images of lights in mirrors, at most about `most` of the
/// pairs, which `choice`, uniform in [0, 1), chooses and which stand for all.
template <typename Add>
void for_each_image(const LitScene& lit, const Receiver& receiver, float choice, std::size_t most,
                    const Add& add) {
    const std::size_t pairs = image_count(lit);
    if (pairs == 0) return;
    const std::size_t lights = lit.scene.lights.size();
    const std::size_t tried = std::min(most, pairs);
    const auto first = static_cast<std::size_t>(choice * static_cast<float>(pairs));
    for (std::size_t i = 0; i < tried; ++i) {
        const std::size_t pair = (first + i) % pairs;
        auto found = connect_image(lit, receiver, lit.mirrors[pair / lights],
                                   static_cast<std::uint32_t>(pair % lights));
        if (!found) continue;
        found->irradiance *= static_cast<float>(pairs) / static_cast<float>(tried);
        add(*found);
    }
}

}  // namespace chiaro
