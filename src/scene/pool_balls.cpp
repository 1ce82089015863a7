#include "scene/pool_balls.h"

#include "scene/curved_shapes.h"
#include "scene/make_material.h"
#include "scene/painting.h"
#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace chiaro {
namespace {

constexpr Rgb kIvory = {0.78f, 0.75f, 0.66f};
constexpr Rgb kInk = Rgb(0.015f);

// Digits as strokes, in a box of 1 x 1.64 about the origin. A nine is a six upside down.
std::vector<Vec2> strokes_of(int digit) {
    switch (digit) {
        case 0:
            return {{0, 0.82f},       {0.35f, 0.55f}, {0.45f, 0},      {0.35f, -0.55f}, {0, -0.82f},
                    {-0.35f, -0.55f}, {-0.45f, 0},    {-0.35f, 0.55f}, {0, 0.82f}};
        case 1:
            return {{-0.25f, 0.5f}, {0.05f, 0.82f}, {0.05f, -0.82f}};
        case 2:
            return {{-0.45f, 0.45f}, {-0.2f, 0.8f},   {0.2f, 0.8f}, {0.45f, 0.5f},
                    {0.4f, 0.15f},   {-0.45f, -0.8f}, {0.5f, -0.8f}};
        case 3:
            return {{-0.4f, 0.65f},  {0, 0.82f},     {0.4f, 0.6f}, {0.38f, 0.2f},  {0, 0.05f},
                    {0.42f, -0.15f}, {0.42f, -0.6f}, {0, -0.82f},  {-0.42f, -0.6f}};
        case 4:
            return {{0.2f, -0.8f}, {0.2f, 0.8f}, {-0.5f, -0.3f}, {0.5f, -0.3f}};
        case 5:
            return {{0.45f, 0.8f},   {-0.35f, 0.8f},  {-0.42f, 0.1f},  {0.05f, 0.22f},
                    {0.42f, -0.05f}, {0.42f, -0.55f}, {0.05f, -0.82f}, {-0.42f, -0.62f}};
        case 6:
            return {{0.4f, 0.7f},    {0, 0.8f},       {-0.4f, 0.3f},   {-0.45f, -0.4f},
                    {-0.1f, -0.82f}, {0.3f, -0.75f},  {0.45f, -0.35f}, {0.2f, 0.05f},
                    {-0.2f, 0.05f},  {-0.43f, -0.25f}};
        case 7:
            return {{-0.45f, 0.8f}, {0.5f, 0.8f}, {-0.1f, -0.8f}};
        case 8:
            return {{0, 0.05f},     {-0.36f, 0.3f}, {-0.3f, 0.7f},   {0, 0.82f},      {0.3f, 0.7f},
                    {0.36f, 0.3f},  {0, 0.05f},     {-0.42f, -0.3f}, {-0.35f, -0.7f}, {0, -0.82f},
                    {0.35f, -0.7f}, {0.42f, -0.3f}, {0, 0.05f}};
        default:
            break;
    }
    std::vector<Vec2> nine = strokes_of(6);
    for (Vec2& p : nine) p = -p;
    return nine;
}

float distance_to_strokes(std::span<const Vec2> strokes, Vec2 p) {
    float least = kInfinity;
    for (std::size_t i = 0; i + 1 < strokes.size(); ++i) {
        const Vec2 along = strokes[i + 1] - strokes[i];
        const float t = glm::dot(p - strokes[i], along) / glm::dot(along, along);
        const Vec2 nearest = strokes[i] + std::clamp(t, 0.0f, 1.0f) * along;
        least = std::min(least, glm::distance(p, nearest));
    }
    return least;
}

// `p` is in units of the digits' width.
bool is_inked(int number, Vec2 p) {
    constexpr float kHalfStroke = 0.13f;
    if (number < 10) return distance_to_strokes(strokes_of(number), p) < kHalfStroke;
    return distance_to_strokes(strokes_of(1), p + Vec2(0.55f, 0)) < kHalfStroke ||
           distance_to_strokes(strokes_of(number - 10), p - Vec2(0.45f, 0)) < kHalfStroke;
}

// At a place of the unit sphere.
Rgb ball_paint(int number, Vec3 place) {
    constexpr Rgb kColors[] = {{0.75f, 0.49f, 0.03f}, {0.02f, 0.07f, 0.36f},
                               {0.6f, 0.03f, 0.025f}, {0.14f, 0.03f, 0.24f},
                               {0.76f, 0.23f, 0.02f}, {0.015f, 0.2f, 0.08f},
                               {0.25f, 0.03f, 0.03f}, {0.015f, 0.015f, 0.018f}};
    constexpr float kDisc = 0.46f;        // radius, of the ball's
    constexpr float kDigit = 0.24f;       // width
    constexpr float kHalfStripe = 0.56f;  // height
    if (number == 0) return kIvory;
    if (std::hypot(place.y, place.z) < kDisc) {
        // From outside, the disc's right is towards -z at +x.
        const float right = place.x > 0 ? -place.z : place.z;
        return is_inked(number, Vec2(right, place.y) / kDigit) ? kInk : kIvory;
    }
    const bool striped = number > 8;
    if (striped && std::abs(place.y) > kHalfStripe) return kIvory;
    return kColors[(number - 1) % 8];
}

}  // namespace

Mesh pool_ball(Scene& scene, int number) {
    constexpr float kRoughness = 0.06f;
    const std::string name = number == 0 ? "Cue ball" : "Ball " + std::to_string(number);
    const MaterialId material = glossy(scene, name, Rgb(1), kRoughness);
    // revolve() counts texture coordinates in turns, and in two curves from pole to pole.
    scene.materials[index_of(material)].base_color_texture = {
        .texture = add_texture(
            scene, painted(name, 512, 256, 2,
                           [&](float u, float v) {
                               const float turn = -2 * kPi * u, latitude = kPi * (v - 0.5f);
                               const float across = std::cos(latitude);
                               return ball_paint(number,
                                                 {across * std::cos(turn), std::sin(latitude),
                                                  across * std::sin(turn)});
                           })),
        .scale = {1, 0.5f}};
    Mesh mesh;
    add(mesh, curved_sphere(kBallRadius), material);
    return mesh;
}

}  // namespace chiaro
