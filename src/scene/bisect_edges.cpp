#include "scene/bisect_edges.h"

#include "base/error.h"
#include "base/random.h"
#include "scene/surface.h"

#include <algorithm>
#include <span>
#include <utility>

namespace chiaro {
namespace {

// From the two ends of an edge to the point that halves it: a hash table with open addressing, at
// most 2/3 full.
class Midpoints {
public:
    // Where the midpoint's number stands; kNone where it has none yet. Valid until the next call.
    std::uint32_t& of(std::uint32_t a, std::uint32_t b) {
        if (3 * (count_ + 1) > 2 * entries_.size()) grow();
        const auto [low, high] = std::minmax(a, b);
        Entry& entry = find(low, high);
        if (entry.low == kNone) {
            entry = {low, high, kNone};
            ++count_;
        }
        return entry.midpoint;
    }

    static constexpr std::uint32_t kNone = 0xffff'ffff;

private:
    struct Entry {
        std::uint32_t low = kNone, high = kNone;
        std::uint32_t midpoint = kNone;
    };

    Entry& find(std::uint32_t low, std::uint32_t high) {
        std::size_t i = std::uint64_t{hash32(low, high)} * entries_.size() >> 32;
        while (entries_[i].low != kNone && (entries_[i].low != low || entries_[i].high != high))
            if (++i == entries_.size()) i = 0;
        return entries_[i];
    }
    void grow() {
        const std::vector<Entry> old = std::exchange(
            entries_, std::vector<Entry>(std::max<std::size_t>(64, 2 * entries_.size())));
        for (const Entry& entry : old)
            if (entry.low != kNone) find(entry.low, entry.high) = entry;
    }

    std::vector<Entry> entries_;
    std::size_t count_ = 0;
};

// Squares of lengths under all objects that show a mesh: of an edge e the largest e . (G e), where
// G is the transform's transpose times itself.
class WorldLengths {
public:
    void add(const Mat4& to_world) {
        const Mat3 linear(to_world);
        const Mat3 gram = glm::transpose(linear) * linear;
        if (std::ranges::find(grams_, gram) == grams_.end()) grams_.push_back(gram);
    }
    bool empty() const { return grams_.empty(); }
    // The same to the last bit for (b, a).
    float squared(Vec3 a, Vec3 b) const {
        const Vec3 edge = b - a;
        float largest = 0;
        for (const Mat3& gram : grams_) largest = std::max(largest, glm::dot(edge, gram * edge));
        return largest;
    }

private:
    std::vector<Mat3> grams_;
};

using Triangle = std::array<std::uint32_t, 3>;

class Bisection {
public:
    Bisection(Mesh& mesh, const WorldLengths& lengths, float longest)
        : mesh_(mesh), lengths_(lengths), longest_squared_(longest * longest) {}

    void run() {
        const std::vector<Primitive> plain = std::move(mesh_.primitives);
        const std::span patches = std::span(plain).first(mesh_.bicubics.size());
        mesh_.primitives.assign(patches.begin(), patches.end());
        for (const Primitive& primitive : std::span(plain).subspan(patches.size())) {
            const auto& c = primitive.corners;
            if (!primitive.is_quad()) {
                divide({c[0], c[1], c[2]}, primitive.material);
            } else if (any_too_long({c[0], c[1], c[3]}) || any_too_long({c[2], c[3], c[1]})) {
                divide({c[0], c[1], c[3]}, primitive.material);
                divide({c[2], c[3], c[1]}, primitive.material);
            } else {
                mesh_.primitives.push_back(primitive);
            }
        }
        order_primitives(mesh_);
    }

private:
    // The square of an edge's length if it is to be halved, else 0. An edge whose middle is one of
    // its ends, by rounding, cannot become shorter.
    float too_long(std::uint32_t a, std::uint32_t b) const {
        const Vec3 p = mesh_.positions[a], q = mesh_.positions[b];
        const float squared = lengths_.squared(p, q);
        if (!(squared > longest_squared_)) return 0;
        const Vec3 middle = 0.5f * (p + q);
        return middle != p && middle != q ? squared : 0;
    }

    bool any_too_long(const Triangle& t) const {
        return too_long(t[0], t[1]) > 0 || too_long(t[1], t[2]) > 0 || too_long(t[2], t[0]) > 0;
    }

    std::uint32_t midpoint(std::uint32_t a, std::uint32_t b) {
        std::uint32_t& known = midpoints_.of(a, b);
        if (known != Midpoints::kNone) return known;
        check(mesh_.positions.size() < Midpoints::kNone, "bisect_edges: too many points");
        known = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto add_mean = [&](auto& array) {
            if (!array.empty()) array.push_back(0.5f * (array[a] + array[b]));
        };
        add_mean(mesh_.positions);
        add_mean(mesh_.normals);
        if (!mesh_.normals.empty())
            mesh_.normals.back() = safe_normalize(mesh_.normals.back(), mesh_.normals[a]);
        for (auto& uvs : mesh_.uvs) add_mean(uvs);
        add_mean(mesh_.colors);
        return known;
    }

    // The longest edge first: slivers are cut across. Neighbours that begin with other edges still
    // come to halve all that they share.
    void divide(const Triangle& whole, MaterialId material) {
        waiting_.assign(1, whole);
        while (!waiting_.empty()) {
            const auto [a, b, c] = waiting_.back();
            waiting_.pop_back();
            const float ab = too_long(a, b), bc = too_long(b, c), ca = too_long(c, a);
            const float most = std::max({ab, bc, ca});
            if (most == 0)
                mesh_.primitives.push_back({{a, b, c, Primitive::kNoCorner}, material});
            else if (most == ab)
                halve(a, b, c);
            else if (most == bc)
                halve(b, c, a);
            else
                halve(c, a, b);
        }
    }

    // By its edge from `a` to `b`.
    void halve(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::uint32_t middle = midpoint(a, b);
        waiting_.push_back({a, middle, c});
        waiting_.push_back({middle, b, c});
    }

    Mesh& mesh_;
    const WorldLengths& lengths_;
    float longest_squared_;
    Midpoints midpoints_;
    std::vector<Triangle> waiting_;
};

}  // namespace

void bisect_edges(Scene& scene, float longest) {
    check(longest > 0, "bisect_edges: the length must be above 0");
    std::vector<WorldLengths> lengths(scene.meshes.size());
    for (const Object& object : scene.objects)
        if (object.mesh != MeshId::none) lengths[index_of(object.mesh)].add(object.to_world);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        if (!lengths[i].empty()) Bisection(scene.meshes[i], lengths[i], longest).run();
}

}  // namespace chiaro
