// Cells of irradiance in which rays end: what a ray finds there, and how those that were asked for
// are filled.
#pragma once

#include "irradiance/irradiance_cells.h"
#include "sample_renderer/indirect_light.h"

namespace chiaro {

/// Where a ray ends.
struct CellFound {
    CellId ends_in = CellId::none;  // the finest that is known, of those that it may end in
    CellKey wants{};                // what is to be known next, or known better
};
/// The cells in which paths that met surfaces end: one that is not known gives way to that twice as
/// long. Returns the lanes that there are cells for, known or not: rays are not too short for any.
std::uint32_t find_cells(const IrradianceCells& cells, const Meetings& meetings,
                         std::span<CellFound, kLanes> found);

/// A ray that asked for a cell, and where it met the surface.
struct Asking {
    CellKey key;
    float rays;  // that it stands for
    Receiver place;
    CellId cell = CellId::none;  // once it is known
};

/// Counts what was asked for and gives the cells that have earned them more samples, from the
/// places that rays met: the same bits on any number of threads. `aims` may be null.
void fill_cells(const LitScene& lit, const Aims* aims, int threads, std::uint32_t seed,
                IrradianceCells& cells, std::vector<Asking>& asking);

}  // namespace chiaro
