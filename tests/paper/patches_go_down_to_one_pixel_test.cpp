// 3.1: "Patches with more sample requests are subdivided faster than others until eventually all
// patches project to one pixel in the image plane."
#include "sample_renderer/tiny_scenes.h"
#include "update/update_cycle.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// In place of a renderer, a function of place: a shadow's edge at x = 0.3.
class ShadowEdge : public SampleRenderer {
public:
    explicit ShadowEdge(const Scene& scene) : scene_(&scene) {}
    SampleCosts typical_costs() const override { return {1e-7f, 1e-6f}; }
    void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) override {
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const Vec3 p = surface_geometry(*scene_, requests[i].where).position;
            results[i] = {.mean = Rgb(p.x < 0.3f ? 1.0f : 100.0f)};
        }
        points += requests.size();
    }
    std::size_t points = 0;

private:
    const Scene* scene_;
};

// A wall that fills a view of `size` x `size`, refined by the paper's scheme.
struct Refining {
    Scene scene;
    RayCaster caster;
    MeshGraphs graphs;
    OpenSides open_sides;
    ShadowEdge renderer;
    UpdateCycle update;

    explicit Refining(int size)
        : scene(make_scene()),
          caster(scene, 1),
          graphs(scene, CoarserLevels::none, 1),
          open_sides(scene),
          renderer(scene),
          update(caster, graphs, renderer, open_sides, settings()) {
        update.look_from(
            View({.eye = {0, 0, 1}, .target = Vec3(0), .vertical_fov = 90}, size, size));
    }
    Refining(const Refining&) = delete;
    Refining& operator=(const Refining&) = delete;

    static Scene make_scene() {
        Scene scene;
        tiny::add_quad(scene, {-1.5f, -1.5f, 0}, {3, 0, 0}, {0, 3, 0},
                       tiny::add_material(scene, Rgb(0.5f)));
        return scene;
    }
    static UpdateSettings settings() {
        UpdateSettings s;
        s.scheme = Scheme::paper;
        s.fixed_size = true;
        return s;
    }
    // Fragments on the fullest leaf.
    std::uint32_t fullest_leaf() const {
        std::uint32_t most = 0;
        for (const Patch& p : update.cache().patches())
            if (p.is_leaf()) most = std::max(most, p.fragment_count);
        return most;
    }
};

// In the end every patch in view covers one pixel, and none is divided further: at most 24 x 24
// leaves with a fragment, all dividing patches having had more than one.
TEST(PaperSubdivision, GoesDownToOnePixelAndNoFurther) {
    Refining r(24);
    for (int cycle = 0; cycle < 4000 && (cycle < 2 || r.fullest_leaf() > 1); ++cycle)
        r.update.run();
    EXPECT_EQ(r.fullest_leaf(), 1u);
    for (const Patch& p : r.update.cache().patches())
        if (!p.is_leaf()) {
            EXPECT_GT(p.fragment_count, 1u);
        }
    const std::size_t patches = r.update.cache().patches().size();
    const std::size_t points = r.renderer.points;
    for (int cycle = 0; cycle < 200; ++cycle) r.update.run();
    EXPECT_EQ(r.update.cache().patches().size(), patches);
    EXPECT_LT(r.renderer.points, points + 4 * patches);  // and what is known is not shaded again
}

// Patches at the edge, of higher priority, are divided sooner: when the mesh has 400 leaves
// in view, those at the edge are smaller than those away from it.
TEST(PaperSubdivision, IsFasterAtADiscontinuity) {
    Refining r(128);
    const auto leaves_in_view = [&] {
        int count = 0;
        for (const Patch& p : r.update.cache().patches())
            count += p.is_leaf() && p.fragment_count > 0 ? 1 : 0;
        return count;
    };
    for (int cycle = 0; cycle < 1000 && leaves_in_view() < 400; ++cycle) r.update.run();
    double at_edge = 0, away = 0, at_edge_count = 0, away_count = 0;
    for (const Fragment& f : r.update.id_map().fragments) {
        const float x = -1.5f + 3 * r.update.cache().surface_uv(f.patch, f.local).x;
        const double level = r.update.cache().patch(f.patch).level;
        const bool near = std::abs(x - 0.3f) < 0.1f;
        (near ? at_edge : away) += level;
        (near ? at_edge_count : away_count) += 1;
    }
    ASSERT_GT(at_edge_count, 0);
    EXPECT_GT(at_edge / at_edge_count, away / away_count + 0.25);
}

}  // namespace
}  // namespace chiaro
