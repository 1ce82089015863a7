// Where walks from lights start: with which densities, of all lights by their power.
#pragma once

#include "base/weighted_choice.h"
#include "sample_renderer/mis_weight.h"
#include "sample_renderer/next_event.h"

namespace chiaro {

/// The kinds of light: each has its own choice and its own samples.
enum class LightSource : std::uint32_t { area, lamp, sun, sky };

/// The first ray of a walk from a light.
struct Emission {
    Ray ray;          // of unit direction
    Rgb flux;         // that it stands for [lumen a channel]: over all densities
    float start;      // density over area of the place, its choice included; of the sky over
                      // directions, of a punctual light the choice alone
    float direction;  // density over solid angle; from infinity, over area across the rays
    Vec3 position;    // where it starts; from infinity, of no meaning
    Vec3 normal;      // of an area light's surface, or along the sky's ray; 0 of a punctual light
    LightSource from = LightSource::lamp;
    ObjectId object = ObjectId::none;  // of an area light
    std::uint32_t index = 0;           // its primitive; of a punctual light, that in Scene::lights
    Vec2 uv = Vec2(0);                 // on that primitive

    /// From infinitely far.
    bool parallel() const { return from == LightSource::sun || from == LightSource::sky; }
    /// Rays can meet the light.
    bool solid() const { return from == LightSource::area || from == LightSource::sky; }
};

/// What a vertex gets from one sample of a light, with all that a weight asks about it.
struct LightSample {
    Ray shadow_ray;
    Vec3 to_light;    // unit
    Rgb irradiance;   // across the direction, over the density of the choice
    float start;      // density with which walks start there, over that of the choice
    float direction;  // with which these find a surface at the vertex, over area across the ray
    float met = 0;    // takes a density over solid angle at the vertex to that of a ray that meets
                      // the light, over that of the choice
};

/// The densities of a light that a ray met.
struct MetLight {
    LightEnd end;
    float pdf_back;  // over solid angle, of a walk's first direction against the ray
};

/// Describes the lights as they were when built, so build anew when they change, or when the bounds
/// of a scene with suns do. A light has the power that its colour and size tell, and no kind of
/// light less than a tenth of an even chance.
///
/// Thread: const calls from any number of threads.
class Emitters {
public:
    explicit Emitters(const LitScene& lit);

    bool empty() const { return kinds_.empty(); }

    /// Numbers in [0, 1). Nothing if it is black there. Checks: not empty().
    std::optional<Emission> sample(const LitScene& lit, float choice, Vec2 place,
                                   Vec2 direction) const;

    /// Density over area with which next event estimation for `place` chooses where the walk
    /// started; of a punctual light the chance.
    static float chosen(const LitScene& lit, const Receiver& place, const Emission& emission);

    /// The numbers of light samples at a vertex, all in [0, 1).
    struct Numbers {
        float choice;
        Vec2 spot;  // on an area light
        Vec2 sky;
    };

    /// A light of each kind, as next event estimation for `place` chooses them; calls
    /// use(LightSample).
    template <typename Use>
    void sample_each_kind(const LitScene& lit, const Receiver& place, const Numbers& numbers,
                          const Use& use) const {
        if (!lit.area_lights.empty())
            if (const auto found = sample_area_light(lit, place, numbers)) use(*found);
        if (!lit.punctual.lamps().empty())
            if (const auto found = sample_lamp(lit, place, numbers.choice)) use(*found);
        if (!lit.punctual.suns().empty())
            if (const auto found = sample_sun(lit, place, numbers.choice)) use(*found);
        if (!lit.environment.empty())
            if (const auto found = sample_sky(lit, place, numbers.sky)) use(*found);
    }

    /// Of the surface that emits at `hit`, which a ray along `direction` from `place` met.
    MetLight met(const LitScene& lit, const LitPlace& place, Vec3 direction, const Hit& hit) const;
    /// Of the environment, which it met by leaving the scene.
    MetLight met_sky(const LitScene& lit, const LitPlace& place, Vec3 direction) const;

private:
    std::optional<Emission> from_area(const LitScene& lit, float choice, Vec2 place,
                                      Vec2 direction) const;
    std::optional<Emission> from_lamp(const LitScene& lit, float choice, Vec2 direction) const;
    Emission from_sun(const LitScene& lit, float choice, Vec2 place) const;
    std::optional<Emission> from_sky(const LitScene& lit, Vec2 place, Vec2 direction) const;

    std::optional<LightSample> sample_area_light(const LitScene& lit, const Receiver& place,
                                                 const Numbers& numbers) const;
    std::optional<LightSample> sample_lamp(const LitScene& lit, const Receiver& place,
                                           float choice) const;
    std::optional<LightSample> sample_sun(const LitScene& lit, const Receiver& place,
                                          float choice) const;
    std::optional<LightSample> sample_sky(const LitScene& lit, const Receiver& place,
                                          Vec2 sky) const;
    /// A ray along `direction` through a disk that the whole scene is behind.
    Ray ray_from_infinity(Vec3 direction, Vec2 place) const;
    float disk_density() const { return 1 / (kPi * radius_ * radius_); }
    float chance_of(LightSource kind) const {
        return kinds_.probability(static_cast<std::uint32_t>(kind));
    }

    WeightedChoice kinds_, lamps_, suns_;
    Vec3 centre_ = Vec3(0);  // of a ball about the scene
    float radius_ = 0;
};

}  // namespace chiaro
