// A scene with an update cycle on it, and light read off the picture where it is known.
#pragma once

#include "sample_renderer/tiny_scenes.h"
#include "sample_renderer/truths.h"
#include "update/update_cycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace chiaro::tiny {

/// Cycles of a fixed size, so that the tests give the same bits everywhere.
inline UpdateSettings fixed_size(Scheme scheme, Aov aov = Aov::irradiance) {
    UpdateSettings settings;
    settings.scheme = scheme;
    settings.threads = 2;
    settings.aov = aov;
    settings.fixed_size = true;
    return settings;
}

/// Names the instances of tests that are run by both schemes.
inline std::string scheme_name(const testing::TestParamInfo<Scheme>& which) {
    return which.param == Scheme::best ? "best" : "paper";
}

/// All that an update cycle needs, in the order in which it is made.
struct Studio {
    Scene scene;
    RayCaster rays;
    MeshGraphs graphs;
    AreaLights area_lights;
    OpenSides open_sides;
    std::unique_ptr<SampleRenderer> renderer;
    UpdateCycle cycle;

    Studio(Scene s, const UpdateSettings& settings, Truth by = Truth::path)
        : Studio(std::move(s), settings, by, coarser_levels(settings.scheme)) {}
    Studio(Scene s, const UpdateSettings& settings, Truth by, CoarserLevels levels)
        : scene(std::move(s)),
          rays(scene, settings.threads),
          graphs(scene, levels, settings.threads),
          area_lights(scene),
          open_sides(scene),
          renderer(make_renderer(by, scene, rays, area_lights, &open_sides, settings.threads)),
          cycle(rays, graphs, *renderer, open_sides, settings) {}
    Studio(const Studio&) = delete;
    Studio& operator=(const Studio&) = delete;

    void run(int cycles) {
        for (int i = 0; i < cycles; ++i) cycle.run();
    }
    /// Cycles until so many points are shaded, or a thousand cycles were run.
    void run_to_points(std::size_t points) {
        for (int i = 0; i < 1000 && cycle.statistics().points_shaded < points; ++i) cycle.run();
    }
    std::size_t points() const { return cycle.statistics().points_shaded; }
};

/// A square picture, seen along `forward`, in which a metre on a plane at `distance` from the eye
/// is `pixels_a_metre` pixels. Of odd size, so that the axis runs through a pixel's centre, and so
/// do all points a whole number of pixels from it.
struct SquareView {
    Camera camera;
    int size;
    float scale;

    SquareView(Vec3 eye, Vec3 forward, Vec3 up, float distance, int odd_size, float pixels_a_metre)
        : size(odd_size), scale(pixels_a_metre) {
        const float half_height = 0.5f * static_cast<float>(odd_size) / pixels_a_metre;
        camera.eye = eye;
        camera.target = eye + distance * forward;
        camera.up = up;
        camera.vertical_fov = glm::degrees(2 * std::atan(half_height / distance));
    }
    View view() const { return {camera, size, size}; }

    /// The pixel at `right` and `up` metres from the picture's centre. Checks that it is that
    /// pixel's centre.
    Rgb at(const Image& picture, double right, double up) const {
        const double x = size / 2 + right * scale;
        const double y = size / 2 - up * scale;
        EXPECT_NEAR(x, std::round(x), 1e-4);
        EXPECT_NEAR(y, std::round(y), 1e-4);
        return picture.at(static_cast<int>(std::round(x)), static_cast<int>(std::round(y)));
    }
};

/// Straight down on a floor `height` below the eye, +y up in the picture.
inline SquareView down_on(Vec3 eye, float height, int odd_size, float pixels_a_metre) {
    return {eye, {0, 0, -1}, {0, 1, 0}, height, odd_size, pixels_a_metre};
}

inline Rgb mean_of(const Image& image) {
    glm::dvec3 sum(0);
    for (const Rgb& p : image.pixels) sum += glm::dvec3(p);
    return Rgb(sum / static_cast<double>(image.pixels.size()));
}

}  // namespace chiaro::tiny
