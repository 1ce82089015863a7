#include "scene/area_lights.h"

#include "base/random.h"
#include "sample_renderer/tiny_scenes.h"
#include "scene/chi_squared.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace chiaro {
namespace {

// A bent quad, a triangle and a rectangle, of different brightness, and a dark quad.
Scene lamps() {
    Scene scene;
    const MaterialId dim = tiny::add_material(scene, Rgb(0), Rgb(1));
    const MaterialId bright = tiny::add_material(scene, Rgb(0), Rgb(4));
    const MaterialId dark = tiny::add_material(scene, Rgb(0.5f));
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {3, 3, 1}, {0, 1, 0}};
    mesh.primitives = {tiny::triangle(0, 1, 3, bright), tiny::quad(0, 1, 2, 3, dim)};
    tiny::add_object(scene, mesh);
    tiny::add_quad(scene, {5, 0, 0}, {1, 0, 0}, {0, 1, 0}, dark);
    tiny::add_quad(scene, {9, 0, 0}, {3, 0, 0}, {0, 2, 0}, dim);
    return scene;
}

// Above all lamps, where each shines.
const LitPlace kAbove = {{2, 1, 6}, {0, 0, -1}};

TEST(AreaLights, PowerIsExitanceTimesArea) {
    Scene scene = lamps();
    double expected = 0;
    for (std::uint32_t p = 0; p < 2; ++p)
        expected += primitive_area(scene, ObjectId(0), p) * (p == 0 ? 1 : 4) * kPi;
    expected += 6 * kPi;
    EXPECT_NEAR(AreaLights(scene).power() / expected, 1, 1e-5);
    scene.materials[0].emits_backward = true;
    const double both = expected + kPi * (primitive_area(scene, ObjectId(0), 0) + 6);
    EXPECT_NEAR(AreaLights(scene).power() / both, 1, 1e-5);
}

TEST(AreaLights, DarkPrimitivesHaveNoDensity) {
    const Scene scene = lamps();
    const AreaLights lights(scene);
    EXPECT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights.pdf(kAbove, {ObjectId(1), 0}), 0);
    EXPECT_GT(lights.pdf(kAbove, {ObjectId(2), 0}), 0);
}

TEST(AreaLights, NoEmittersIsEmpty) {
    Scene scene;
    tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, tiny::add_material(scene, Rgb(1)));
    EXPECT_TRUE(AreaLights(scene).empty());
    EXPECT_EQ(AreaLights(scene).power(), 0);
}

// The densities integrate to 1: sum of pdf x area.
TEST(AreaLights, DensitiesSumToOne) {
    const Scene scene = lamps();
    const AreaLights lights(scene);
    double sum = 0;
    for (std::uint32_t o = 0; o < 3; ++o)
        for (std::uint32_t p = 0; p < scene.mesh_of(scene.objects[o]).primitives.size(); ++p)
            sum += lights.pdf(kAbove, {ObjectId(o), p}) * primitive_area(scene, ObjectId(o), p);
    EXPECT_NEAR(sum, 1, 1e-5);
}

// What a sample says of itself agrees with surface_geometry() at its surface point.
TEST(AreaLights, SamplesLieOnTheirPrimitives) {
    const Scene scene = lamps();
    const AreaLights lights(scene);
    Rng rng(7);
    for (int i = 0; i < 10'000; ++i) {
        const auto found = lights.sample(kAbove, rng.uniform(), {rng.uniform(), rng.uniform()});
        ASSERT_TRUE(found);
        const AreaLightSample& s = *found;
        const SurfaceGeometry g = surface_geometry(scene, s.point);
        EXPECT_LT(glm::length(g.position - s.position), 1e-5f);
        EXPECT_GT(glm::dot(g.geometric_normal, s.normal), 0.99999f);
        EXPECT_FLOAT_EQ(s.pdf_area, lights.pdf(kAbove, s.point));
    }
}

