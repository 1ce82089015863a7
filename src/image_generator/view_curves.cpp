#include "image_generator/view_curves.h"

#include <algorithm>
#include <array>

namespace chiaro {
namespace {

constexpr float kPixels = 0.25f;

// Points that one object may take; closer looks are coarser than kPixels would have it.
constexpr std::size_t kMostPoints = std::size_t{1} << 21;

// What a view asks of surfaces at a place.
class Fineness {
public:
    explicit Fineness(const View& view) : eye_(view.eye()) {
        const auto w = static_cast<float>(view.width()), h = static_cast<float>(view.height());
        const std::array<Vec3, 4> corners = {view.ray(0, 0).direction, view.ray(w, 0).direction,
                                             view.ray(w, h).direction, view.ray(0, h).direction};
        for (int i = 0; i < 4; ++i)
            inward_[i] = glm::normalize(glm::cross(corners[i], corners[(i + 1) % 4]));
        inward_[4] = glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]);
        // Pixels are smallest, seen from the eye, in the picture's corners.
        pixel_ = std::min(glm::distance(view.ray(0, 0).direction, view.ray(1, 0).direction),
                          glm::distance(view.ray(0, 0).direction, view.ray(0, 1).direction));
    }

    // What a length of a part of a pixel is at the nearest point of a box (world space); infinite
    // where the box is out of view.
    float tolerance(const std::array<Vec3, 8>& corners) const {
        Box box;
        for (const Vec3 p : corners) box.add(p);
        for (const Vec3 n : inward_)
            if (std::ranges::all_of(corners, [&](Vec3 p) { return glm::dot(p - eye_, n) < 0; }))
                return kInfinity;
        const Vec3 nearest = glm::clamp(eye_, box.low, box.high);
        return kPixels * pixel_ * glm::distance(nearest, eye_);
    }

private:
    Vec3 eye_;
    std::array<Vec3, 5> inward_;  // of the sides of what is in view, and ahead
    float pixel_;
};

std::array<Vec3, 8> corners_in_world(const Box& box, const Mat4& to_world) {
    std::array<Vec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        const Vec3 p(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                     i & 4 ? box.high.z : box.low.z);
        corners[i] = Vec3(to_world * Vec4(p, 1));
    }
    return corners;
}

}  // namespace

std::size_t show_curves(RayCaster& rays, const View& view, int threads) {
    const Scene& scene = rays.scene();
    const Fineness fineness(view);
    std::vector<ShownCurves> shown;
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (object.mesh == MeshId::none || scene.mesh_of(object).bicubics.empty()) continue;
        const Mesh& mesh = scene.mesh_of(object);
        const float known = rays.curve_tolerance(object.mesh);
        const float stretch = largest_stretch(object.to_world);
        // A hundredth of what is known is as fine as anybody needs who stands on the surface.
        float coarser = 1;
        const auto tolerance = [&](const Box& box) {
            const float wanted =
                fineness.tolerance(corners_in_world(box, object.to_world)) / stretch;
            return std::clamp(coarser * wanted, coarser * 0.01f * known, known);
        };
        Box box;
        for (const BicubicPatch& patch : mesh.bicubics) box.add(hull(patch));
        if (!(tolerance(box) < known)) continue;
        while (coarser < 100 && grid_points(mesh.bicubics, tolerance, threads) > kMostPoints)
            coarser = std::min(4 * coarser, 100.0f);
        shown.push_back({static_cast<ObjectId>(i), tessellate(mesh.bicubics, tolerance, threads)});
        triangles += shown.back().grids.triangles();
    }
    rays.show_curves(std::move(shown));
    return triangles;
}

}  // namespace chiaro
