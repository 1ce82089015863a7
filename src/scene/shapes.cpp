#include "scene/shapes.h"

#include "base/error.h"
#include "scene/bicubic_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

// Metres along the two axes that a flat face follows best, u level wherever the face allows.
Vec2 planar_uv(Vec3 p, Vec3 normal) {
    const Vec3 n = glm::abs(normal);
    if (n.y >= n.x && n.y >= n.z) return {p.x, p.z};
    if (n.z >= n.x) return {p.x, -p.y};
    return {p.z, -p.y};
}

std::uint32_t add_point(Mesh& mesh, Vec3 position, Vec3 normal, Vec2 uv) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs[0].push_back(uv);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void add_primitive(Mesh& mesh, std::array<std::uint32_t, 4> corners) {
    mesh.primitives.push_back({.corners = corners, .material = MaterialId{0}});
}

void add_flat_quad(Mesh& mesh, const std::array<Vec3, 4>& p) {
    // The normal from the diagonals: a mean over the quad when it is not quite flat.
    const Vec3 area = glm::cross(p[2] - p[0], p[3] - p[1]);
    if (glm::length(area) == 0) return;
    const Vec3 normal = glm::normalize(area);
    std::array<std::uint32_t, 4> corners;
    for (int i = 0; i < 4; ++i) corners[i] = add_point(mesh, p[i], normal, planar_uv(p[i], normal));
    add_primitive(mesh, corners);
}

// Joins points that were added row by row, (columns + 1) to a row.
void add_grid_primitives(Mesh& mesh, std::uint32_t first, int columns, int rows) {
    const auto at = [&](int i, int j) {
        return first + static_cast<std::uint32_t>(j * (columns + 1) + i);
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            add_primitive(mesh, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
}

Mesh finished(Mesh mesh) {
    order_primitives(mesh);
    return mesh;
}

// Unit normal of a profile that runs from `a` to `b`: on its right.
Vec2 profile_normal(Vec2 a, Vec2 b) {
    const Vec2 along = glm::normalize(b - a);
    return {along.y, -along.x};
}

// One smooth run of a lathe's profile, without sharp edges inside.
void add_lathe_run(Mesh& mesh, std::span<const Vec2> run, int sides) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const int rows = static_cast<int>(run.size()) - 1;
    for (int j = 0; j <= rows; ++j) {
        Vec2 normal(0);
        if (j > 0) normal += profile_normal(run[j - 1], run[j]);
        if (j < rows) normal += profile_normal(run[j], run[j + 1]);
        normal = glm::normalize(normal);
        for (int i = 0; i <= sides; ++i) {
            // The seam's two ends are the same point to the last bit.
            const float angle =
                -2 * kPi * static_cast<float>(i % sides) / static_cast<float>(sides);
            const Vec3 outward(std::cos(angle), 0, std::sin(angle));
            const Vec3 position = run[j].x * outward + Vec3(0, run[j].y, 0);
            const float turn = static_cast<float>(i) / static_cast<float>(sides);
            add_point(mesh, position, normal.x * outward + Vec3(0, normal.y, 0), {turn, -run[j].y});
        }
    }
    add_grid_primitives(mesh, first, sides, rows);
}

}  // namespace

void add(Mesh& mesh, const Mesh& part, MaterialId material, const Mat4& placement) {
    for (std::size_t i = 0; i < part.bicubics.size(); ++i) {
        CornerUvs uvs;
        for (int c = 0; c < 4; ++c) uvs[c] = part.uvs[0][part.primitives[i].corners[c]];
        add_bicubic(mesh, transformed(part.bicubics[i], placement), material, uvs);
    }
    const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
    const Mat3 rotation(placement);
    for (std::size_t i = 0; i < part.positions.size(); ++i)
        add_point(mesh, Vec3(placement * Vec4(part.positions[i], 1)),
                  glm::normalize(rotation * part.normals[i]), part.uvs[0][i]);
    for (Primitive primitive : std::span(part.primitives).subspan(part.bicubics.size())) {
        for (int i = 0; i < primitive.corner_count(); ++i) primitive.corners[i] += offset;
        primitive.material = material;
        mesh.primitives.push_back(primitive);
    }
    order_primitives(mesh);
}

Mesh quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    Mesh mesh;
    add_flat_quad(mesh, {a, b, c, d});
    return finished(std::move(mesh));
}

Mesh box(Vec3 low, Vec3 high, unsigned left_out) {
    const auto corner = [&](int x, int y, int z) {
        return Vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
    };
    struct Side {
        Face face;
        std::array<Vec3, 4> corners;
    };
    const Side sides[] = {
        {kLeft, {corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)}},
        {kRight, {corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1)}},
        {kBottom, {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}},
        {kTop, {corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0)}},
        {kBack, {corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0)}},
        {kFront, {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}},
    };
    Mesh mesh;
    for (const Side& side : sides)
        if (!(left_out & side.face)) add_flat_quad(mesh, side.corners);
    return finished(std::move(mesh));
}

