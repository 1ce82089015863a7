#include "import/cage.h"

#include <map>
#include <tuple>
#include <utility>

namespace chiaro {
namespace {

// Gives equal keys equal numbers, from 0.
template <typename Key>
class Numbers {
public:
    // The number, and whether the key is new.
    std::pair<std::uint32_t, bool> operator()(const Key& key) {
        const auto [known, fresh] =
            numbers_.try_emplace(key, static_cast<std::uint32_t>(numbers_.size()));
        return {known->second, fresh};
    }

private:
    std::map<Key, std::uint32_t> numbers_;
};

}  // namespace

Cage cage_of(const Mesh& mesh) {
    Cage cage;
    cage.name = mesh.name;
    Numbers<std::tuple<float, float, float>> places;
    Numbers<std::tuple<std::uint32_t, float, float>> uvs;
    const auto add_corner = [&](std::uint32_t point) {
        const Vec3 p = mesh.positions[point] + 0.0f;  // -0 becomes 0
        const auto [place, new_place] = places({p.x, p.y, p.z});
        cage.corners.push_back(place);
        if (new_place) {
            cage.positions.push_back(p);
            if (!mesh.colors.empty()) cage.colors.push_back(mesh.colors[point]);
        }
        if (mesh.uvs[0].empty()) return;
        const Vec2 uv = mesh.uvs[0][point];
        const auto [number, new_uv] = uvs({place, uv.x, uv.y});
        cage.uv_corners.push_back(number);
        if (new_uv) cage.uvs.push_back(uv);
    };
    for (const Primitive& primitive : mesh.primitives) {
        for (int c = 0; c < primitive.corner_count(); ++c) add_corner(primitive.corners[c]);
        cage.corner_counts.push_back(static_cast<std::uint32_t>(primitive.corner_count()));
        cage.materials.push_back(primitive.material);
    }
    return cage;
}

}  // namespace chiaro
