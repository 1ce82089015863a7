#include "image_generator/view_fragments.h"

#include "base/random.h"

#include <algorithm>

namespace chiaro {
namespace {

// Place `i` of side x side in a pixel, on a rotated grid: as many different heights and widths as
// places, so that edges near the axes are smooth too.
Vec2 place_in_pixel(int i, int side) {
    const auto n = static_cast<float>(side);
    const auto a = static_cast<float>(i % side), b = static_cast<float>(i / side);
    return {(a + (b + 0.5f) / n) / n, (b + (a + 0.5f) / n) / n};
}

Looking look_at(const View& view, int x, int y, Vec2 in_pixel) {
    Looking l;
    l.ray = view.ray(static_cast<float>(x) + in_pixel.x, static_cast<float>(y) + in_pixel.y);
    l.x = static_cast<std::uint32_t>(x);
    l.key = hash32(static_cast<std::uint32_t>(y * view.width() + x));
    return l;
}

SeenPiece make_piece(const Sighting& s, std::uint32_t x, Aov aov) {
    SeenPiece piece;
    piece.x = x;
    piece.point = s.hit.point;
    piece.front = s.hit.front;
    piece.reflectance = aov == Aov::irradiance ? s.weight : s.weight * s.diffuse * (1 / kPi);
    if (s.cached_gloss) piece.gloss = s.weight;
    if (s.by_chance > 0) piece.glint = s.weight;
    piece.seen_from = s.seen_from;
    piece.trail = s.trail;
    piece.weight = s.weight;
    piece.cosine = s.cosine;
    return piece;
}

// The pieces of one pixel, of which those that lie together become one at their mean place.
struct PixelPieces {
    std::vector<SeenPiece>& pieces;
    std::size_t first;
    float footprint;
    bool pick = false;              // one of the places by chance instead of their mean
    std::vector<float> parts = {};  // of each piece
    std::vector<Vec3> positions = {};
    Rng random = Rng(0);

    void next() {
        first = pieces.size();
        parts.clear();
        positions.clear();
    }
    void add(const SeenPiece& piece, const Sighting& s, float part) {
        for (std::size_t i = first; i < pieces.size(); ++i) {
            SeenPiece& known = pieces[i];
            Vec3& position = positions[i - first];
            if (known.point.object != piece.point.object ||
                known.point.primitive != piece.point.primitive || known.front != piece.front ||
                !together(known.trail, piece, position, s))
                continue;
            const float share = part / (parts[i - first] + part);
            if (!pick) {
                known.point.u += share * (piece.point.u - known.point.u);
                known.point.v += share * (piece.point.v - known.point.v);
                position += share * (s.position - position);
            } else if (random.uniform() < share) {
                known.point = piece.point;
                known.seen_from = piece.seen_from;
                position = s.position;
            }
            known.reflectance += piece.reflectance;
            known.gloss += piece.gloss;
            known.glint += piece.glint;
            parts[i - first] += part;
            return;
        }
        pieces.push_back(piece);
        parts.push_back(part);
        positions.push_back(s.position);
    }

