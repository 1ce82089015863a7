// Which of many lights is asked at a place.
#include "scene/light_clusters.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <map>

namespace chiaro {
namespace {

// A plate of n x n small lights, 2 units wide, at height 2, that shine downward.
std::vector<LightBounds> plate(int n) {
    std::vector<LightBounds> lights;
    const float size = 2 / static_cast<float>(n);
    for (int i = 0; i < n * n; ++i) {
        const Vec3 low(-1 + size * static_cast<float>(i % n), -1 + size * static_cast<float>(i / n),
                       2);
        LightBounds light;
        light.box.add(low);
        light.box.add(low + Vec3(size, size, 0));
        light.axis = Vec3(0, 0, -1);
        light.intensity = 1 + static_cast<float>(i % 3);
        lights.push_back(light);
    }
    return lights;
}

LitPlace random_place(Rng& random, float reach) {
    const auto any = [&] { return 2 * random.uniform() - 1; };
    Vec3 normal(any(), any(), any());
    while (!(glm::dot(normal, normal) > 0.01f)) normal = Vec3(any(), any(), any());
    return {reach * Vec3(any(), any(), any()), glm::normalize(normal)};
}

// The numbers u that choose a light are as many as its pdf says: 40,000 evenly spaced, each light's
// interval cut off by at most one at each end.
TEST(LightClusters, ChooseAsThePdfSays) {
    constexpr int kSteps = 40'000;
    const LightClusters clusters(plate(12));
    Rng random(1);
    for (const float reach : {1.0f, 3.0f, 20.0f})
        for (int i = 0; i < 10; ++i) {
            const LitPlace place = random_place(random, reach);
            std::map<std::uint32_t, int> chosen;
            for (int s = 0; s < kSteps; ++s) {
                const auto choice = clusters.sample(place, (static_cast<float>(s) + 0.5f) / kSteps);
                if (!choice) continue;
                ++chosen[choice->light];
                const float pdf = clusters.pdf(place, choice->light);
                ASSERT_NEAR(choice->probability, pdf, 1e-5f * pdf);
            }
            for (const auto& [light, count] : chosen)
                EXPECT_NEAR(count, clusters.pdf(place, light) * kSteps, 2.1) << light;
        }
}

// From far below the lights of a plate differ by little but their intensity: at 40 units a plate of
// 2 changes squared distances and cosines by less than 3 %. All can be chosen, so the sum is 1.
TEST(LightClusters, FarAwayChooseByIntensity) {
    const std::vector<LightBounds> lights = plate(16);
    const LightClusters clusters(lights);
    double total = 0, sum = 0;
    for (const LightBounds& light : lights) total += light.intensity;
    const LitPlace place{Vec3(3, -2, -40), Vec3(0, 0, 1)};
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const float pdf = clusters.pdf(place, i);
        EXPECT_NEAR(pdf, lights[i].intensity / total, 0.03 * pdf) << i;
        sum += pdf;
    }
    EXPECT_NEAR(sum, 1, 1e-5);
}

// What cannot shine on a place has no chance, however near the horizon runs through the plate.
TEST(LightClusters, NeverChooseWhatIsBehindTheHorizon) {
    const std::vector<LightBounds> lights = plate(12);
    const LightClusters clusters(lights);
    Rng random(2);
    int behind = 0;
    for (int i = 0; i < 300; ++i) {
        const LitPlace place = random_place(random, 4);
        for (std::uint32_t l = 0; l < lights.size(); ++l) {
            const Vec3 middle = lights[l].box.centre(), half = lights[l].box.high - middle;
            const float above = glm::dot(place.normal, middle - place.position) +
                                glm::dot(glm::abs(place.normal), half);
            const bool faces_away = place.position.z > 2.001f;
            if (above > -1e-3f && !faces_away) continue;
            ++behind;
            EXPECT_EQ(clusters.pdf(place, l), 0);
        }
    }
    EXPECT_GT(behind, 1000);
}

}  // namespace
}  // namespace chiaro
