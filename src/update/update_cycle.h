// The arrows of Figure 2: one cycle selects, shades or subdivides, stores, ages and resolves.
#pragma once

#include "image_generator/seen_view.h"
#include "sample_selector/mesh_front.h"
#include "sample_selector/select_samples.h"
#include "sample_selector/sum_tree.h"
#include "scene/bsdf.h"
#include "shading_cache/age_out.h"
#include "update/expected_change.h"
#include "update/eye_track.h"
#include "update/outdate.h"
#include "update/polish_means.h"
#include "update/scene_change.h"
#include "update/shade_work.h"
#include "update/timings.h"
#include "update/view_change.h"

#include <chrono>
#include <optional>

namespace chiaro {

/// `paper` is sections 3 and 4 as they stand: one joint channel, fixed samples, the difference of
/// the corners. `best` is what measured better (docs/overview.md).
enum class Scheme { best, paper };

/// The levels that a scheme's meshes are to have (MeshGraphs).
inline CoarserLevels coarser_levels(Scheme scheme) {
    return scheme == Scheme::paper ? CoarserLevels::none : CoarserLevels::up_to_a_tenth;
}

struct UpdateSettings {
    Scheme scheme = Scheme::best;
    int threads = 1;
    std::uint64_t seed = 1;
    Aov aov = Aov::radiance;
    std::uint32_t direct_samples = 100;  // paper: of the joint channel, fixed
    std::uint32_t indirect_samples = 400;
    double cycle_seconds = 0.05;          // the length that a cycle adjusts itself to
    double first_picture_seconds = 0.2;   // what the first cycle may spend on shading
    double clean_up_seconds = 0.1;        // in which all that an edit changes is shaded again;
                                          // less, where edits come in every cycle
    float cached_facets = kCachedFacets;  // as RayViewSettings has it
    // Cycles of a fixed size, by assumed costs instead of measured ones: the same bits on any
    // machine.
    bool fixed_size = false;
    AgingSettings aging;
};

struct Statistics {
    std::size_t cycles = 0;
    std::size_t points_shaded = 0;         // evaluations of one channel at one vertex
    std::size_t pixels_seen = 0;           // by one ray each, for maps of views that move
    std::array<std::size_t, 8> samples{};  // a channel
    double seconds = 0;                    // wall time of all cycles
    Timings timings;
};

/// How many times the planned samples a vertex of the first picture may have.
inline constexpr std::uint32_t kMostFirstSamples = 4;

/// The update loop's state. Owns the cache, the ID map and the front of refinement.
///
/// Thread: one, the update thread. Scene, rays, graphs, renderer and open sides must outlive it.
class UpdateCycle {
public:
    /// `graphs` are of the meshes of `rays`' scene; the paper's scheme wants none coarser than
    /// these.
    UpdateCycle(RayCaster& rays, const MeshGraphs& graphs, SampleRenderer& renderer,
                OpenSides& open_sides, const UpdateSettings& settings);

    /// Looks from elsewhere, from the next cycle on. Diffuse shading stays: it does not depend on
    /// the eye. Glossy shading is stale if the eye has moved (5.1).
    void look_from(const View& view);

    /// Edits were made since the last cycle, which change this. Rays, open sides and graphs have
    /// followed; `renderer`, of the scene as it is, shades from now on. What they may have reached
    /// is shaded again, and what they cannot have reached stays (5.2).
    void scene_changed(const SceneChange& change, SampleRenderer& renderer);

    /// A material of the scene, as it is by now, shows light that this cycle has no channel for:
    /// their number is fixed, and another cycle is to be made, which carries on.
    bool lacks_channel() const;

    /// Counts on from another cycle's statistics, as this one takes its place: the clock goes on.
    void carry_on(const Statistics& so_far) { statistics_ = so_far; }

    /// One cycle. The first after look_from() ends with a picture that covers the whole view.
    void run();

    /// The picture as it is now; with `fade`, which has seen the cache as it is, as far as that has
    /// come.
    Image picture(const FadeIn* fade = nullptr);