    // One primitive seen straight in one pixel lies together; in a curved or rough mirror it may
    // be seen all over.
    bool together(Trail known, const SeenPiece& piece, Vec3 position, const Sighting& s) const {
        if (known == 0 && piece.trail == 0) return true;
        return glm::distance(position, s.position) < 2 * footprint * s.distance;
    }
};

// Indices of what was seen, pixel by pixel.
std::vector<std::uint32_t> by_pixel(std::span<const Looking> looking,
                                    std::span<const Sighting> sightings) {
    std::vector<std::uint32_t> order(sightings.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        return looking[sightings[a].looking].x < looking[sightings[b].looking].x;
    };
    if (!std::is_sorted(order.begin(), order.end(), before))
        std::stable_sort(order.begin(), order.end(), before);
    return order;
}

// What several rays a pixel see, in whole pixels; replaces the pixels' backgrounds.
void see_fine(const Viewing& viewing, std::span<const Looking> looking, SeenRow& row) {
    thread_local std::vector<Sighting> sightings;
    look(viewing.rays, looking, viewing.chains, sightings);
    for (const Looking& l : looking) {
        row.background[l.x] = row.steady[l.x] = Rgb(0);
        row.rays[l.x] = 0;
    }
    for (const Looking& l : looking) ++row.rays[l.x];
    PixelPieces pixel{row.pieces, row.pieces.size(), viewing.footprint};
    std::uint32_t last_x = looking.front().x;
    for (const std::uint32_t i : by_pixel(looking, sightings)) {
        const Sighting& s = sightings[i];
        const std::uint32_t x = looking[s.looking].x;
        if (x != last_x) pixel.next();
        last_x = x;
        if (s.hit) pixel.add(make_piece(s, x, viewing.aov), s, max_component(s.weight));
        row.add(x, s);
    }
}

// What one ray each sees; all in one row.
SeenRow see_centres(const Viewing& viewing, std::span<const Looking> looking,
                    const RowNotes& notes) {
    const auto width = static_cast<std::size_t>(viewing.view.width());
    SeenRow row;
    row.start(width);
    row.rays.assign(width, 1);
    thread_local std::vector<Sighting> sightings;
    look(viewing.rays, looking, viewing.chains, sightings, notes.lines);
    row.pieces.reserve(sightings.size());
    for (const std::uint32_t i : by_pixel(looking, sightings)) {
        const Sighting& s = sightings[i];
        const std::uint32_t x = looking[s.looking].x;
        if (s.hit) row.pieces.push_back(make_piece(s, x, viewing.aov));
        row.add(x, s);
    }
    if (notes.centres) *notes.centres = make_centre_row(viewing.rays.scene(), looking, sightings);
    return row;
}

// Ray `r` of a later pass, at the place that it had in the first look, so that both agree on what
// covers the pixel. Each pass has the sequence's directions in another order: all places meet all
// of them in the end.
Looking look_again_at(const View& view, const ChancePixel& pixel, std::uint32_t pass,
                      std::uint32_t r) {
    constexpr std::uint32_t kSalt = 0x9e3779b9;
    const auto width = static_cast<std::uint32_t>(view.width());
    int side = 1;
    while (static_cast<std::uint32_t>(side * side) < pixel.rays) ++side;
    const Vec2 place = side == 1 ? Vec2(0.5f) : place_in_pixel(static_cast<int>(r), side);
    Looking l = look_at(view, static_cast<int>(pixel.pixel % width),
                        static_cast<int>(pixel.pixel / width), place);
    l.part = 1 / static_cast<float>(pixel.rays);
    l.key = hash32(pixel.pixel, kSalt);
    const std::uint32_t turn = hash32(hash32(l.key), pass) % pixel.rays;
    l.index = (pass - 1) * pixel.rays + (r + turn) % pixel.rays;
    return l;
}

}  // namespace

Viewing make_viewing(const RayCaster& rays, const View& view, const RayViewSettings& settings) {
    const float x = 0.5f * static_cast<float>(view.width());
    const float y = 0.5f * static_cast<float>(view.height());
    ChainSettings chains;
    chains.chains = settings.aov == Aov::radiance;
    chains.cached_facets = settings.cached_facets;
    chains.environment =
        settings.environment ? *settings.environment : !is_dark(rays.scene().environment);
    return {rays, view, settings.aov, chains,
            glm::length(view.ray(x + 1, y).direction - view.ray(x, y).direction)};
}

SeenRow see_row(const Viewing& viewing, int y, const RowNotes& notes) {
    std::vector<Looking> looking(viewing.view.width());
    for (int x = 0; x < viewing.view.width(); ++x)
        looking[x] = look_at(viewing.view, x, y, Vec2(0.5f));
    return see_centres(viewing, looking, notes);
}

SeenRow see_part_of_row(const Viewing& viewing, int y, std::vector<char> wanted,
                        std::vector<SightLine>& lines) {
    std::vector<Looking> looking;
    for (int x = 0; x < viewing.view.width(); ++x)
        if (wanted[x]) looking.push_back(look_at(viewing.view, x, y, Vec2(0.5f)));
    SeenRow row = see_centres(viewing, looking, {.lines = &lines});
    row.looked = std::move(wanted);
    return row;
}

std::vector<char> more_within(const Viewing& viewing, int y, const CentreRow& centres,
                              std::span<const char> known) {
    constexpr int kSide = 2;
    std::vector<Ray> scouts;
    std::vector<int> pixels;
    for (int x = 0; x < centres.width(); ++x) {
        if (known[x]) continue;
        for (int i = 0; i < kSide * kSide; ++i) {
            scouts.push_back(look_at(viewing.view, x, y, place_in_pixel(i, kSide)).ray);
            pixels.push_back(x);
        }
    }
    std::vector<Hit> hits(scouts.size());
    viewing.rays.intersect_coherent(scouts, hits, RayKind::camera);

    std::vector<char> more(centres.width(), 0);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const int x = pixels[i];
        const CentreHit* centre = find_trail(centres.at(x), 0);
        if (centre && same_face(*centre, hits[i])) continue;
        const CentreHit found =
            centre_hit(viewing.rays.scene(), scouts[i], hits[i], static_cast<std::uint32_t>(x));
        if (outline_between(centre ? *centre : CentreHit{}, found, viewing.footprint)) more[x] = 1;
    }
    return more;
}

