#include "irradiance/irradiance_cells.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace chiaro {
namespace {

constexpr float kCellsAcross = 60;

// A ray must be this many times as long as the cell in which it ends.
constexpr float kLengthOverSize = 4;

// How far jitter tilts a normal: cells that face apart blend over about this part of a right angle.
constexpr float kTilt = 0.2f;

// Cells are numbered from the grid's corner, which lies this many of them outside of the scene, so
// that jitter never leads below zero.
constexpr int kMargin = 2;
constexpr int kBitsAnAxis = 15;
constexpr int kObjectBits = 13;
static_assert((1 << kBitsAnAxis) > (static_cast<int>(kCellsAcross) + 2 * kMargin)
                                       << CellGrid::kLevels);

// The axis that a normal is nearest to, and its sign: 0 to 5.
std::uint64_t facing(Vec3 n) {
    const Vec3 a = glm::abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return static_cast<std::uint64_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

// The power of two just below a normal number above 0; std::ilogb() is a call.
int exponent_of(float x) {
    return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127;
}

}  // namespace

float CellGrid::shortest() const {
    return kLengthOverSize * std::ldexp(size, 1 - kLevels);
}

CellGrid make_cell_grid(const Box& scene) {
    const float size = std::max(scene.diagonal(), 1e-30f) / kCellsAcross;
    return {scene.low - kMargin * size, size};
}

std::optional<int> level_of(const CellGrid& grid, float distance) {
    if (!(distance >= grid.shortest())) return std::nullopt;
    const int halvings = exponent_of(kLengthOverSize * grid.size / distance) + 1;
    return std::clamp(halvings, 0, CellGrid::kLevels - 1);
}

CellKey cell_at(const CellGrid& grid, const CellVisit& visit, int level) {
    const Vec3 shift = visit.jitter - 0.5f;
    const Vec3 along = shift - glm::dot(shift, visit.normal) * visit.normal;
    const Vec3 place = grid.cells_a_unit(level) * (visit.position - grid.origin) + along;
    constexpr float kLast = (1 << kBitsAnAxis) - 1;
    std::uint64_t key = index_of(visit.object) & ((1 << kObjectBits) - 1);
    key = key << 3 | facing(visit.normal + kTilt * Vec3(shift.y, shift.z, shift.x));
    key = key << 3 | static_cast<std::uint64_t>(level);
    for (int axis = 0; axis < 3; ++axis)
        key = key << kBitsAnAxis |
              static_cast<std::uint64_t>(std::clamp(std::floor(place[axis]), 0.0f, kLast));
    return CellKey{key};
}

void CellSamples::add(Rgb irradiance) {
    ++samples;
    const float before = luminance(mean);
    mean += (irradiance - mean) / static_cast<float>(samples);
    deviations +=
        double(luminance(irradiance) - before) * (luminance(irradiance) - luminance(mean));
}

std::size_t IrradianceCells::slot_of(CellKey key) const {
    for (std::size_t i = first_slot(key);; i = (i + 1) & (slots_.size() - 1))
        if (slots_[i].id == CellId::none || slots_[i].key == key) return i;
}

CellId IrradianceCells::find(CellKey key) const {
    return slots_[slot_of(key)].id;
}

CellId IrradianceCells::find_or_add(CellKey key) {
    if (2 * (cells_.size() + 1) > slots_.size()) grow();
    Slot& slot = slots_[slot_of(key)];
    if (slot.id != CellId::none || cells_.size() == kMostCells) return slot.id;
    slot = {key, static_cast<CellId>(cells_.size())};
    cells_.push_back({});
    cells_.back().key = key;
    return slot.id;
}

void IrradianceCells::grow() {
    slots_.assign(2 * slots_.size(), Slot{});
    for (std::size_t i = 0; i < cells_.size(); ++i)
        slots_[slot_of(cells_[i].key)] = {cells_[i].key, static_cast<CellId>(i)};
}

void IrradianceCells::store(CellId id, const CellSamples& added) {
    check(added.samples > 0 && is_finite(added.mean) && std::isfinite(added.deviations),
          "IrradianceCells: samples are not usable");
    IrradianceCell& c = cells_[index_of(id)];
    // Two sets' deviations add, with those between their means (Chan et al. 1979).
    const double before = c.samples, more = added.samples;
    const double apart = luminance(added.mean) - luminance(c.mean);
    c.deviations += added.deviations + apart * apart * before * more / (before + more);
    c.mean += (added.mean - c.mean) * static_cast<float>(more / (before + more));
    c.samples += added.samples;
}

}  // namespace chiaro
