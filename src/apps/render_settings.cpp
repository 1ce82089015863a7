#include "apps/render_settings.h"

#include "apps/output.h"

namespace chiaro {

SessionSettings session_settings(const Options& options) {
    UpdateSettings s;
    s.scheme = parse_scheme(options.scheme);
    s.threads = thread_count(options);
    s.seed = options.seed;
    s.aov = parse_aov(options.aov);
    s.direct_samples = sample_count("--direct-samples", options.direct_samples, 100);
    s.indirect_samples = sample_count("--indirect-samples", options.indirect_samples, 400);
    if (s.scheme == Scheme::best && (options.direct_samples || options.indirect_samples))
        warn("--direct-samples and --indirect-samples mean nothing without --scheme paper");
    const RendererName otherwise =
        s.scheme == Scheme::paper ? RendererName::path : RendererName::gather;
    const PictureSize size = parse_size(options.size);
    return {s, parse_renderer(options.renderer, otherwise), curve_tolerance(options), size.width,
            size.height};
}

}  // namespace chiaro