Mesh rounded_box(Vec3 low, Vec3 high, float radius) {
    const Vec3 centre = 0.5f * (low + high);
    const Vec3 inner = 0.5f * (high - low) - Vec3(radius);
    check(inner.x >= 0 && inner.y >= 0 && inner.z >= 0, "rounded_box: radius too large");

    // Each face is a grid of 3 x 3: the flat middle, and the half of each round edge up to its 45
    // degrees. A direction on the unit cube gives both the place and the normal.
    constexpr std::array<float, 4> kCube = {-1, 0, 0, 1};
    constexpr std::array<float, 4> kSide = {-1, -1, 1, 1};
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
            const int u_axis = (axis + (sign > 0 ? 1 : 2)) % 3;
            const int v_axis = (axis + (sign > 0 ? 2 : 1)) % 3;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (int j = 0; j < 4; ++j) {
                for (int i = 0; i < 4; ++i) {
                    Vec3 direction(0), side(0);
                    direction[axis] = side[axis] = sign;
                    direction[u_axis] = kCube[i], side[u_axis] = kSide[i];
                    direction[v_axis] = kCube[j], side[v_axis] = kSide[j];
                    const Vec3 normal = glm::normalize(direction);
                    const Vec3 position = centre + side * inner + radius * normal;
                    add_point(mesh, position, normal, {position[u_axis], position[v_axis]});
                }
            }
            add_grid_primitives(mesh, first, 3, 3);
        }
    }
    return finished(std::move(mesh));
}

Mesh lathe(std::span<const Vec2> profile, int sides) {
    Mesh mesh;
    std::size_t start = 0;
    for (std::size_t i = 1; i <= profile.size(); ++i) {
        const bool ends = i == profile.size() || profile[i] == profile[i - 1];
        if (!ends) continue;
        if (i - start >= 2) add_lathe_run(mesh, profile.subspan(start, i - start), sides);
        start = i;
    }
    return finished(std::move(mesh));
}

Mesh loft(std::span<const std::vector<Vec3>> rings, bool closed) {
    Mesh mesh;
    const std::size_t last = closed ? rings.size() : rings.size() - 1;
    for (std::size_t j = 0; j < last; ++j) {
        const std::vector<Vec3>& from = rings[j];
        const std::vector<Vec3>& to = rings[(j + 1) % rings.size()];
        check(from.size() == to.size(), "loft: rings differ in their number of points");
        for (std::size_t i = 0; i < from.size(); ++i) {
            const std::size_t next = (i + 1) % from.size();
            add_flat_quad(mesh, {from[i], from[next], to[next], to[i]});
        }
    }
    return finished(std::move(mesh));
}

Mesh bar(Vec3 from, Vec3 to, Vec3 side, Vec2 width_depth, float taper) {
    const Vec3 along = glm::normalize(to - from);
    const Vec3 across = glm::normalize(side - glm::dot(side, along) * along);
    const Vec3 third = glm::cross(along, across);
    const auto ring = [&](Vec3 centre, float scale) {
        const Vec3 a = 0.5f * scale * width_depth.x * across;
        const Vec3 b = 0.5f * scale * width_depth.y * third;
        return std::vector<Vec3>{centre - a - b, centre + a - b, centre + a + b, centre - a + b};
    };
    const std::vector<Vec3> rings[] = {ring(from, 1), ring(to, taper)};
    return loft(rings);
}

Mesh moulding(Vec2 size, std::span<const Vec2> profile) {
    const Vec2 corners[] = {{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
    const auto point = [&](int corner, Vec2 p) {
        const Vec2 inward(corners[corner].x > 0 ? -1 : 1, corners[corner].y > 0 ? -1 : 1);
        return Vec3(corners[corner] + p.x * inward, p.y);
    };
    Mesh mesh;
    for (int corner = 0; corner < 4; ++corner) {
        const int next = (corner + 1) % 4;
        for (std::size_t i = 0; i + 1 < profile.size(); ++i)
            add_flat_quad(mesh, {point(corner, profile[i]), point(next, profile[i]),
                                 point(next, profile[i + 1]), point(corner, profile[i + 1])});
    }
    return finished(std::move(mesh));
}

Mesh sheet(int columns, int rows, const std::function<Vec3(float u, float v)>& point) {
    Mesh mesh;
    constexpr float kStep = 1e-3f;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(columns);
            const float v = static_cast<float>(j) / static_cast<float>(rows);
            const Vec3 du = point(u + kStep, v) - point(u - kStep, v);
            const Vec3 dv = point(u, v + kStep) - point(u, v - kStep);
            add_point(mesh, point(u, v), glm::normalize(glm::cross(du, dv)), {u, v});
        }
    }
    add_grid_primitives(mesh, 0, columns, rows);
    return finished(std::move(mesh));
}

Mat4 moved(Vec3 by) {
    return glm::translate(Mat4(1), by);
}

Mat4 turned(Vec3 axis, float degrees) {
    Mat4 rotation = glm::rotate(Mat4(1), glm::radians(degrees), glm::normalize(axis));
    // The cosine of 90 degrees is 0, so that walls turned by it meet exactly.
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (std::abs(rotation[column][row]) < 1e-6f) rotation[column][row] = 0;
    return rotation;
}

}  // namespace chiaro
