// From a renderer's name to the renderer.
#pragma once

#include "rays/ray_caster.h"
#include "sample_renderer/sample_renderer.h"
#include "scene/area_lights.h"
#include "scene/open_sides.h"

#include <memory>

namespace chiaro {

enum class RendererName { path, gather, bidirectional, caustic };

/// Keeps references to all of them. `open_sides` may be null: nothing is buried then. `seed` is of
/// random numbers that belong to no request.
std::unique_ptr<SampleRenderer> make_renderer(RendererName name, const Scene& scene,
                                              const RayCaster& rays, const AreaLights& area_lights,
                                              const OpenSides* open_sides, int threads,
                                              std::uint32_t seed = 0);

}  // namespace chiaro
