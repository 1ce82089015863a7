// A scene that somebody works on: it, and all that follows its edits.
#pragma once

#include "update/make_renderer.h"
#include "update/update_cycle.h"

#include <optional>

namespace chiaro {

struct SessionSettings {
    UpdateSettings update;
    RendererName renderer = RendererName::gather;
    float curve_tolerance = kCurveTolerance;
    int width = 800, height = 600;  // of the picture [pixels]
};

/// Owns the scene, what rays and renderers know of it, and the update loop.
///
/// Thread: one, the update thread.
class Session {
public:
    Session(Scene scene, const Camera& camera, const SessionSettings& settings);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Makes an edit, which the next cycle follows, and returns the one that takes it back. Rigid
    /// motion moves an instance and no geometry; an edit that sets what already is, as an animation
    /// of what rests does, costs nothing. Checks: as chiaro::apply().
    Edit apply(const Edit& edit);

    /// One cycle of the update loop on the scene as it is by now.
    void run();

    int threads() const { return settings_.update.threads; }
    const Scene& scene() const { return scene_; }
    const Camera& camera() const { return camera_; }
    UpdateCycle& cycle() { return *cycle_; }
    const UpdateCycle& cycle() const { return *cycle_; }

private:
    View view() const { return {camera_, settings_.width, settings_.height}; }
    void follow(const Edit& edit, const EditEffect& effect);
    void light_anew(bool lights);
    void begin_anew();

    SessionSettings settings_;
    Scene scene_;
    Camera camera_;
    RayCaster rays_;
    MeshGraphs graphs_;
    OpenSides open_sides_;
    std::optional<AreaLights> area_lights_;
    std::unique_ptr<SampleRenderer> renderer_;
    std::optional<UpdateCycle> cycle_;

    std::vector<EditEffect> effects_;  // of edits that the cycle does not know of yet
    bool looks_elsewhere_ = false;
};

}  // namespace chiaro
