#include "import/gltf_mesh.h"

#include "base/error.h"
#include "import/directions.h"
#include "import/fault.h"
#include "import/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace chiaro {
namespace {

using tinygltf::Accessor;
using tinygltf::Primitive;

constexpr std::array kAttributes = {"POSITION", "NORMAL", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};
enum Attribute { position, normal, texcoord_0, texcoord_1, color, attribute_count };

// Accessors of the attributes that we read; -1 where there is none.
using Layout = std::array<int, attribute_count>;

Layout layout_of(const Primitive& primitive) {
    Layout layout;
    for (std::size_t i = 0; i < layout.size(); ++i) {
        const auto found = primitive.attributes.find(kAttributes[i]);
        layout[i] = found == primitive.attributes.end() ? -1 : found->second;
    }
    return layout;
}

const Accessor& accessor_at(const GltfDocument& document, int index) {
    return document.model().accessors[static_cast<std::size_t>(index)];
}

// glTF 2.0, 3.7.2.1, and KHR_mesh_quantization, which adds integers of 8 and 16 bits.
bool format_allowed(const Accessor& accessor, std::size_t attribute, bool quantized) {
    const int type = accessor.type, component = accessor.componentType;
    const bool vec3 = type == TINYGLTF_TYPE_VEC3;
    const bool right_type = attribute <= normal               ? vec3
                            : attribute == std::size_t{color} ? vec3 || type == TINYGLTF_TYPE_VEC4
                                                              : type == TINYGLTF_TYPE_VEC2;
    const bool is_unsigned = component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                             component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    const bool is_signed =
        component == TINYGLTF_COMPONENT_TYPE_BYTE || component == TINYGLTF_COMPONENT_TYPE_SHORT;
    const bool plain = component == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                       (attribute > normal && is_unsigned && accessor.normalized);
    const bool extended = attribute == normal               ? is_signed && accessor.normalized
                          : attribute == std::size_t{color} ? false
                                                            : is_signed || is_unsigned;
    return right_type && (plain || (quantized && extended));
}

void check_attributes(const GltfDocument& document, const Primitive& primitive,
                      const std::string& where) {
    const auto& used = document.model().extensionsUsed;
    const bool quantized = std::ranges::find(used, "KHR_mesh_quantization") != used.end();
    const Layout layout = layout_of(primitive);
    for (std::size_t i = 0; i < layout.size(); ++i) {
        if (layout[i] < 0) continue;
        const bool known = document.accessor_known(static_cast<std::size_t>(layout[i]));
        if (!known || !format_allowed(accessor_at(document, layout[i]), i, quantized))
            throw Error(fmt::format("{}.attributes.{}", where, kAttributes[i]),
                        fmt::format("accessors[{}] has a format that it may not have", layout[i]));
    }
    const std::size_t count = accessor_at(document, primitive.attributes.begin()->second).count;
    for (const auto& [name, accessor] : primitive.attributes)
        if (accessor_at(document, accessor).count != count)
            throw Error(fmt::format("{}.attributes.{}", where, printable(name)),
                        "has another count than the other attributes");
}

void check_indices(const GltfDocument& document, const Primitive& primitive,
                   const std::string& where) {
    if (primitive.indices < 0) return;
    const Accessor& accessor = accessor_at(document, primitive.indices);
    const int component = accessor.componentType;
    const bool integers = component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !integers || accessor.normalized ||
        !document.accessor_known(static_cast<std::size_t>(primitive.indices)))
        throw Error(where + ".indices", "are not unsigned integers");
}

// The value of an index type that would begin a new strip, which glTF does not allow.
std::uint32_t restart_value(const Accessor& accessor) {
    return accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 0xff
           : accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 0xffff
                                                                              : 0xffff'ffff;
}

class MeshReader {
public:
    MeshReader(const GltfDocument& document, std::size_t index, GltfMaterials& materials,
               GltfMeshCounts& counts)
        : document_(document), index_(index), materials_(materials), counts_(counts) {}

    Mesh read() {
        const tinygltf::Mesh& source = document_.model().meshes[index_];
        mesh_.name = source.name;
        for (const Primitive& primitive : source.primitives)
            if (readable(primitive)) note_layout(layout_of(primitive));
        for (std::size_t i = 0; i < source.primitives.size(); ++i) {
            where_ = document_.where(fmt::format("meshes[{}].primitives[{}]", index_, i));
            if (readable(source.primitives[i])) add(source.primitives[i]);
        }
        return std::move(mesh_);
    }

private:
    bool readable(const Primitive& primitive) {
        counts_.has_morph_targets |= !primitive.targets.empty();
        const bool triangles = primitive.mode >= TINYGLTF_MODE_TRIANGLES;
        counts_.has_points_or_lines |= !triangles;
        return triangles && primitive.attributes.contains("POSITION");
    }

    // A mesh has an array as soon as one of its primitives has the attribute.
    void note_layout(const Layout& layout) {
        has_normals_ |= layout[normal] >= 0;
        has_uvs_[0] |= layout[texcoord_0] >= 0;
        has_uvs_[1] |= layout[texcoord_1] >= 0;
        has_colors_ |= layout[color] >= 0;
    }

