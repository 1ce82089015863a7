#include "scene/rail_section.h"

#include "scene/shapes.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr float kUnderside = -0.07f;
constexpr float kEdge = 0.014f;  // radius of the outer upper edge

Vec3 lifted(Vec2 p, float height) {
    return {p.x, height, p.y};
}

}  // namespace

void add_rail(Mesh& mesh, std::span<const RailStation> stations, MaterialId lining,
              MaterialId surface, const Mat4& placement) {
    const auto columns = static_cast<int>(stations.size()) - 1;
    const float length = glm::distance(stations.front().outer, stations.back().outer);
    const auto station = [&](float u) {
        const float at = std::clamp(u, 0.0f, 1.0f) * static_cast<float>(columns);
        const int k = std::min(static_cast<int>(at), columns - 1);
        const float part = u * static_cast<float>(columns) - static_cast<float>(k);
        return RailStation{glm::mix(stations[k].inner, stations[k + 1].inner, part),
                           glm::mix(stations[k].outer, stations[k + 1].outer, part)};
    };
    const auto add_run = [&](int rows, float girth, MaterialId material, const auto& place) {
        Mesh run = sheet(columns, rows, [&](float u, float v) {
            const auto [inner, outer] = station(u);
            return place(inner, outer, glm::normalize(outer - inner), v);
        });
        for (Vec2& uv : run.uvs[0])
            uv = Vec2(stations[0].outer.y + length * uv.x, 0.3f + girth * uv.y);
        add(mesh, run, material, placement);
    };
    const auto mixed = [](float a, float b, float t) { return glm::mix(a, b, t); };
    add_run(1, 0.11f, lining, [&](Vec2 inner, Vec2, Vec2, float v) {
        return lifted(inner, mixed(kUnderside, kRailTop - kRailBevel, v));
    });
    add_run(1, 0.004f, surface, [&](Vec2 inner, Vec2, Vec2 out, float v) {
        return lifted(inner + kRailBevel * v * out, kRailTop - kRailBevel * (1 - v));
    });
    add_run(1, 0.1f, surface, [&](Vec2 inner, Vec2 outer, Vec2 out, float v) {
        return lifted(glm::mix(inner + kRailBevel * out, outer - kEdge * out, v), kRailTop);
    });
    add_run(3, 0.022f, surface, [&](Vec2, Vec2 outer, Vec2 out, float v) {
        const float angle = 0.5f * kPi * v;
        return lifted(outer - kEdge * (1 - std::sin(angle)) * out,
                      kRailTop - kEdge * (1 - std::cos(angle)));
    });
    add_run(1, 0.1f, surface, [&](Vec2, Vec2 outer, Vec2, float v) {
        return lifted(outer, mixed(kRailTop - kEdge, kUnderside, v));
    });
}

}  // namespace chiaro