// Chi^2 test: counts in cells of equal (u, v) range against area x pdf of each cell. Cells of a
// half of a quad have equal area, so every primitive splits evenly within its halves. 4 x 4 cells a
// primitive, those on a quad's diagonal in two parts. Chi^2 may be 8 standard deviations above its
// mean, where its tail is 5e-9 (49 degrees of freedom): so rarely would a sound program fail.
TEST(AreaLights, ChiSquaredOfSamples) {
    const Scene scene = lamps();
    const AreaLights lights(scene);
    constexpr int kCells = 4;
    constexpr int kSamples = 400'000;
    std::map<std::pair<int, int>, double> counts, expected;
    const auto cell_of = [](float u, float v) {
        const int x = std::min(kCells - 1, int(u * kCells)),
                  y = std::min(kCells - 1, int(v * kCells));
        const int half = x + y < kCells - 1 ? 0 : x + y > kCells - 1 ? 2 : u + v <= 1 ? 1 : 3;
        return (x * kCells + y) * 4 + half;
    };
    const auto key = [&](const SurfacePoint& p, float u, float v) {
        return std::pair(int(p.object) * 10 + int(p.primitive), cell_of(u, v));
    };

    Rng rng(11);
    for (int i = 0; i < kSamples; ++i) {
        const auto s = lights.sample(kAbove, rng.uniform(), {rng.uniform(), rng.uniform()});
        ASSERT_TRUE(s);
        counts[key(s->point, s->point.u, s->point.v)] += 1;
    }

    // Expected: midpoints of a fine grid of (u, v), each with the area of its half.
    constexpr int kFine = 200;
    const auto& light_objects = {std::pair(0u, 0u), std::pair(0u, 1u), std::pair(2u, 0u)};
    for (const auto& light : light_objects) {
        const std::uint32_t o = light.first, p = light.second;
        const Primitive& primitive = scene.mesh_of(scene.objects[o]).primitives[p];
        const auto geometry = [&](float u, float v) {
            return surface_geometry(scene, {ObjectId(o), p, u, v}).position;
        };
        for (int x = 0; x < kFine; ++x) {
            for (int y = 0; y < kFine; ++y) {
                const float u = (float(x) + 0.5f) / kFine, v = (float(y) + 0.49f) / kFine;
                if (!primitive.is_quad() && u + v > 1) continue;
                const bool second = u + v > 1;
                const Vec3 a = geometry(second ? 1.0f : 0.0f, second ? 1.0f : 0.0f);
                const Vec3 b = geometry(second ? 0.001f : 0.999f, second ? 1.0f : 0.0f);
                const Vec3 c = geometry(second ? 1.0f : 0.0f, second ? 0.001f : 0.999f);
                const double jacobian = glm::length(glm::cross(b - a, c - a)) / (0.999 * 0.999);
                expected[key({ObjectId(o), p}, u, v)] +=
                    kSamples * jacobian * lights.pdf(kAbove, {ObjectId(o), p}) / (kFine * kFine);
            }
        }
    }
    for (const auto& [k, count] : counts)
        EXPECT_TRUE(expected.contains(k)) << count << " samples where none belongs";
    double chi2 = 0;
    for (const auto& [k, e] : expected) {
        const double difference = counts[k] - e;
        chi2 += difference * difference / e;
    }
    const double dof = double(expected.size()) - 1;
    EXPECT_LT(chi2, dof + 8 * std::sqrt(2 * dof)) << dof;
}

// Chosen by power, points are even over each light's area too: by halves of quads and, in each half
// or triangle, in 4 x 4 cells of equal area. False alarm below 1e-6.
TEST(AreaLights, SamplesByPowerAreEvenOverEachArea) {
    const Scene scene = lamps();
    const AreaLights lights(scene);
    constexpr int kSamples = 100'000;
    const std::pair<ObjectId, std::uint32_t> all[] = {
        {ObjectId(0), 0}, {ObjectId(0), 1}, {ObjectId(2), 0}};
    std::vector<double> counts(3 * 32, 0.0), expected;
    Rng rng(12);
    for (int i = 0; i < kSamples; ++i) {
        const AreaLightSample s =
            lights.sample_by_power(rng.uniform(), {rng.uniform(), rng.uniform()});
        const auto [object, primitive, u, v] = s.point;
        EXPECT_FLOAT_EQ(s.pdf_area, lights.pdf_by_power({object, primitive}));
        const int light = object == ObjectId(2) ? 2 : int(primitive);
        const bool second = u + v > 1;
        const Vec2 uv = second ? Vec2(1 - u, 1 - v) : Vec2(u, v);
        const float sum = uv.x + uv.y;  // its square and the share of v are even over a triangle
        const int cell = 4 * std::min(3, int(4 * sum * sum)) + std::min(3, int(4 * uv.y / sum));
        counts[32 * light + 16 * second + cell] += 1;
    }
    for (const auto& [object, primitive] : all)
        for (const float corner : {0.0f, 1.0f}) {
            const auto at = [&, o = object, p = primitive](float u, float v) {
                return surface_geometry(scene, {o, p, u, v}).position;
            };
            const bool half =
                scene.mesh_of(scene.objects[index_of(object)]).primitives[primitive].is_quad();
            const Vec3 at_corner = at(corner, corner);
            const double area =
                corner == 1 && !half
                    ? 0
                    : 0.5 * glm::length(glm::cross(at(1, 0) - at_corner, at(0, 1) - at_corner));
            expected.insert(expected.end(), 16,
                            kSamples * area / 16 * lights.pdf_by_power({object, primitive}));
        }
    expect_counts(counts, expected, "by power");
}

// The alpha of an emission texture is no part of it: texels that shine do so at alpha 0 too, and
// half of the texels lit make half of the power.
TEST(AreaLights, AlphaOfAnEmissionTextureMeansNothing) {
    Scene scene;
    tiny::add_quad(scene, {0, 0, 0}, {3, 0, 0}, {0, 1, 0},
                   tiny::add_material(scene, Rgb(0), Rgb(4)));
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.texels = {{255, 255, 255, 0}, {0, 0, 0, 255}};
    scene.textures.push_back(texture);
    scene.materials[0].emission_texture.texture = TextureId(0);
    EXPECT_NEAR(AreaLights(scene).power() / (kPi * 4 * 3 * 0.5), 1, 1e-5);
    EXPECT_EQ(mean_emission(scene, scene.materials[0]), Rgb(2));
}

// A mask cuts emission at its cutoff and a blend scales it, as seen by a ray that may pass through.
TEST(AreaLights, AlphaOfEmitters) {
    Scene scene;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(2));
    tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, lamp);
    scene.materials[0].alpha = 0.25f;
    const auto radiance = [&](AlphaMode mode) {
        scene.materials[0].alpha_mode = mode;
        const AreaLights lights(scene);
        return lights.eval(*lights.sample(kAbove, 0.5f, {0.5f, 0.5f}), {0, 0, 1}).r;
    };
    EXPECT_EQ(radiance(AlphaMode::opaque), 2);
    EXPECT_EQ(radiance(AlphaMode::mask), 0);
    EXPECT_EQ(radiance(AlphaMode::blend), 0.5f);
}

}  // namespace
}  // namespace chiaro
