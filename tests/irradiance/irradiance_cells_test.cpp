// The lazy hash of surface cells: which cell a ray ends in, and what a cell remembers.
#include "irradiance/irradiance_cells.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace chiaro {
namespace {

constexpr Vec3 kMiddle = Vec3(0.5f);
const Vec3 kUp(0, 0, 1);
constexpr auto kObject = static_cast<ObjectId>(7);

// A scene whose diagonal is 60: the largest cells are 1 across.
CellGrid unit_grid() {
    const float side = 60 / std::sqrt(3.0f);
    return make_cell_grid({Vec3(0), Vec3(side)});
}

// The cell in which a ray of length `distance` should end.
CellKey cell_for(const CellGrid& grid, ObjectId object, Vec3 position, Vec3 normal, float distance,
                 Vec3 jitter) {
    return cell_at(grid, {object, position, normal, jitter}, *level_of(grid, distance));
}

// Cells are 1/60 of the diagonal and halve with the ray's length: never more than a
// quarter of it.
TEST(CellAt, CellsAreSmallFromWhereTheyAreSeen) {
    const CellGrid grid = unit_grid();
    EXPECT_NEAR(grid.size, 1, 1e-5f);
    EXPECT_NEAR(grid.shortest(), 4.0f / 128, 1e-6f);
    for (const float distance : {0.04f, 0.1f, 0.7f, 3.9f, 4.1f, 100.0f}) {
        std::set<CellKey> along;  // cells met along a line of length 8
        for (int i = 0; i < 80'000; ++i)
            along.insert(cell_for(grid, kObject, {1 + 1e-4f * static_cast<float>(i), 5.3f, 5.2f},
                                  kUp, distance, kMiddle));
        const double size = 8.0 / static_cast<double>(along.size() - 1);
        EXPECT_LE(size, std::min(1.0f, distance / 4) * 1.15) << distance;
        EXPECT_GE(size, std::min(1.0f, distance / 4) / 2.3) << distance;
    }
    EXPECT_FALSE(level_of(grid, 0.9f * grid.shortest()).has_value());
    EXPECT_FALSE(level_of(grid, std::nanf("")).has_value());
}

// The six directions that a surface may face are kept apart, so that no light goes through a wall.
TEST(CellAt, SidesOfAWallAreApart) {
    const CellGrid grid = unit_grid();
    std::set<CellKey> keys;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            Vec3 normal(0);
            normal[axis] = sign;
            for (int i = 0; i < 100; ++i) {
                Rng rng(static_cast<std::uint64_t>(i));
                const Vec3 jitter(rng.uniform(), rng.uniform(), rng.uniform());
                const Vec3 along = Vec3(0.5f) - glm::abs(normal) * 0.5f;
                const Vec3 at = glm::floor((Vec3(10) - grid.origin)) + grid.origin + 0.5f;
                keys.insert(
                    cell_for(grid, kObject, at, normal, 100, glm::mix(kMiddle, jitter, along)));
            }
        }
    // Jitter may lead into neighbours, of which there are 9 on each side.
    EXPECT_GE(keys.size(), 6u);
    EXPECT_LE(keys.size(), 6u * 9);
    std::set<std::uint64_t> facings;
    for (const CellKey key : keys)
        facings.insert(static_cast<std::uint64_t>(key) / (1ULL << 48) % 8);
    EXPECT_EQ(facings.size(), 6u);
}

// A curtain and the wall behind it share no cell.
TEST(CellAt, ObjectsAreApart) {
    const CellGrid grid = unit_grid();
    const auto other = static_cast<ObjectId>(8);
    EXPECT_NE(cell_for(grid, kObject, Vec3(5), kUp, 100, kMiddle),
              cell_for(grid, other, Vec3(5), kUp, 100, kMiddle));
}

// Jitter moves along the surface, not off it: a flat floor is one layer of cells.
TEST(CellAt, JitterStaysOnTheSurface) {
    const CellGrid grid = unit_grid();
    const float height = std::floor(5 - grid.origin.z) + grid.origin.z + 0.01f;
    Rng rng(3);
    std::set<std::uint64_t> layers;
    for (int i = 0; i < 10'000; ++i) {
        const Vec3 at(30 * rng.uniform(), 30 * rng.uniform(), height);
        const Vec3 jitter(rng.uniform(), rng.uniform(), rng.uniform());
        layers.insert(static_cast<std::uint64_t>(cell_for(grid, kObject, at, kUp, 100, jitter)) &
                      0x7fff);
    }
    EXPECT_EQ(layers.size(), 1u);
}

// A place that lies on the border of cells is theirs in equal parts: 500 of 1000, give or take 6
// standard deviations of 16 (false alarm 2e-9).
TEST(CellAt, JitterBlendsNeighbours) {
    const CellGrid grid = unit_grid();
    const float border = std::floor(5 - grid.origin.x) + grid.origin.x;
    Rng rng(4);
    std::map<CellKey, int> counts;
    for (int i = 0; i < 1000; ++i)
        ++counts[cell_for(grid, kObject, {border, 5.2f, 5.2f}, kUp, 100,
                          {rng.uniform(), 0.5f, 0.5f})];
    ASSERT_EQ(counts.size(), 2u);
    EXPECT_NEAR(counts.begin()->second, 500, 96);
}

// Ids are found again, by a thousand keys, and none by keys that were never added.
TEST(IrradianceCells, FindsWhatWasAdded) {
    IrradianceCells cells(unit_grid());
    EXPECT_EQ(cells.find(CellKey{5}), CellId::none);
    for (std::uint64_t k = 0; k < 5000; ++k)
        EXPECT_EQ(cells.find_or_add(CellKey{k * 0x10001}), static_cast<CellId>(k));
    for (std::uint64_t k = 0; k < 5000; ++k) {
        EXPECT_EQ(cells.find(CellKey{k * 0x10001}), static_cast<CellId>(k));
        EXPECT_EQ(cells.find_or_add(CellKey{k * 0x10001}), static_cast<CellId>(k));
        EXPECT_EQ(cells.find(CellKey{k * 0x10001 + 1}), CellId::none);
    }
    EXPECT_EQ(cells.cells().size(), 5000u);
}

// Samples in parts give the mean and variance of all at once.
TEST(IrradianceCells, MergesMeansAndVariances) {
    IrradianceCells cells(unit_grid());
    const CellId id = cells.find_or_add(CellKey{1});
    Rng rng(5);
    double sum = 0, squares = 0;
    for (const int part : {16, 16, 32, 64}) {
        CellSamples samples;
        for (int i = 0; i < part; ++i) {
            const float x = 100 + 10 * rng.uniform();
            samples.add(Rgb(x));
            sum += x;
            squares += double(x) * x;
        }
        cells.store(id, samples);
    }
    const double mean = sum / 128;
    EXPECT_EQ(cells.cell(id).samples, 128u);
    EXPECT_NEAR(luminance(cells.cell(id).mean), mean, 1e-3);
    EXPECT_NEAR(cells.cell(id).variance() / ((squares - 128 * mean * mean) / (128.0 * 127)), 1,
                1e-2);
}

}  // namespace
}  // namespace chiaro
