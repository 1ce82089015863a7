#include "import/flatten_emitters.h"

#include "base/error.h"
#include "import/fault.h"
#include "scene/bicubic_mesh.h"
#include "scene/tessellate.h"

#include <fmt/format.h>

#include <array>
#include <span>

namespace chiaro {
namespace {

// Of all meshes together.
constexpr std::size_t kMostQuads = std::size_t{1} << 22;

template <typename T>
T mixed(const std::vector<T>& values, const std::array<std::uint32_t, 4>& corners, Vec2 at) {
    return glm::mix(glm::mix(values[corners[0]], values[corners[1]], at.x),
                    glm::mix(values[corners[3]], values[corners[2]], at.x), at.y);
}

// Points of one patch's grid, and the quads between them.
void add_grid(Mesh& mesh, const BicubicPatch& patch, const Primitive& primitive,
              const PatchGrids& grids, std::vector<Primitive>& quads) {
    const std::uint32_t columns = grids.grids[0].columns, rows = grids.grids[0].rows;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i) {
            const Vec2 at = Vec2(i, j) / Vec2(columns, rows);
            if (!mesh.normals.empty()) mesh.normals.push_back(patch_normal(patch, at));
            for (auto& uvs : mesh.uvs)
                if (!uvs.empty()) uvs.push_back(mixed(uvs, primitive.corners, at));
            if (!mesh.colors.empty())
                mesh.colors.push_back(mixed(mesh.colors, primitive.corners, at));
        }
    mesh.positions.insert(mesh.positions.end(), grids.points.begin(), grids.points.end());
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t p = first + j * (columns + 1) + i, above = p + columns + 1;
            quads.push_back({{p, p + 1, above + 1, above}, primitive.material});
        }
}

std::size_t flatten(Mesh& mesh, const Scene& scene, std::size_t quads_left) {
    Box box;
    for (const BicubicPatch& patch : mesh.bicubics) box.add(hull(patch));
    const float tolerance = box.diagonal() / 4000;

    std::vector<BicubicPatch> patches;
    std::vector<Primitive> primitives, quads;
    for (std::size_t k = 0; k < mesh.bicubics.size(); ++k) {
        const Primitive primitive = mesh.primitives[k];
        if (!scene.material(primitive.material).emissive()) {
            patches.push_back(mesh.bicubics[k]);
            primitives.push_back(primitive);
            continue;
        }
        // One by one, so that no more than one patch is beyond the limit.
        const PatchGrids grids =
            tessellate(std::span(&mesh.bicubics[k], 1), [&](const Box&) { return tolerance; });
        add_grid(mesh, mesh.bicubics[k], primitive, grids, quads);
        if (quads.size() > quads_left) return quads.size();
    }
    if (quads.empty()) return 0;
    primitives.insert(primitives.end(), quads.begin(), quads.end());
    primitives.insert(primitives.end(),
                      mesh.primitives.begin() + static_cast<std::ptrdiff_t>(mesh.bicubics.size()),
                      mesh.primitives.end());
    mesh.primitives = std::move(primitives);
    mesh.bicubics = std::move(patches);
    order_primitives(mesh);
    return quads.size();
}

}  // namespace

void flatten_emitters(Scene& scene, const std::string& where) {
    std::size_t quads = 0;
    for (Mesh& mesh : scene.meshes) {
        quads += flatten(mesh, scene, kMostQuads - quads);
        if (quads > kMostQuads)
            throw Error(where, fmt::format("the curved lights of object \"{}\" are too many",
                                           printable(mesh.name)));
    }
}

}  // namespace chiaro
