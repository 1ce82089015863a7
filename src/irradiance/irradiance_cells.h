// A lazy hash of surface cells that ends gathered rays: what light falls on a surface, roughly, so
// that a ray need not be traced to its end (design, section 6; the idea of irradiance caching, Ward
// et al. 1988, in world-space cells as Binder et al. 2018 hash them).
#pragma once

#include "base/color.h"
#include "base/ids.h"
#include "base/random.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace chiaro {

/// A cell's place, size and facing in 64 bits; equal keys mean the same cell.
enum class CellKey : std::uint64_t {};
/// Position in the array of cells.
enum class CellId : std::uint32_t { none = 0xffff'ffff };

/// How space is divided. Cells halve in size as rays get shorter, so that a cell never looks
/// large from where it is seen and contacts get small ones.
struct CellGrid {
    static constexpr int kLevels = 8;

    Vec3 origin = Vec3(0);  // its lowest corner, somewhat outside of the scene [scene units]
    float size = 1;         // of the largest cells; others are size / 2^level, level < kLevels

    /// Cells of a level on a unit of length.
    float cells_a_unit(int level) const { return static_cast<float>(1 << level) / size; }
    /// Shortest ray that may end in a cell; shorter ones are to be traced on.
    float shortest() const;
};

/// A grid of cells of 1/60 of the diagonal of a scene's bounds (world space).
CellGrid make_cell_grid(const Box& scene);

/// The level of the cells in which rays of length `distance` should end: not longer than a quarter
/// of the ray, where there are such. Nothing if the ray is too short.
std::optional<int> level_of(const CellGrid& grid, float distance);

/// Where a ray met a surface, and numbers of its own.
struct CellVisit {
    ObjectId object;
    Vec3 position;
    Vec3 normal;  // unit, world, on the side that the ray came from
    Vec3 jitter;  // in [0, 1)^3: moves look-ups by up to half a cell along the surface and tilts
                  // the normal a little, so that the mean of many interpolates between cells
};
/// The cell of a level there. Objects have cells of their own: a curtain's light is not that of the
/// wall behind it. (Of more than 8192, some that touch may share.)
CellKey cell_at(const CellGrid& grid, const CellVisit& visit, int level);

/// What is known of a cell.
struct IrradianceCell {
    CellKey key{};
    Rgb mean = Rgb(0);      // irradiance, from lights and from elsewhere [lux a channel]
    float hits = 0;         // rays that ended here
    double deviations = 0;  // sum of squared deviations of samples' luminance [lux^2]
    std::uint32_t samples = 0;

    /// Of the mean's luminance [lux^2]. Needs two samples.
    double variance() const { return deviations / (double(samples) * (double(samples) - 1)); }
};

/// Some samples of a cell's irradiance together.
struct CellSamples {
    Rgb mean = Rgb(0);
    double deviations = 0;
    std::uint32_t samples = 0;

    void add(Rgb irradiance);
};

/// All cells of a session.
///
/// Thread: find() and cell() from any number at once, while nobody calls the others.
class IrradianceCells {
public:
    static constexpr std::size_t kMostCells = 1 << 22;  // about 100 bytes each

    explicit IrradianceCells(const CellGrid& grid) : grid_(grid), slots_(1024) {}

    const CellGrid& grid() const { return grid_; }
    std::span<const IrradianceCell> cells() const { return cells_; }
    const IrradianceCell& cell(CellId id) const { return cells_[index_of(id)]; }

    CellId find(CellKey key) const;
    /// Bring what find() or cell() will read nearer; they are far away in large tables.
    void prefetch(CellKey key) const { __builtin_prefetch(&slots_[first_slot(key)]); }
    void prefetch(CellId id) const { __builtin_prefetch(&cells_[index_of(id)]); }
    /// The cell of a key, made empty if there is none; none if there are kMostCells.
    CellId find_or_add(CellKey key);
    void count_hits(CellId id, float hits) { cells_[index_of(id)].hits += hits; }
    /// Merges further samples. Checks: samples > 0, finite.
    void store(CellId id, const CellSamples& samples);

    /// True if a cell has samples.
    bool known(CellId id) const { return id != CellId::none && cell(id).samples > 0; }

private:
    // The key once more, so that a look-up reads no cell but its own.
    struct Slot {
        CellKey key{};
        CellId id = CellId::none;
    };
    std::size_t first_slot(CellKey key) const {
        return hash64(static_cast<std::uint64_t>(key)) & (slots_.size() - 1);
    }
    std::size_t slot_of(CellKey key) const;
    void grow();

    CellGrid grid_;
    std::vector<IrradianceCell> cells_;
    std::vector<Slot> slots_;  // open addressing, a power of two, at most half full
};

}  // namespace chiaro
