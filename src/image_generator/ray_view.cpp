#include "image_generator/ray_view.h"

#include "base/parallel.h"
#include "image_generator/view_fragments.h"
#include "shading_cache/interpolate.h"

#include <algorithm>

namespace chiaro {
namespace {

// Pixels in which one ray is not enough: an outline runs toward one of the neighbours.
bool needs_more_rays(const std::vector<std::vector<CentreHit>>& centres, int x, int y,
                     float footprint) {
    const CentreHit& here = centres[y][x];
    if (here.intricate) return true;
    const int height = static_cast<int>(centres.size());
    const int width = static_cast<int>(centres[y].size());
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
            if (outline_between(here, centres[ny][nx], footprint)) return true;
        }
    return false;
}

// Whether the pixel or one beside it shows something that emits. A sliver of a lamp makes a pixel
// bright, so that 16 steps between none of it and all would be seen.
bool touches_light(const std::vector<std::vector<CentreHit>>& centres, int x, int y) {
    const int height = static_cast<int>(centres.size());
    const int width = static_cast<int>(centres[y].size());
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx)
            if (centres[ny][nx].emissive) return true;
    return false;
}

// The hits of two neighbours, beside and above or below, that lie on the same primitive as this
// pixel's.
struct Neighbours {
    const CentreHit* beside = nullptr;
    const CentreHit* below = nullptr;
};
Neighbours on_same_primitive(const std::vector<std::vector<CentreHit>>& centres, int x, int y) {
    const CentreHit& here = centres[y][x];
    const auto same = [&](int nx, int ny) -> const CentreHit* {
        if (ny < 0 || ny >= static_cast<int>(centres.size())) return nullptr;
        if (nx < 0 || nx >= static_cast<int>(centres[ny].size())) return nullptr;
        const CentreHit& there = centres[ny][nx];
        const bool one =
            there.object == here.object && there.point.primitive == here.point.primitive;
        return one ? &there : nullptr;
    };
    Neighbours n{same(x + 1, y), same(x, y + 1)};
    if (!n.beside) n.beside = same(x - 1, y);
    if (!n.below) n.below = same(x, y - 1);
    return n;
}

// A row again, with 16 rays or more in each pixel that needs them, and textures averaged over the
// others.
SeenRow refine_row(const RayCaster& rays, const View& view, int y, const SeenRow& coarse,
                   const std::vector<std::vector<CentreHit>>& centres, float footprint, Aov aov) {
    SeenRow row;
    row.background = coarse.background;
    std::vector<char> outlined(view.width());
    for (int x = 0; x < view.width(); ++x)
        outlined[x] = needs_more_rays(centres, x, y, footprint) ? 1 : 0;
    const std::vector<char> thin = more_within(rays, view, y, centres[y], footprint, outlined);

    auto piece = coarse.pieces.begin();
    for (int x = 0; x < view.width(); ++x) {
        const CentreHit& centre = centres[y][x];
        const Neighbours near = centre.textured ? on_same_primitive(centres, x, y) : Neighbours{};
        const bool cornered = centre.textured && !(near.beside && near.below);
        const bool more = cornered || outlined[x] || thin[x];
        if (more)
            see_pixel(rays, view, x, y, touches_light(centres, x, y) ? 8 : 4, aov, row);
        else if (centre.object == ObjectId::none && aov == Aov::radiance)
            row.background[x] = mean_environment(rays.scene(), view, x, y, footprint);
        for (; piece != coarse.pieces.end() && piece->x == static_cast<std::uint32_t>(x); ++piece) {
            if (more) continue;
            row.pieces.push_back(*piece);
            if (centre.textured && aov == Aov::radiance)
                row.pieces.back().reflectance =
                    mean_base_color(rays.scene(), centre.point, near.beside->point,
                                    near.below->point) /
                    kPi;
        }
    }
    return row;
}

// Puts what was seen on root patches, in the order of pixels.
IdMap put_on_roots(ShadingCache& cache, const std::vector<SeenRow>& rows, const View& view) {
    IdMap map;
    map.width = view.width();
    map.height = view.height();
    map.background = Image(view.width(), view.height());
    std::size_t count = 0;
    for (const SeenRow& row : rows) count += row.pieces.size();
    map.fragments.reserve(count);
    map.first_of_pixel.reserve(map.background.pixels.size() + 1);
    for (int y = 0; y < map.height; ++y) {
        auto piece = rows[y].pieces.begin();
        for (int x = 0; x < map.width; ++x) {
            const auto pixel = static_cast<std::uint32_t>(y * map.width + x);
            map.first_of_pixel.push_back(static_cast<std::uint32_t>(map.fragments.size()));
            map.background.pixels[pixel] = rows[y].background[x];
            for (; piece != rows[y].pieces.end() && piece->x == static_cast<std::uint32_t>(x);
                 ++piece)
                map.fragments.push_back(
                    {pixel, cache.root(piece->point.object, piece->point.primitive, piece->front),
                     Vec2(piece->point.u, piece->point.v), piece->reflectance});
        }
    }
    map.first_of_pixel.push_back(static_cast<std::uint32_t>(map.fragments.size()));
    return map;
}

}  // namespace

IdMap make_id_map(ShadingCache& cache, const RayCaster& rays, const View& view,
                  const RayViewSettings& settings, OpenSides* open_sides) {
    std::vector<SeenRow> rows(view.height());
    std::vector<std::vector<CentreHit>> centres(view.height());
    parallel_for(settings.threads, rows.size(), [&](std::size_t y) {
        rows[y] = see_row(rays, view, static_cast<int>(y), settings.aov, centres[y]);
    });
    if (open_sides)
        for (const SeenRow& row : rows)
            for (const SeenPiece& piece : row.pieces)
                open_sides->mark(piece.point.object, piece.point.primitive, piece.front);

    if (settings.quality == ViewQuality::antialiased) {
        const float middle_x = 0.5f * static_cast<float>(view.width());
        const float middle_y = 0.5f * static_cast<float>(view.height());
        const float footprint = glm::length(view.ray(middle_x + 1, middle_y).direction -
                                            view.ray(middle_x, middle_y).direction);
        std::vector<SeenRow> finer(rows.size());
        parallel_for(settings.threads, rows.size(), [&](std::size_t y) {
            finer[y] = refine_row(rays, view, static_cast<int>(y), rows[y], centres, footprint,
                                  settings.aov);
        });
        rows = std::move(finer);
    }
    return put_on_roots(cache, rows, view);
}

Image draw(const ShadingCache& cache, const IdMap& map, int threads) {
    Image picture = map.background;
    parallel_for(threads, static_cast<std::size_t>(map.height), [&](std::size_t y) {
        const std::size_t first = y * static_cast<std::size_t>(map.width);
        for (std::size_t p = first; p < first + static_cast<std::size_t>(map.width); ++p)
            for (const Fragment& f : map.at_pixel(static_cast<std::uint32_t>(p)))
                picture.pixels[p] += f.reflectance * irradiance_at(cache, f.patch, f.local);
    });
    return picture;
}

}  // namespace chiaro
