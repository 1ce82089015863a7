#include "sample_renderer/diffuse_bounce.h"

#include "sample_renderer/path_lights.h"

#include <cstddef>
#include <cstring>

namespace chiaro {
namespace {

// The structs of the wave are read eight words at a time.
constexpr std::size_t kWord = sizeof(float);
static_assert(sizeof(Ray) == 8 * kWord && sizeof(Path) % kWord == 0);
static_assert(offsetof(Path, slot) == 8 * kWord && offsetof(Path, roulette_scale) == 15 * kWord);
static_assert(offsetof(Hit, t) == 4 * kWord && offsetof(Hit, normal) == 6 * kWord);

// What one does to paths in all lanes.
struct Paths8 {
    Vec3x8 throughput;
    Word8 key;
    Vec2x8 light_place;
    Float8 light_choice, roulette_scale;
};

Paths8 load_paths(std::span<const Path> paths) {
    Float8 front[kLanes], back[kLanes];
    load_words(paths, 0, front);
    load_words(paths, 8, back);
    return {{front[0], front[1], front[2]}, bits_of(back[1]), {back[2], back[3]}, back[4], back[7]};
}

Receiver8 load_receivers(const DiffuseBounce& here) {
    Float8 ray[kLanes], hit[kLanes];
    load_words(std::span<const Ray>(here.wave.rays).subspan(here.first, here.lane_count()), 0, ray);
    load_words(std::span<const Hit>(here.wave.hits).subspan(here.first, here.lane_count()), 2, hit);
    const Vec3x8 origin = {ray[0], ray[1], ray[2]}, direction = {ray[3], ray[4], ray[5]};
    const Float8 t = hit[2], offset = hit[3];
    const Vec3x8 front = {hit[4], hit[5], hit[6]};
    const Float8 side = copysign(Float8(1), Float8(0) - dot(front, direction));
    const Vec3x8 position = origin + t * direction, normal = side * front;
    return {position, position + offset * normal, normal, side * here.shading_normal.all()};
}

// The lanes that do not end here for whoever is asked.
std::uint32_t ask_ends(const DiffuseBounce& here, const Receiver8& receivers,
                       const Vec3x8& reflected, std::uint32_t lanes) {
    const std::span<const Path> paths = here.wave.paths;
    const std::span<const Hit> hits = here.wave.hits;
    return lanes & ~(*here.ends_at)({paths.subspan(here.first, here.lane_count()),
                                     hits.subspan(here.first, here.lane_count()), receivers,
                                     reflected, here.number, lanes});
}

void add_area_light(const DiffuseBounce& here, const Receiver8& receivers, const Paths8& paths,
                    const Vec3x8& brdf, std::uint32_t lanes) {
    const LightConnections8 found =
        connect_area_light(here.lit, receivers, paths.light_choice, paths.light_place, lanes);
    const Float8 weight =
        found.pdf_solid_angle / (found.pdf_solid_angle + found.cosine * Float8(1 / kPi));
    std::uint32_t slots[kLanes];
    for (int i = 0; i < kLanes; ++i)
        slots[i] = here.wave.paths[here.first + std::min(i, here.lane_count() - 1)].slot;
    here.wave.shadows.add(found, receivers.origin, brdf * (weight * found.irradiance), slots);
}

// One by one, where there are any.
void add_other_lights(const DiffuseBounce& here, const Receiver8& receivers, const Paths8& paths,
                      const Vec3x8& brdf, std::uint32_t lanes) {
    if (here.lit.punctual.empty() && here.lit.environment.empty()) return;
    const Lanes3 colors(brdf),
        numbers({paths.light_choice, paths.light_place.x, paths.light_place.y});
    for_each_lane(lanes, [&](int i) {
        Path path = here.wave.paths[here.first + i];
        path.light_choice = numbers.x[i];
        path.light_place = {numbers.y[i], numbers.z[i]};
        if (here.number > 0) draw_sky_numbers(here.lit, here.number, path);
        connect_other_lights(here.lit, lane(receivers, i), path, [&](const LightConnection& found) {
            const float weight = light_weight(found, found.pdf_cosine());
            here.wave.shadows.add(found, colors.lane(i) * found.irradiance * weight, path.slot);
        });
    });
}

void store_next(const DiffuseBounce& here, const Receiver8& receivers, const Vec3x8& throughput,
                const Vec3x8& direction, Float8 pdf, EightPaths& next) {
    const Vec3x8 &origin = receivers.origin, &normal = receivers.geometric_normal;
    Float8 rays[kLanes] = {origin.x,    origin.y,    origin.z, direction.x,
                           direction.y, direction.z, 0.0f,     kInfinity};
    store_words(rays, next.rays);
    const Float8 first = 0.0f;
    Float8 paths[kLanes] = {throughput.x, throughput.y, throughput.z, pdf,
                            normal.x,     normal.y,     normal.z,     first};
    store_words(paths, next.paths);

    // The rest of a path stays what it was.
    constexpr std::size_t kKept = offsetof(Path, slot);
    for (int i = 0; i < here.lane_count(); ++i)
        std::memcpy(reinterpret_cast<char*>(&next.paths[i]) + kKept,
                    reinterpret_cast<const char*>(&here.wave.paths[here.first + i]) + kKept,
                    sizeof(Path) - kKept);
}

}  // namespace

std::uint32_t reflect_diffusely(const DiffuseBounce& here, EightPaths& next) {
    Paths8 paths =
        load_paths(std::span<const Path>(here.wave.paths).subspan(here.first, here.lane_count()));
    const Receiver8 receivers = load_receivers(here);
    const Vec3x8 reflected = paths.throughput * here.base_color.all();
    std::uint32_t lanes = here.lanes & (max_component(reflected) > Float8(0)).lanes();
    if (here.ends_at) lanes = ask_ends(here, receivers, reflected, lanes);

    // Numbers for the lights, unless it is the first surface of all: those are the sequence's.
    BounceNumbers8 numbers(paths.key, here.number);
    if (here.number > 0) {
        paths.light_choice = numbers.next();
        paths.light_place = numbers.next_pair();
    }
    const Vec3x8 brdf = Float8(1 / kPi) * reflected;
    if (!here.lit.area_lights.empty()) add_area_light(here, receivers, paths, brdf, lanes);
    add_other_lights(here, receivers, paths, brdf, lanes);

    // Russian roulette on what the path has come to carry.
    const Float8 survival = smaller(kMostSurvival, paths.roulette_scale * max_component(reflected));
    lanes &= (numbers.next() < survival).lanes();
    const Vec3x8 direction = sample_receiving_cosine(receivers, numbers.next_pair());
    const Float8 pdf = receiving_cosine(receivers, direction) * Float8(1 / kPi);
    lanes &= (pdf > Float8(0)).lanes();
    store_next(here, receivers, (Float8(1) / survival) * reflected, direction, pdf, next);
    return lanes;
}

}  // namespace chiaro
