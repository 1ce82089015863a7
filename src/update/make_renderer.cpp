#include "update/make_renderer.h"

#include "sample_renderer/bidirectional_renderer.h"
#include "sample_renderer/caustic_renderer.h"
#include "sample_renderer/gather_renderer.h"
#include "sample_renderer/path_renderer.h"

namespace chiaro {

std::unique_ptr<SampleRenderer> make_renderer(RendererName name, const Scene& scene,
                                              const RayCaster& rays, const AreaLights& area_lights,
                                              const OpenSides* open_sides, int threads,
                                              std::uint32_t seed) {
    switch (name) {
        case RendererName::path:
            break;
        case RendererName::gather:
            return std::make_unique<GatherRenderer>(scene, rays, area_lights, open_sides, threads,
                                                    seed);
        case RendererName::bidirectional:
            return std::make_unique<BidirectionalRenderer>(scene, rays, area_lights, open_sides,
                                                           threads);
        case RendererName::caustic:
            return std::make_unique<CausticRenderer>(scene, rays, area_lights, open_sides, threads);
    }
    return std::make_unique<PathRenderer>(scene, rays, area_lights, open_sides, threads);
}

}  // namespace chiaro
