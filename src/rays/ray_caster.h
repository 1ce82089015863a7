// Nearest hits and occlusion against a scene; the only folder that includes Embree.
#pragma once

#include "rays/ray_log.h"
#include "scene/surface.h"
#include "scene/tessellate.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace chiaro {

/// Where a ray meets a surface. `point.object` is none if it met nothing.
struct Hit {
    SurfacePoint point;
    float t = kInfinity;  // in multiples of the ray's direction
    float offset = 0;     // how far to start a ray from here so that it does not meet this again
    Vec3 normal = Vec3(0, 0, 1);  // unit geometric normal of the front face, world space
    bool front = true;  // met the front face (counter-clockwise winding toward the origin)
    bool flat = false;  // known: the shading normal is the geometric one on all of the primitive

    explicit operator bool() const { return point.object != ObjectId::none; }
};

/// Which surfaces stop a ray. All stop at opaque surfaces and where a mask's alpha reaches its
/// cutoff; a blended surface stops one with the probability of its alpha, decided by a hash of the
/// ray: right in the mean of many rays, and the same on every run. `camera` rays pass single-sided
/// faces from behind.
enum class RayKind { transport, camera };

/// One of the surfaces that a ray from the eye shows.
struct LayerHit {
    std::uint32_t ray;
    Hit hit;
};
/// Blended surfaces that one ray can show; what lies behind more of them, other than the surface
/// that stops the ray, is left out.
inline constexpr std::uint32_t kMostLayers = 32;

/// How far bicubic patches, as rays see them, may be from the truth: this part of the size of their
/// mesh.
inline constexpr float kCurveTolerance = 1.0f / 4000;

/// The bicubic patches of one object as the eye sees them (object space).
struct ShownCurves {
    ObjectId object;
    PatchGrids grids;  // by patch
};

/// The scene made ready for rays: one instance an object, quads as quads, bicubic patches as
/// triangles made once, so that no look from elsewhere changes what light meets.
///
/// Thread: const calls from any number of threads. Keeps a reference to the scene, which must
/// outlive it; set_transform() and its kin follow edits of the scene without touching geometry that
/// stands.
class RayCaster {
public:
    RayCaster(const Scene& scene, int threads, float curve_tolerance = kCurveTolerance);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    /// Nearest hit of each ray; `hits` has the length of `rays`. Rays go in packets of 16. Checks:
    /// every ray is finite (Embree's asserts would end the process, even for an inactive lane).
    void intersect(std::span<const Ray> rays, std::span<Hit> hits,
                   RayKind kind = RayKind::transport) const;

    /// As intersect(), for rays that share an origin or nearly so (a tile of pixels).
    void intersect_coherent(std::span<const Ray> rays, std::span<Hit> hits,
                            RayKind kind = RayKind::transport) const;

    /// What part of light gets along each ray between its t_min and t_max, a colour channel: 0 if
    /// something stops it, else the product of what the blended surfaces in between leave (1 -
    /// alpha) and smooth panes let straight on, each counted once. No chance in it. Both spans are
    /// of one length.
    void transmittance(std::span<const Ray> rays, std::span<Rgb> through) const;

    /// Everything that rays show: the blended surfaces on the way of each, front to back, and what
    /// stops it; also those that lie in one place. No chance in it. Replaces `found`, in the order
    /// of rays.
    void intersect_layers(std::span<const Ray> rays, std::vector<LayerHit>& found,
                          RayKind kind = RayKind::camera) const;

    /// The object's `to_world` has changed: about 0.05 ms, whatever its size. Not while others
    /// cast.
    void set_transform(ObjectId object);

    /// The object's `shown` has changed; no ray meets one that is hidden, also from the start. Not
    /// while others cast.
    void set_shown(ObjectId object);

    /// Objects, and perhaps meshes and materials, were appended to the scene. The eye sees curved
    /// ones as other rays do until show_curves() is called again. Not while others cast.
    void add_objects();

    /// The material has changed: rays may pass surfaces that stopped them, or the other way round.
    /// Not while others cast.
    void set_material(MaterialId material);

    /// From now on rays from the camera see the curves of these objects so, and those of all others
    /// as other rays do. No coarser than these see them. Not while others cast.
    void show_curves(std::vector<ShownCurves> curves);

    /// How far a mesh's bicubic patches, as rays see them, may be from the truth (object space).
    float curve_tolerance(MeshId mesh) const;

    /// How far to start a ray from a surface so that it does not meet it again, at `position`.
    static float offset(Vec3 position);

    /// As above at a point of `object`, whose far corners round more coarsely than `position` may
    /// tell.
    float offset(Vec3 position, ObjectId object) const;

    /// From now on writes down in `log` the packets of intersect(), intersect_coherent() and
    /// transmittance(); null: no longer. Meanwhile one thread alone casts.
    void record(RayLog* log) { log_ = log; }

    const Scene& scene() const { return *scene_; }

private:
    friend double replay(const RayCaster& caster, std::span<const LoggedPacket> packets);

    struct Embree;
    const Scene* scene_;
    std::unique_ptr<Embree> embree_;
    RayLog* log_ = nullptr;
};

}  // namespace chiaro
