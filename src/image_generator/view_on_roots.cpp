#include "image_generator/view_on_roots.h"

#include "base/parallel.h"

#include <algorithm>

namespace chiaro {
namespace {

bool shows_shading(const SeenPiece& piece) {
    return piece.reflectance != Rgb(0) || piece.gloss != Rgb(0);
}

// Neighbouring pixels mostly show one primitive.
bool on_same_side(const SeenPiece& a, const SeenPiece& b) {
    return a.point.object == b.point.object && a.point.primitive == b.point.primitive &&
           a.front == b.front;
}

// One after the other, so that roots are made in the order of pixels.
void make_roots(ShadingCache& cache, std::span<const SeenRow> rows) {
    for (const SeenRow& row : rows) {
        const SeenPiece* last = nullptr;
        for (const SeenPiece& piece : row.pieces) {
            if (!shows_shading(piece) || (last && on_same_side(*last, piece))) continue;
            cache.root(piece.point.object, piece.point.primitive, piece.front);
            last = &piece;
        }
    }
}

// A row of the map.
struct RowOnRoots {
    std::vector<Fragment> fragments;
    std::vector<std::uint32_t> counts;  // of these by x
    std::vector<Glint> glints;
    std::vector<ChancePixel> chance_pixels;
};

// Appends what the row's pieces show of pixel x; `piece` goes on behind them.
void add_seen(const ShadingCache& cache, const SeenRow& row, std::uint32_t x, std::uint32_t pixel,
              const SeenPiece*& piece, RowOnRoots& made) {
    bool chance = false;
    for (; piece != row.pieces.data() + row.pieces.size() && piece->x == x; ++piece) {
        const SurfacePoint& at = piece->point;
        chance |= by_chance(piece->trail) || piece->glint != Rgb(0);
        if (piece->glint != Rgb(0))
            made.glints.push_back({pixel, at, piece->front, piece->seen_from, piece->glint});
        if (!shows_shading(*piece)) continue;
        made.fragments.push_back({pixel, cache.known_root(at.object, at.primitive, piece->front),
                                  Vec2(at.u, at.v), piece->reflectance, piece->gloss,
                                  by_chance(piece->trail)});
    }
    if (chance) made.chance_pixels.push_back({pixel, row.rays[x], row.steady[x]});
}

// Goes through things that lie in pixels, in order of these.
template <typename Thing>
class Walk {
public:
    Walk(const std::vector<Thing>& things, std::uint32_t first_pixel)
        : next_(std::ranges::lower_bound(things, first_pixel, {}, &Thing::pixel)),
          end_(things.end()) {}
    void skip(std::uint32_t pixel) {
        while (next_ != end_ && next_->pixel == pixel) ++next_;
    }
    void copy(std::uint32_t pixel, std::vector<Thing>& to) {
        while (next_ != end_ && next_->pixel == pixel) to.push_back(*next_++);
    }

private:
    std::vector<Thing>::const_iterator next_, end_;
};

RowOnRoots make_row(const ShadingCache& cache, const SeenRow& row, std::uint32_t y,
                    const IdMap* before, Image& background) {
    const auto width = static_cast<std::uint32_t>(background.width);
    const std::uint32_t first = y * width;
    static const IdMap kNothing;
    Walk<Glint> glints((before ? before : &kNothing)->glints, first);
    Walk<ChancePixel> chance((before ? before : &kNothing)->chance_pixels, first);

    RowOnRoots made;
    made.fragments.reserve(std::max<std::size_t>(row.pieces.size(), width));
    made.counts.reserve(width);
    const SeenPiece* piece = row.pieces.data();
    for (std::uint32_t x = 0; x < width; ++x) {
        const std::uint32_t pixel = first + x;
        const std::size_t so_far = made.fragments.size();
        if (row.has(x)) {
            add_seen(cache, row, x, pixel, piece, made);
            background.pixels[pixel] = row.background[x];
            glints.skip(pixel);
            chance.skip(pixel);
        } else {
            const auto kept = before->at_pixel(pixel);
            made.fragments.insert(made.fragments.end(), kept.begin(), kept.end());
            background.pixels[pixel] = before->background.pixels[pixel];
            glints.copy(pixel, made.glints);
            chance.copy(pixel, made.chance_pixels);
        }
        made.counts.push_back(static_cast<std::uint32_t>(made.fragments.size() - so_far));
    }
    return made;
}

}  // namespace

IdMap put_on_roots(ShadingCache& cache, std::span<const SeenRow> rows, const Viewing& viewing,
                   const IdMap* before, int threads) {
    make_roots(cache, rows);
    IdMap map;
    map.irradiance = viewing.aov == Aov::irradiance;
    map.width = viewing.view.width();
    map.height = viewing.view.height();
    map.background = Image(map.width, map.height);
    std::vector<RowOnRoots> made(rows.size());
    parallel_for(threads, rows.size(), [&](std::size_t y) {
        made[y] = make_row(cache, rows[y], static_cast<std::uint32_t>(y), before, map.background);
    });

    std::vector<std::size_t> first_of_row;
    std::size_t count = 0;
    map.first_of_pixel.reserve(map.background.pixels.size() + 1);
    for (const RowOnRoots& row : made) {
        first_of_row.push_back(count);
        for (const std::uint32_t of_pixel : row.counts) {
            map.first_of_pixel.push_back(static_cast<std::uint32_t>(count));
            count += of_pixel;
        }
        map.glints.insert(map.glints.end(), row.glints.begin(), row.glints.end());
        map.chance_pixels.insert(map.chance_pixels.end(), row.chance_pixels.begin(),
                                 row.chance_pixels.end());
    }
    map.first_of_pixel.push_back(static_cast<std::uint32_t>(count));
    map.fragments.resize(count);
    parallel_for(threads, made.size(), [&](std::size_t y) {
        std::ranges::copy(made[y].fragments,
                          map.fragments.begin() + static_cast<std::ptrdiff_t>(first_of_row[y]));
    });
    return map;
}

void mark_open_sides(OpenSides& open_sides, std::span<const SeenRow> rows) {
    for (const SeenRow& row : rows) {
        const SeenPiece* last = nullptr;
        for (const SeenPiece& piece : row.pieces) {
            if (by_chance(piece.trail) || (last && on_same_side(*last, piece))) continue;
            open_sides.mark(piece.point.object, piece.point.primitive, piece.front);
            last = &piece;
        }
    }
}

}  // namespace chiaro
