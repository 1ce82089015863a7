// A Bsdf in its place: how light scatters about a shading normal at a surface whose real plane is
// another.
//
// A direction that the shading normal puts on one side of the surface and the real plane on the
// other is mirrored at the real plane. So no light is lost or leaks through where normals are
// interpolated, and what is white stays white. Where both normals are one, nothing is mirrored.
//
// Directions are unit, in world space, and point away from the surface.
#pragma once

#include "scene/bsdf.h"

namespace chiaro {

struct Scattering {
    Bsdf bsdf;
    Frame frame;            // about the shading normal, on the side of `from`
    Vec3 geometric_normal;  // of the real plane; unit, on the side of `from`
    Vec3 from;              // the known direction in the frame; z > 0
    Vec3 from_world;        // and as it was given
    bool flat;              // the normals are one
};

/// Of a walk that came along `from`, which is above the real plane; where it is below the shading
/// normal's it counts as just above. Both normals are unit and on its side.
Scattering make_scattering(const Bsdf& bsdf, Vec3 geometric_normal, Vec3 shading_normal, Vec3 from);

/// Radiance toward `from`, an eye, over radiance that arrives from `to_light` and its solid angle
/// [1 / steradian]: value times cosine, without what is smooth.
Rgb scattered(const Scattering& s, Vec3 to_light);

/// Of a walk that carries importance from a light: flux toward `to_eye` and its solid angle over
/// flux that came along `from` [1 / steradian]. It is scattered() with the roles that the light
/// has, so that walks from both ends agree, also about shading normals: Veach's correction (1997,
/// 5.3.2).
Rgb scattered_importance(const Scattering& s, Vec3 to_eye);

/// The same surface for a walk that comes along `to`, on whichever side that is.
Scattering reversed(const Scattering& s, Vec3 to);

/// Density over solid angle of sample_scattering()'s directions, deltas and ends left out.
float pdf_scattering(const Scattering& s, Vec3 to);

/// As sample_bsdf(); the direction in world space. Lobe::transmission is below the real plane, all
/// others above. Weights are scattered() over the density, or scattered_importance().
std::optional<BsdfSample> sample_scattering(const Scattering& s, float u_lobe, Vec2 u,
                                            Transport transport = Transport::radiance);

/// What is smooth of a surface, exactly: where light comes from that `from` sees in it, and by what
/// its radiance is multiplied. Black where there is no such light.
struct SmoothParts {
    Vec3 reflected_from;  // above the real plane
    Rgb reflected = Rgb(0);
    Vec3 transmitted_from;  // below it
    Rgb transmitted = Rgb(0);
};
SmoothParts smooth_parts(const Scattering& s);

}  // namespace chiaro