    const ShadingCache& cache() const { return cache_; }
    const IdMap& id_map() const { return map_; }
    const Statistics& statistics() const { return statistics_; }
    /// Estimates in view of the scene before the last edits, that wait for their turn, when they
    /// were counted last.
    std::size_t stale() const { return stale_.in_view; }
    /// Samples that the last cycle of the paper's scheme selected.
    const std::vector<SelectedPixel>& last_selection() const { return selection_; }
    const PictureScale& scale() const { return gains_.scale; }
    /// Of the cache, the front and the means over what polish shows; not of the map.
    std::size_t bytes() const;

private:
    void renew_map();
    void make_map(ViewQuality quality);
    void see_changes(std::span<const Box> boxes);
    void attach_map();
    RayViewSettings view_settings() const;
    void light_glints(std::uint32_t samples);
    std::vector<std::size_t> glints_to_light(std::uint32_t samples) const;
    double polish_share() const;
    void restart_polish();
    void polish();
    double polish_pixels(std::size_t count);
    void light_surfaces(std::span<const Fragment> fragments, ShadeWork& work);
    void light_pixels(const ChancePass& seen, std::span<Rgb> light);
    void follow_plans();
    ShadeWork new_work() const;
    void note_change();
    bool in_haste() const { return dragged_ && stage_ == Stage::new_view; }
    void judge_buried_again(ShadeWork& work);
    void start();
    void attach_front();
    void dig_out();
    void divide(PatchId patch, int channel, ShadeWork& work);
    void measure_costs();
    void start_channel(int channel, double seconds, ShadeWork& work);
    void evaluate(std::span<const VertexId> vertices, int channel, std::uint32_t samples,
                  ShadeWork& work) const;
    std::vector<VertexId> evaluated_first(const ShadeWork& work, int channel) const;
    double start_seconds() const;
    double seconds_left(double fewest) const;
    double first_picture_share(int channel) const;
    void refine_by_scheme();
    void refine();
    void refine_as_paper();
    bool resample_stale(const Patch& patch, ShadeWork& work) const;
    void shade_or_subdivide(PatchId patch, ShadeWork& work);
    void age();
    void lower_what_changes();
    std::vector<float> age_rates() const;
    double affordable(int channel, double seconds, std::uint32_t samples) const;
    std::vector<float> stale_light(const ShadeWork& work, int channel) const;
    void learn_change(const ShadeWork& work, int channel, std::span<const float> before);
    void choose(ShadeWork& work);
    void spend_by_chance(ShadeWork& work);
    struct Choice {
        int channel = 0;
        PatchId patch = PatchId::none;
        VertexId vertex = VertexId::none;  // of a mesh, if it is no patch
    };
    std::optional<Choice> draw_choice();
    PatchId front_patch_at(std::uint32_t pixel, int channel);
    void spend_on(PatchId patch, int channel, ShadeWork& work);
    void spend_on(VertexId vertex, int channel, ShadeWork& work);
    void resample(VertexId vertex, int channel, std::uint32_t of_new, ShadeWork& work) const;
    void shade(ShadeWork& work);
    float front_gain(PatchId patch, int channel) const;
    bool front_changed(PatchId patch) const;
    enum class Extent { what_changed, everything };
    void carry_down();
    void reckon_roots_round(std::span<const VertexId> vertices, int channel);
    void refresh(Extent extent);
    void reckon_front(int channel, Extent extent);
    void estimate_exposure();
    int threads_at_once() const;
    double work_seconds(const ShadeWork& work) const;
    double seconds_budget() const;
    double refine_seconds() const;

    RayCaster* rays_;
    SampleRenderer* renderer_;
    OpenSides* open_sides_;
    UpdateSettings settings_;
    std::vector<ChannelPlan> plans_;
    ShadingCache cache_;
    IdMap map_;
    ViewQuality map_quality_ = ViewQuality::one_ray;
    std::optional<SeenView> seen_;  // what the map was made of, while objects move in it
    Image unlit_;                   // the map's background without what glints show
    ViewChange view_change_;        // since the map was made
    PolishMeans polish_;
    bool environment_;  // there is one that shines
    std::optional<View> view_;
    enum class Stage { nothing, new_view, covered, refining } stage_ = Stage::nothing;
    bool edited_ = false;              // since the last cycle, so that something may be stale
    bool moving_ = false;              // the scene was, not the camera alone, before the last look
    Cycle edited_at_ = 0;              // cycle before which the scene last was
    Cycle gloss_stale_at_ = 0;         // likewise, or the eye moved
    std::optional<Cycle> changed_at_;  // scene or view, the cycle before which they last were
    bool dragged_ = false;             // and shortly before that: more is to come
    bool hasty_ = false;               // few samples told what is buried, for the time being
    Cycle reconsider_at_ = 0;          // when stale estimates are looked at again
    StaleCount stale_;                 // when they were counted last
    ExpectedChange expected_;          // of these
    EyeTrack eye_track_;
    std::vector<float> gloss_rates_;  // by object: age priorities since the eye moved (5.1)
    double outlines_from_ = 0;  // of statistics_.seconds: when outlines of this view are smoothed

    Rng rng_;
    GainSettings gains_;
    std::vector<SumTree> front_;                    // a channel: gain by patch
    MeshFront mesh_front_;                          // of vertices of meshes
    std::vector<std::pair<PatchId, int>> touched_;  // gains to reckon anew once shaded
    std::vector<std::pair<VertexId, int>> touched_vertices_;
    float cost_learning_ = 0;  // how much a measured cost of a sample counts beside the known one
    std::vector<std::vector<VertexId>> news_;  // a channel: of meshes, not carried down yet
    std::size_t points_since_carry_ = 0;
    std::size_t vertices_carried_ = 0;  // when values were carried down last
    std::size_t points_since_refresh_ = 0;
    std::size_t points_at_exposure_ = 0;
    double paper_sample_count_ = 70;
    double polish_credit_ = 0;  // processor seconds that passes over polish may take now
    double seconds_a_polished_pixel_;
    double seconds_a_glint_sample_ = 1e-6;  // of a processor
    double overrun_ = 1;  // processor seconds of a start over those that its samples should take
    std::chrono::steady_clock::time_point cycle_start_;
    std::vector<SelectedPixel> selection_;
    Statistics statistics_;
};

}  // namespace chiaro
