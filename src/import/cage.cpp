#include "import/cage.h"

#include "import/numbers.h"

#include <tuple>

namespace chiaro {

Cage cage_of(const Mesh& mesh) {
    Cage cage;
    cage.name = mesh.name;
    Numbers<std::tuple<float, float, float>> places;
    Numbers<std::tuple<std::uint32_t, float, float>> uvs;
    const auto add_corner = [&](std::uint32_t point) {
        const Vec3 p = mesh.positions[point] + 0.0f;  // -0 becomes 0
        const std::uint32_t place = places({p.x, p.y, p.z});
        cage.corners.push_back(place);
        if (place == cage.positions.size()) {  // new
            cage.positions.push_back(p);
            if (!mesh.colors.empty()) cage.colors.push_back(mesh.colors[point]);
        }
        if (mesh.uvs[0].empty()) return;
        const Vec2 uv = mesh.uvs[0][point];
        const std::uint32_t number = uvs({place, uv.x, uv.y});
        cage.uv_corners.push_back(number);
        if (number == cage.uvs.size()) cage.uvs.push_back(uv);
    };
    for (const Primitive& primitive : mesh.primitives) {
        for (int c = 0; c < primitive.corner_count(); ++c) add_corner(primitive.corners[c]);
        cage.corner_counts.push_back(static_cast<std::uint32_t>(primitive.corner_count()));
        cage.materials.push_back(primitive.material);
    }
    return cage;
}

}  // namespace chiaro