void see_pixels(const Viewing& viewing, int y, std::span<const FinePixel> pixels, SeenRow& row) {
    constexpr std::size_t kRaysAtOnce = 2048;
    std::vector<Looking> looking;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto [x, side] = pixels[i];
        for (int r = 0; r < side * side; ++r) {
            Looking l = look_at(viewing.view, x, y, place_in_pixel(r, side));
            l.part = 1 / static_cast<float>(side * side);
            l.index = static_cast<std::uint32_t>(r);
            looking.push_back(l);
        }
        if (looking.size() < kRaysAtOnce && i + 1 < pixels.size()) continue;
        see_fine(viewing, looking, row);
        looking.clear();
    }
}

void see_by_chance(const Viewing& viewing, std::span<const ChancePixel> pixels, std::uint32_t pass,
                   SeenRow& row) {
    row.start(pixels.size());
    std::vector<Looking> looking;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (std::uint32_t r = 0; r < pixels[i].rays; ++r) {
            looking.push_back(look_again_at(viewing.view, pixels[i], pass, r));
            looking.back().x = static_cast<std::uint32_t>(i);
        }
    }
    thread_local std::vector<Sighting> sightings;
    look(viewing.rays, looking, viewing.chains, sightings);
    PixelPieces pixel{row.pieces, row.pieces.size(), viewing.footprint, true};
    auto last = static_cast<std::uint32_t>(-1);
    for (const std::uint32_t i : by_pixel(looking, sightings)) {
        const Sighting& s = sightings[i];
        const std::uint32_t x = looking[s.looking].x;
        if (x != last) {
            pixel.next();
            pixel.random = Rng(hash32(pixels[x].pixel, pass));
        }
        last = x;
        if (by_chance(s.trail)) row.background[x] += s.light;
        SeenPiece piece = make_piece(s, x, viewing.aov);
        if (!by_chance(s.trail)) piece.reflectance = piece.gloss = Rgb(0);
        const bool shows = piece.reflectance != Rgb(0) || piece.glint != Rgb(0);
        if (s.hit && shows) pixel.add(piece, s, max_component(s.weight));
    }
}

Rgb mean_environment(const Viewing& viewing, int x, int y) {
    const Scene& scene = viewing.rays.scene();
    const Environment& environment = scene.environment;
    const EnvironmentFrame frame(scene.up);
    const auto map_pixels_a_radian = static_cast<float>(environment.map.width) / (2 * kPi);
    const int side = static_cast<int>(
        std::clamp(std::ceil(viewing.footprint * map_pixels_a_radian), 1.0f, 8.0f));
    Rgb sum(0);
    for (int i = 0; i < side * side; ++i) {
        const Ray ray = look_at(viewing.view, x, y, place_in_pixel(i, side)).ray;
        sum += radiance_from(environment, frame, ray.direction);
    }
    return sum / static_cast<float>(side * side);
}

}  // namespace chiaro