    void add(const Primitive& primitive) {
        const Layout layout = layout_of(primitive);
        const std::size_t count = accessor_at(document_, layout[position]).count;
        const std::uint32_t base = points_of(layout, count);
        const MaterialId material = materials_.get(primitive.material);
        const std::vector<std::uint32_t> corners = corners_of(primitive, count);
        const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
            add_triangle({base + corners[a], base + corners[b], base + corners[c]}, material);
        };
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
            counts_.has_loose_indices |= corners.size() % 3 != 0;
            for (std::size_t i = 0; i + 2 < corners.size(); i += 3) triangle(i, i + 1, i + 2);
        } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            for (std::size_t i = 0; i + 2 < corners.size(); ++i)
                triangle(i, i + 1 + i % 2, i + 2 - i % 2);
        } else {
            for (std::size_t i = 1; i + 1 < corners.size(); ++i) triangle(i, i + 1, 0);
        }
    }

    // Primitives that name the same accessors share their points.
    std::uint32_t points_of(const Layout& layout, std::size_t count) {
        const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto [known, fresh] = known_.try_emplace(layout, base);
        if (!fresh) return known->second;
        counts_.points += count;
        if (counts_.points > kMaxMeshElements)
            throw Error(where_, fmt::format("the scene has more than {} points", kMaxMeshElements));
        append(mesh_.positions, layout[position], count, Vec3(0));
        if (has_normals_) append(mesh_.normals, layout[normal], count, Vec3(0));
        for (std::size_t set = 0; set < 2; ++set)
            if (has_uvs_[set]) append(mesh_.uvs[set], layout[texcoord_0 + set], count, Vec2(0));
        if (has_colors_) append(mesh_.colors, layout[color], count, Vec4(1));
        for (std::size_t i = base; i < mesh_.normals.size(); ++i)
            mesh_.normals[i] = unit_or_zero(mesh_.normals[i]);
        for (std::size_t i = base; i < mesh_.colors.size(); ++i)
            mesh_.colors[i] = glm::clamp(mesh_.colors[i], 0.0f, 1.0f);
        return base;
    }

    // Appends the accessor's elements; what they lack, and all if there is no accessor, is that of
    // `fallback` (the alpha of a colour without one).
    template <int n>
    void append(std::vector<glm::vec<n, float>>& points, int accessor, std::size_t count,
                glm::vec<n, float> fallback) const {
        const std::size_t base = points.size();
        points.resize(base + count, fallback);
        if (accessor < 0) return;
        const std::vector<float> numbers = read_floats(document_, accessor);
        const std::size_t components = component_count(accessor_at(document_, accessor));
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < std::min<std::size_t>(components, n); ++c)
                points[base + i][static_cast<int>(c)] = numbers[i * components + c];
    }

    std::vector<std::uint32_t> corners_of(const Primitive& primitive, std::size_t count) const {
        std::vector<std::uint32_t> corners;
        if (primitive.indices < 0) {
            corners.resize(count);
            for (std::size_t i = 0; i < count; ++i) corners[i] = static_cast<std::uint32_t>(i);
            return corners;
        }
        corners = read_indices(document_, primitive.indices);
        const std::uint32_t restart = restart_value(accessor_at(document_, primitive.indices));
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (corners[i] == restart)
                throw Error(where_ + ".indices", fmt::format("index {} restarts the primitive", i));
            if (corners[i] >= count)
                throw Error(where_ + ".indices",
                            fmt::format("index {} names point {} of {}", i, corners[i], count));
        }
        return corners;
    }

    void add_triangle(std::array<std::uint32_t, 3> corners, MaterialId material) {
        if (++counts_.triangles > kMaxMeshElements)
            throw Error(where_,
                        fmt::format("the scene has more than {} triangles", kMaxMeshElements));
        if (has_normals_) give_normals(corners);
        mesh_.primitives.push_back(
            {{corners[0], corners[1], corners[2], chiaro::Primitive::kNoCorner}, material});
    }

    // A corner without a normal becomes a point of its own with that of the triangle.
    void give_normals(std::array<std::uint32_t, 3>& corners) {
        const auto& p = mesh_.positions;
        const auto face_normal = [&] {
            const std::array triangle = {p[corners[0]], p[corners[1]], p[corners[2]]};
            const Vec3 n = unit_or_zero(vector_area(triangle));
            return n == Vec3(0) ? Vec3(0, 0, 1) : n;
        };
        for (std::uint32_t& corner : corners) {
            if (mesh_.normals[corner] != Vec3(0)) continue;
            const Vec3 n = face_normal();
            const auto fresh = static_cast<std::uint32_t>(mesh_.positions.size());
            mesh_.positions.push_back(Vec3(mesh_.positions[corner]));
            mesh_.normals.push_back(n);
            for (std::size_t set = 0; set < 2; ++set)
                if (has_uvs_[set]) mesh_.uvs[set].push_back(Vec2(mesh_.uvs[set][corner]));
            if (has_colors_) mesh_.colors.push_back(Vec4(mesh_.colors[corner]));
            corner = fresh;
        }
    }

    const GltfDocument& document_;
    std::size_t index_;
    GltfMaterials& materials_;
    GltfMeshCounts& counts_;
    Mesh mesh_;
    std::string where_;
    bool has_normals_ = false, has_colors_ = false;
    std::array<bool, 2> has_uvs_ = {};
    std::map<Layout, std::uint32_t> known_;  // the first point of each layout
};

}  // namespace

void check_primitives(const GltfDocument& document) {
    const std::vector<tinygltf::Mesh>& meshes = document.model().meshes;
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (std::size_t i = 0; i < meshes[m].primitives.size(); ++i) {
            const std::string where =
                document.where(fmt::format("meshes[{}].primitives[{}]", m, i));
            check_attributes(document, meshes[m].primitives[i], where);
            check_indices(document, meshes[m].primitives[i], where);
        }
}

Mesh read_mesh(const GltfDocument& document, std::size_t index, GltfMaterials& materials,
               GltfMeshCounts& counts) {
    return MeshReader(document, index, materials, counts).read();
}

}  // namespace chiaro
