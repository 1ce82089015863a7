#include "sample_renderer/mirror_light.h"

#include "scene/scattering.h"

namespace chiaro {
namespace {

// Where the straight line that leaves `from` along `w` meets the mirror; nothing beside it.
std::optional<SurfacePoint> meet(const FlatMirror& mirror, Vec3 from, Vec3 w) {
    // Cramer's rule on from + t w = corner + a u + b v.
    const Vec3 p = glm::cross(w, mirror.v);
    const float determinant = glm::dot(mirror.u, p);
    if (determinant == 0) return std::nullopt;
    const Vec3 s = from - mirror.corner;
    const float a = glm::dot(s, p) / determinant;
    if (!(a >= 0 && a <= 1)) return std::nullopt;
    const Vec3 q = glm::cross(s, mirror.u);
    const float b = glm::dot(w, q) / determinant;
    if (!(b >= 0 && a + b <= 1)) return std::nullopt;
    return mirror.at(a, b);
}

}  // namespace

std::optional<LightConnection> connect_image(const LitScene& lit, const Receiver& receiver,
                                             const FlatMirror& mirror, std::uint32_t light_index) {
    // Both are before the mirror, on the same side.
    const PunctualLight& light = lit.scene.lights[light_index];
    const bool sun = light.kind == LightKind::directional;
    const Vec3 to_light = sun ? -light.direction : light.position - receiver.position;
    const float height = glm::dot(receiver.position - mirror.corner, mirror.normal);
    const float light_height = sun ? glm::dot(to_light, mirror.normal)
                                   : glm::dot(light.position - mirror.corner, mirror.normal);
    if (!(height * light_height > 0)) return std::nullopt;

    // The image lies behind it.
    const Vec3 to_image = to_light - 2 * light_height * mirror.normal;
    const float squared = glm::dot(to_image, to_image);
    const Vec3 w = to_image / std::sqrt(squared);
    const float cosine = receiving_cosine(receiver, w);
    if (!(cosine > 0)) return std::nullopt;
    const auto met = meet(mirror, receiver.position, w);
    if (!met) return std::nullopt;

    // What the mirror gives back of the light there, which spreads over the whole way.
    const Vec3 place = surface_position(lit.scene, *met);
    const auto arriving = arrival(light, place);
    if (!arriving || arriving->irradiance == Rgb(0)) return std::nullopt;
    const Vec3 normal = std::copysign(1.0f, height) * mirror.normal;
    const SmoothParts parts =
        smooth_parts(make_scattering(bsdf_at(lit.scene, *met, height > 0), normal, normal, -w));
    const float spread = sun ? 1.0f : arriving->distance * arriving->distance / squared;
    const Rgb irradiance =
        opacity(lit.scene, *met) * spread * parts.reflected * arriving->irradiance;
    if (!(max_component(irradiance) > 0)) return std::nullopt;

    LightConnection connection;
    connection.to_light = w;
    connection.cosine = cosine;
    connection.irradiance = irradiance * cosine;
    const Vec3 turn = place + lit.caster.offset(place, mirror.object) * normal;
    connection.shadow_ray = {receiver.origin, turn - receiver.origin, 0, 1};
    connection.second_ray = sun ? Ray{turn, to_light} : ray_to_lamp(turn, light.position);
    return connection;
}

}  // namespace chiaro
