#include "image_generator/ray_view.h"

#include "base/parallel.h"
#include "image_generator/view_on_roots.h"

#include <algorithm>

namespace chiaro {
namespace {

// What a pixel covers of the surface that its centre's ray met. In mirrors only neighbours on the
// same primitive tell.
std::optional<PixelFootprint> footprint_of(const Viewing& viewing,
                                           std::span<const CentreRow> centres, int y,
                                           const CentreHit& hit) {
    if (hit.trail == 0)
        return footprint_on_plane(viewing.rays.scene(), viewing.view, static_cast<int>(hit.x), y,
                                  hit.point);
    const Neighbours near = on_same_primitive(centres, hit, y);
    if (!near.beside || !near.below) return std::nullopt;
    const auto change_to = [&](const SurfacePoint& p) {
        return Vec2(p.u - hit.point.u, p.v - hit.point.v);
    };
    return PixelFootprint{change_to(near.beside->point), change_to(near.below->point)};
}

// Textures averaged over a pixel that shows no outline: over what the pixel's centre ray met by
// each trail.
void average_texture(const Viewing& viewing, std::span<const CentreRow> centres, int y,
                     SeenPiece& piece) {
    const CentreHit* centre = find_trail(centres[y].at(static_cast<int>(piece.x)), piece.trail);
    if (!centre || !centre->textured) return;
    const auto footprint = footprint_of(viewing, centres, y, *centre);
    const Rgb albedo = mean_diffuse_albedo(viewing.rays.scene(), piece, *footprint);
    piece.reflectance = piece.weight * albedo * (1 / kPi);
}

// Whether a texture shows in the pixel of which it is not known what it covers.
bool cornered(const Viewing& viewing, std::span<const CentreRow> centres, int x, int y) {
    for (const CentreHit& hit : centres[y].at(x))
        if (hit.textured && !footprint_of(viewing, centres, y, hit)) return true;
    return false;
}

// Pixels of the row that need 16 rays or, at lamps, 64: a sliver of a lamp makes a pixel bright, so
// that 16 steps between none of it and all would be seen.
std::vector<FinePixel> fine_pixels(const Viewing& viewing, int y,
                                   std::span<const CentreRow> centres) {
    const int width = viewing.view.width();
    std::vector<char> outlined(width);
    for (int x = 0; x < width; ++x)
        outlined[x] = needs_more_rays(centres, x, y, viewing.footprint) ? 1 : 0;
    const std::vector<char> thin = more_within(viewing, y, centres[y], outlined);
    std::vector<FinePixel> pixels;
    for (int x = 0; x < width; ++x)
        if (outlined[x] || thin[x] || cornered(viewing, centres, x, y))
            pixels.push_back({x, touches_light(centres, x, y) ? 8 : 4});
    return pixels;
}

// A row again, with many rays in each pixel that needs them, and textures averaged over the others.
SeenRow refine_row(const Viewing& viewing, int y, const SeenRow& coarse,
                   std::span<const CentreRow> centres) {
    const std::vector<FinePixel> pixels = fine_pixels(viewing, y, centres);
    SeenRow fine;
    fine.background = coarse.background;
    fine.steady = coarse.steady;
    fine.rays = coarse.rays;
    if (viewing.aov == Aov::radiance)
        for (int x = 0; x < viewing.view.width(); ++x)
            if (centres[y].at(x).empty()) fine.background[x] = mean_environment(viewing, x, y);
    see_pixels(viewing, y, pixels, fine);

    SeenRow row;
    row.background = std::move(fine.background);
    row.steady = std::move(fine.steady);
    row.rays = std::move(fine.rays);
    row.pieces.reserve(coarse.pieces.size() + fine.pieces.size());
    auto from_coarse = coarse.pieces.begin();
    auto from_fine = fine.pieces.begin();
    const auto add_coarse_before = [&](std::uint32_t x) {
        for (; from_coarse != coarse.pieces.end() && from_coarse->x < x; ++from_coarse) {
            row.pieces.push_back(*from_coarse);
            if (viewing.aov == Aov::radiance)
                average_texture(viewing, centres, y, row.pieces.back());
        }
    };
    for (const FinePixel& pixel : pixels) {
        const auto x = static_cast<std::uint32_t>(pixel.x);
        add_coarse_before(x);
        while (from_coarse != coarse.pieces.end() && from_coarse->x == x) ++from_coarse;
        for (; from_fine != fine.pieces.end() && from_fine->x == x; ++from_fine)
            row.pieces.push_back(*from_fine);
    }
    add_coarse_before(static_cast<std::uint32_t>(viewing.view.width()));
    return row;
}

}  // namespace

IdMap make_id_map(ShadingCache& cache, const RayCaster& rays, const View& view,
                  const RayViewSettings& settings, OpenSides* open_sides) {
    const Viewing viewing = make_viewing(rays, view, settings);
    std::vector<SeenRow> rows(view.height());
    const bool antialiased = settings.quality == ViewQuality::antialiased;
    std::vector<CentreRow> centres(antialiased ? rows.size() : 0);
    parallel_for(settings.threads, rows.size(), [&](std::size_t y) {
        rows[y] =
            see_row(viewing, static_cast<int>(y), {.centres = antialiased ? &centres[y] : nullptr});
    });
    if (open_sides) mark_open_sides(*open_sides, rows);

    if (antialiased) {
        std::vector<SeenRow> finer(rows.size());
        parallel_for(settings.threads, rows.size(), [&](std::size_t y) {
            finer[y] = refine_row(viewing, static_cast<int>(y), rows[y], centres);
        });
        rows = std::move(finer);
    }
    return put_on_roots(cache, rows, viewing, nullptr, settings.threads);
}

ChancePass look_again(ShadingCache& cache, const RayCaster& rays, const View& view,
                      const RayViewSettings& settings, std::span<const ChancePixel> pixels,
                      std::uint32_t pass) {
    constexpr std::size_t kPixelsAtOnce = 16;  // few, so that short passes are shared too
    const Viewing viewing = make_viewing(rays, view, settings);
    std::vector<SeenRow> rows((pixels.size() + kPixelsAtOnce - 1) / kPixelsAtOnce);
    parallel_for(settings.threads, rows.size(), [&](std::size_t i) {
        const auto rest = pixels.subspan(i * kPixelsAtOnce);
        see_by_chance(viewing, rest.first(std::min(rest.size(), kPixelsAtOnce)), pass, rows[i]);
    });

    ChancePass seen;
    for (const SeenRow& row : rows) {
        const auto first = static_cast<std::uint32_t>(seen.light.size());
        seen.light.insert(seen.light.end(), row.background.begin(), row.background.end());
        for (const SeenPiece& piece : row.pieces) {
            const SurfacePoint& at = piece.point;
            const std::uint32_t pixel = first + piece.x;
            if (piece.glint != Rgb(0))
                seen.glints.push_back({pixel, at, piece.front, piece.seen_from, piece.glint});
            if (piece.reflectance == Rgb(0)) continue;
            seen.fragments.push_back({pixel, cache.root(at.object, at.primitive, piece.front),
                                      Vec2(at.u, at.v), piece.reflectance, piece.gloss, true});
        }
    }
    return seen;
}

Image draw(const ShadingCache& cache, const IdMap& map, int threads, const FadeIn* fade) {
    Image picture = map.background;
    parallel_for(threads, static_cast<std::size_t>(map.height), [&](std::size_t y) {
        const std::size_t first = y * static_cast<std::size_t>(map.width);
        for (std::size_t p = first; p < first + static_cast<std::size_t>(map.width); ++p)
            for (const Fragment& f : map.at_pixel(static_cast<std::uint32_t>(p)))
                picture.pixels[p] += shown_by(cache, f, fade);
    });
    return picture;
}

}  // namespace chiaro
