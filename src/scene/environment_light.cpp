#include "scene/environment_light.h"

#include "base/error.h"
#include "scene/glass.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro {
namespace {

constexpr int kMostBlocksAcross = 2048;
constexpr int kMostBlocksDown = 1024;  // and one more, as there is of cells
// For maps of up to 16384 pixels a side.
constexpr int kMostBlockWidth = 8;
constexpr int kMostBlockHeight = 16;

// Less light than this altogether is none: densities would be no floats.
constexpr double kLeastLight = 1e-30;

constexpr float kBelowOne = 0x1.fffffep-1f;

int divide_up(int a, int b) {
    return (a + b - 1) / b;
}

// The zenith angle at which a row of cells begins, -1 the first: at the centres of a row of pixels,
// but for the first row and beyond the last.
double zenith_angle_of(int row, int height) {
    return double(kPi) * std::clamp(row + 0.5, 0.0, double(height)) / height;
}

// The part of an interval in which `u` lies, ended by the running sums `ends` of parts of 1, which
// is stretched to [0, 1) for `u`. Parts of no length are not chosen.
std::size_t choose_part(std::span<const float> ends, float& u) {
    const auto found = std::ranges::upper_bound(ends, u);
    const auto part = static_cast<std::size_t>(found - ends.begin());
    const float before = part == 0 ? 0.0f : ends[part - 1];
    u = std::clamp((u - before) / (ends[part] - before), 0.0f, kBelowOne);
    return part;
}

// The same for parts of any sizes, `size_of` of index [0, count): at least one is above 0.
template <typename SizeOf>
int choose_part(int count, const SizeOf& size_of, float& u) {
    if (count == 1) return 0;
    float sum = 0;
    for (int i = 0; i < count; ++i) sum += size_of(i);
    const float target = u * sum;
    float before = 0;
    int chosen = 0;
    for (int i = 0; i < count; ++i) {
        const float size = size_of(i);
        if (!(size > 0)) continue;
        chosen = i;
        u = std::clamp((target - before) / size, 0.0f, kBelowOne);
        if (target < before + size) break;
        before += size;
    }
    return chosen;
}

// Maps `u` to [0, 1] with a density that runs from `a` to `b`, neither below 0.
float sample_linear(float u, float a, float b) {
    const float sum = a + b;
    if (!(sum > 0)) return u;
    const float from = a / sum, to = b / sum;
    return std::min(u / (from + std::sqrt(from * from + u * (to * to - from * from))), 1.0f);
}

// Sums that grow are turned to shares of the last, which is 1. `sums` may all be 0.
void append_shares(std::span<const double> sums, std::vector<float>& ends) {
    const double whole = sums.back() > 0 ? sums.back() : 1;
    for (const double sum : sums) ends.push_back(static_cast<float>(sum / whole));
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Scene& scene)
    : environment_(&scene.environment), frame_(scene.up), empty_(is_dark(scene.environment)) {
    if (!empty_ && environment_->has_map()) build_tables();
}

EnvironmentLight::Corners EnvironmentLight::weights_of(MapCell cell) const {
    const CellCorners c = corners_of(environment_->map, cell);
    return {choice_weight(c.left_top), choice_weight(c.right_top), choice_weight(c.left_bottom),
            choice_weight(c.right_bottom)};
}

// A cell's share is the mean weight in it times its solid angle.
void EnvironmentLight::build_tables() {
    const Image& map = environment_->map;
    const int rows = map.height + 1;  // of cells; row i of them is that of MapCell -1 + i
    block_width_ = divide_up(map.width, kMostBlocksAcross);
    block_height_ = divide_up(map.height, kMostBlocksDown);
    check(block_width_ <= kMostBlockWidth && block_height_ <= kMostBlockHeight,
          "EnvironmentLight: the map is too large");
    blocks_across_ = divide_up(map.width, block_width_);

    for (int row = 0; row < rows; ++row) {
        const double begin = zenith_angle_of(row - 1, map.height);
        const double end = zenith_angle_of(row, map.height);
        const double height = 2 * std::sin(0.5 * (begin + end)) * std::sin(0.5 * (end - begin));
        row_sizes_.push_back(static_cast<float>(2 * double(kPi) / map.width * height));
        row_factors_.push_back(static_cast<float>(height / (end - begin)));
    }

    std::vector<double> down, across(blocks_across_);
    double whole = 0;
    for (int first = 0; first < rows; first += block_height_) {
        std::ranges::fill(across, 0.0);
        for (int row = first; row < std::min(first + block_height_, rows); ++row)
            for (int column = 0; column < map.width; ++column)
                across[column / block_width_] +=
                    0.25 * double(weights_of({column, row - 1}).sum()) * double(row_sizes_[row]);
        for (int i = 1; i < blocks_across_; ++i) across[i] += across[i - 1];
        append_shares(across, column_ends_);
        down.push_back(whole += across.back());
    }
    append_shares(down, row_ends_);
    empty_ = !(whole > kLeastLight);
    for (float& factor : row_factors_) factor = static_cast<float>(factor / whole);
}

// Uses up the part of `u` that chooses: what is left is uniform in the cell.
EnvironmentLight::ChosenCell EnvironmentLight::choose_cell(Vec2& u) const {
    const Image& map = environment_->map;
    const std::size_t block_row = choose_part(row_ends_, u.y);
    const std::size_t block = choose_part(
        std::span(column_ends_).subspan(block_row * blocks_across_, blocks_across_), u.x);
    const int left = static_cast<int>(block) * block_width_;
    const int top = static_cast<int>(block_row) * block_height_ - 1;
    const int width = std::min(block_width_, map.width - left);
    const int height = std::min(block_height_, map.height - top);

    // The weights at all corners of the block's cells, to choose one of these by.
    std::array<std::array<float, kMostBlockWidth + 1>, kMostBlockHeight + 1> weights;
    for (int y = 0; y <= height; ++y)
        for (int x = 0; x <= width; ++x)
            weights[y][x] = choice_weight(
                map.at((left + x) % map.width, std::clamp(top + y, 0, map.height - 1)));
    const auto corners = [&](int x, int y) {
        return Corners{weights[y][x], weights[y][x + 1], weights[y + 1][x], weights[y + 1][x + 1]};
    };
    const auto size_of_row = [&](int y) {
        float sum = 0;
        for (int x = 0; x < width; ++x) sum += corners(x, y).sum();
        return sum * row_sizes_[top + y + 1];
    };
    const int y = choose_part(height, size_of_row, u.y);
    const int x = choose_part(
        width, [&](int i) { return corners(i, y).sum(); }, u.x);
    return {{left + x, top + y}, corners(x, y)};
}

float EnvironmentLight::pdf_of_weight(float weight, int row, float sine) const {
    return weight * row_factors_[row + 1] / std::max(sine, 1e-7f);
}

std::optional<EnvironmentSample> EnvironmentLight::sample_map(Vec2 u) const {
    // A place in the cell, its weight interpolated.
    const Image& map = environment_->map;
    const auto [cell, w] = choose_cell(u);
    Vec2 within;
    within.y = sample_linear(u.y, w.left_top + w.right_top, w.left_bottom + w.right_bottom);
    within.x = sample_linear(u.x, glm::mix(w.left_top, w.left_bottom, within.y),
                             glm::mix(w.right_top, w.right_bottom, within.y));

    const auto begin = static_cast<float>(zenith_angle_of(cell.row, map.height));
    const auto end = static_cast<float>(zenith_angle_of(cell.row + 1, map.height));
    const Vec2 in_map(
        (static_cast<float>(cell.column) + 0.5f + within.x) / static_cast<float>(map.width),
        glm::mix(begin, end, within.y) * (1 / kPi));
    const Vec3 direction = frame_.direction_of(in_map);

    const CellCorners c = corners_of(map, cell);
    const float weight =
        interpolate(w.left_top, w.right_top, w.left_bottom, w.right_bottom, within);
    const float pdf = pdf_of_weight(weight, cell.row, std::sin(in_map.y * kPi));
    if (!(pdf > 0)) return std::nullopt;
    return EnvironmentSample{
        direction, interpolate(c.left_top, c.right_top, c.left_bottom, c.right_bottom, within),
        pdf};
}

std::optional<EnvironmentSample> EnvironmentLight::sample(const LitPlace& place, Vec2 u) const {
    check(!empty_, "EnvironmentLight: nothing to sample");
    if (environment_->has_map()) {
        const auto found = sample_map(u);
        return found && glm::dot(found->direction, place.normal) > 0 ? found : std::nullopt;
    }
    const Vec3 direction = cosine_direction(u);
    if (!(direction.z > 0)) return std::nullopt;
    return EnvironmentSample{Frame(place.normal).to_world(direction), environment_->sky,
                             direction.z * (1 / kPi)};
}

float EnvironmentLight::pdf(const LitPlace& place, Vec3 direction) const {
    if (empty_) return 0;
    if (!environment_->has_map())
        return std::max(0.0f, glm::dot(place.normal, direction)) * (1 / kPi);
    return pdf_of_map(direction);
}

std::optional<EnvironmentSample> EnvironmentLight::sample_anywhere(Vec2 u) const {
    check(!empty_, "EnvironmentLight: nothing to sample");
    if (environment_->has_map()) return sample_map(u);
    const float z = 1 - 2 * u.x, azimuth = 2 * kPi * u.y;
    const float radius = std::sqrt(std::max(0.0f, 1 - z * z));
    return EnvironmentSample{{radius * std::cos(azimuth), radius * std::sin(azimuth), z},
                             environment_->sky,
                             pdf_anywhere({0, 0, 1})};
}

float EnvironmentLight::pdf_anywhere(Vec3 direction) const {
    if (empty_) return 0;
    return environment_->has_map() ? pdf_of_map(direction) : 1 / (4 * kPi);
}

float EnvironmentLight::pdf_of_map(Vec3 direction) const {
    const MapPlace p = place_in(environment_->map, frame_.place_of(direction));
    const Corners w = weights_of(p.cell);
    const float weight =
        interpolate(w.left_top, w.right_top, w.left_bottom, w.right_bottom, p.within);
    return pdf_of_weight(weight, p.cell.row, glm::length(glm::cross(direction, frame_.up)));
}

}  // namespace chiaro
