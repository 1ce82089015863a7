#include "scene/environment.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// The horizontal direction nearest to `axis`, and how far from the vertical that is.
Vec3 made_level(Vec3 axis, Vec3 up) {
    return axis - glm::dot(axis, up) * up;
}

}  // namespace

bool is_dark(const Environment& environment) {
    if (!environment.has_map()) return !(max_component(environment.sky) > 0);
    const auto black = [](const Rgb& pixel) { return !(max_component(pixel) > 0); };
    return std::ranges::all_of(environment.map.pixels, black);
}

Rgb mean_radiance(const Environment& environment) {
    if (!environment.has_map()) return environment.sky;
    const Image& map = environment.map;
    glm::dvec3 sum(0);
    double size = 0;
    for (int y = 0; y < map.height; ++y) {
        const double sine = std::sin(double(kPi) * (y + 0.5) / map.height);
        for (int x = 0; x < map.width; ++x) sum += sine * glm::dvec3(map.at(x, y));
        size += sine * map.width;
    }
    return Rgb(sum / size);
}

EnvironmentFrame::EnvironmentFrame(Vec3 vertical) : up(glm::normalize(vertical)) {
    middle = made_level({1, 0, 0}, up);
    if (!(glm::length(middle) > 1e-3f)) middle = made_level({0, 1, 0}, up);
    middle = glm::normalize(middle);
    right = glm::cross(middle, up);
}

Vec2 EnvironmentFrame::place_of(Vec3 direction) const {
    const float ahead = glm::dot(direction, middle), aside = glm::dot(direction, right);
    const float height = glm::dot(direction, up);
    // By two arctangents: arccosines are inexact near the poles.
    const float zenith_angle = std::atan2(std::sqrt(ahead * ahead + aside * aside), height);
    return {0.5f + std::atan2(aside, ahead) * (0.5f / kPi), zenith_angle * (1 / kPi)};
}

Vec3 EnvironmentFrame::direction_of(Vec2 place) const {
    const float azimuth = 2 * kPi * (place.x - 0.5f), zenith_angle = kPi * place.y;
    const float across = std::sin(zenith_angle);
    return across * (std::cos(azimuth) * middle + std::sin(azimuth) * right) +
           std::cos(zenith_angle) * up;
}

MapPlace place_in(const Image& map, Vec2 place) {
    const float x = place.x * static_cast<float>(map.width) - 0.5f;
    const float y = place.y * static_cast<float>(map.height) - 0.5f;
    const MapCell cell = {std::clamp(static_cast<int>(std::floor(x)), -1, map.width - 1),
                          std::clamp(static_cast<int>(std::floor(y)), -1, map.height - 1)};
    const Vec2 within(x - static_cast<float>(cell.column), y - static_cast<float>(cell.row));
    return {cell, glm::clamp(within, Vec2(0), Vec2(1))};
}

CellCorners corners_of(const Image& map, MapCell cell) {
    const int left = cell.column < 0 ? map.width - 1 : cell.column;
    const int right = cell.column + 1 < map.width ? cell.column + 1 : 0;
    const int top = std::max(cell.row, 0);
    const int bottom = std::min(cell.row + 1, map.height - 1);
    return {map.at(left, top), map.at(right, top), map.at(left, bottom), map.at(right, bottom)};
}

Rgb radiance_from(const Environment& environment, const EnvironmentFrame& frame, Vec3 direction) {
    if (!environment.has_map()) return environment.sky;
    const MapPlace place = place_in(environment.map, frame.place_of(direction));
    const CellCorners c = corners_of(environment.map, place.cell);
    return interpolate(c.left_top, c.right_top, c.left_bottom, c.right_bottom, place.within);
}

}  // namespace chiaro
