// Whether things are drawn with the chances, and directions with the density, that their sampler
// states.
#pragma once

#include "scene/bsdf_testing.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <span>
#include <string>

namespace chiaro {

/// Cells of the sphere, equal in angle: kRings x 2 kRings.
struct SphereCells {
    static constexpr int kRings = 16;
    static constexpr int kCount = 2 * kRings * kRings;

    static int of(Vec3 w) {
        const double ring = std::acos(double(glm::clamp(w.z, -1.0f, 1.0f))) / kPi * kRings;
        const double step = (std::atan2(double(w.y), double(w.x)) / kPi + 1) * kRings;
        return std::min(int(ring), kRings - 1) * 2 * kRings + std::min(int(step), 2 * kRings - 1);
    }

    // The integral of the density over a cell by steps x steps midpoints.
    template <typename Density>
    static double chance(int cell, const Density& density, int steps) {
        const double size = double(kPi) / kRings, step = size / steps;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double polar = (cell / (2 * kRings)) * size + (i + 0.5) * step;
            for (int k = 0; k < steps; ++k) {
                const double azimuth = (cell % (2 * kRings)) * size + (k + 0.5) * step - kPi;
                sum += density(direction(float(std::cos(polar)), float(azimuth))) *
                       std::sin(polar) * step * step;
            }
        }
        return sum;
    }
};

/// Chi^2 of so many cells passes this once in a million sound programs, or less often, however few
/// they are (Wilson and Hilferty 1931).
inline double chi_squared_bound(int cells) {
    const double spread = 2 / (9.0 * cells);
    return cells * std::pow(1 - spread + 4.9 * std::sqrt(spread), 3);
}

/// Chi^2 of counts against the numbers that are expected, cell by cell; cells of fewer than 10
/// expected together. False alarm below 1e-6.
inline void expect_counts(std::span<const double> counts, std::span<const double> expected,
                          const std::string& name) {
    double chi2 = 0, few_counts = 0, few_expected = 0;
    int cells = 0;
    const auto add = [&](double count, double mean) {
        chi2 += (count - mean) * (count - mean) / std::max(mean, 1.0);
        ++cells;
    };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 10) {
            add(counts[i], expected[i]);
        } else {
            few_counts += counts[i];
            few_expected += expected[i];
        }
    }
    add(few_counts, few_expected);
    EXPECT_LT(chi2, chi_squared_bound(cells)) << name << ", cells " << cells;
}

/// Chi^2 of directions that `draw` gives (none: one more cell) against `density` over solid angle;
/// false alarm below 1e-6. Densities that jump need more `steps` across a cell.
template <typename Density, typename Draw>
void expect_density(const Density& density, const Draw& draw, const std::string& name,
                    int steps = 32) {
    constexpr int kSamples = 60'000, kCells = SphereCells::kCount;
    std::array<double, kCells + 1> counts = {}, expected = {};
    for (int i = 0; i < kSamples; ++i) {
        const std::optional<Vec3> w = draw();
        counts[w ? SphereCells::of(*w) : kCells] += 1;
    }
    double total = 0;
    for (int i = 0; i < kCells; ++i) total += expected[i] = SphereCells::chance(i, density, steps);
    EXPECT_LE(total, 1.001) << name;
    expected[kCells] = std::max(0.0, 1 - total);
    for (double& mean : expected) mean *= kSamples;
    expect_counts(counts, expected, name);
}

}  // namespace chiaro
