// How much light a rough surface gives back after a single reflection or refraction at one of its
// facets. What is missing met further facets: the surfaces of bsdf.h give it back in a second,
// broad lobe (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017).
//
// The tables are integrated when they are first asked, alike on every machine: 10 ms for mirrors,
// and 20 ms for each of the two nearest of 12 indices of refraction. They are exact to 0.0045 for
// cosines above 0.05 and indices above 1.1, to 0.013 for all. Thread: any number.
#pragma once

namespace chiaro {

/// Of light that comes evenly from all sides onto facets that reflect all of it, or the part
/// schlick_weight() of it, what reaches an eye at `cosine` after one reflection; all in [0, 1].
struct MirrorAlbedo {
    float full;
    float schlick;
    float mean;  // of `full` over the hemisphere, weighted by the cosine
};

/// `alpha`, in [0, 1], as in ggx.h; `cosine` of the eye's direction in [0, 1].
MirrorAlbedo mirror_albedo(float alpha, float cosine);

/// The same for the facets of clear glass that reflect and refract, light of the same radiance
/// over the square of the index coming from both sides.
struct GlassAlbedo {
    float full;
    float mean;
    float mean_beyond;  // for eyes on the other side
};

/// `eta`: the index beyond the surface over that on the eye's side, or its inverse from 1 to 3.
GlassAlbedo glass_albedo(float alpha, float eta, float cosine);

}  // namespace chiaro
