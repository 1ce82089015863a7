// New values come in over a few frames.
#include "shading_cache/fade_in.h"

#include "shading_cache/interpolate.h"
#include "shading_cache/square.h"

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

// All corners are that grey, in both kinds of light.
struct GreySquare : Square {
    explicit GreySquare(float grey) : Square({.irradiance = 1, .glossy = 1}) {
        for (const VertexId v : corners)
            for (int c = 0; c < 2; ++c) cache.store(v, c, Rgb(grey), 0, 1, 1);
    }
};

// The first look shows what is there; n frames after a change a tenth of it is left, in equal
// parts.
TEST(FadeIn, ComesAsFarAsItSays) {
    for (const int frames : {1, 4, 10}) {
        GreySquare s(16);
        FadeIn fade(frames);
        fade.advance(s.cache, 1);
        EXPECT_EQ(fade.shown_total(s.corners[0], Shading::irradiance).value, Rgb(16));
        for (const VertexId v : s.corners) {
            s.cache.outdate(v, 0, 1);
            s.cache.store(v, 0, Rgb(32), 0, 1, 2);
        }
        for (int f = 1; f <= frames; ++f) {
            fade.advance(s.cache, 2);
            const float left =
                16 * std::pow(0.1f, static_cast<float>(f) / static_cast<float>(frames));
            for (const Vec2 place : {Vec2(0, 0), Vec2(0.3f, 0.6f)})
                EXPECT_NEAR(irradiance_at(s.cache, s.root, place, &fade).g, 32 - left, 1e-3f);
        }
    }
}

// A patch that is divided shows what it showed, until the new vertices' own light comes in.
TEST(FadeIn, DivisionDoesNotShow) {
    GreySquare s(16);
    FadeIn fade(4);
    fade.advance(s.cache, 1);
    const PatchId child = s.cache.subdivide(s.root);
    const VertexId centre = s.cache.patch(child).corners[2];
    s.cache.store(centre, 0, Rgb(64), 0, 1, 1);
    s.cache.resolve();
    fade.advance(s.cache, 1);
    EXPECT_EQ(s.cache.shown_total(centre).value, Rgb(64));
    const float part = 1 - std::pow(0.1f, 0.25f);
    EXPECT_NEAR(fade.shown_total(centre, Shading::irradiance).value.r, 16 + part * 48, 1e-3f);
}

// What was hollow has shown nothing: its first light is not dimmed.
TEST(FadeIn, WhatShowedNothingComesAtOnce) {
    GreySquare s(16);
    FadeIn fade(4);
    s.cache.forget(s.corners[2]);
    fade.advance(s.cache, 1);
    EXPECT_EQ(fade.shown_total(s.corners[2], Shading::irradiance).weight, 0);
    s.cache.store(s.corners[2], 0, Rgb(64), 0, 1, 1);
    fade.advance(s.cache, 1);
    EXPECT_EQ(fade.shown_total(s.corners[2], Shading::irradiance).value, Rgb(64));
    EXPECT_EQ(fade.shown_total(s.corners[2], Shading::irradiance).weight, 1);
}

// Once ids have changed, nobody knows what was shown where.
TEST(FadeIn, BeginsAnewOncePacked) {
    GreySquare s(16);
    FadeIn fade(4);
    s.cache.subdivide(s.root);
    fade.advance(s.cache, 1);
    s.cache.collapse(s.root);
    s.cache.pack();
    for (const VertexId v : s.cache.patch(s.cache.root(ObjectId{0}, 0, true)).corners) {
        s.cache.outdate(v, 0, 1);
        s.cache.store(v, 0, Rgb(32), 0, 1, 2);
    }
    fade.advance(s.cache, 1);
    EXPECT_EQ(irradiance_at(s.cache, s.cache.root(ObjectId{0}, 0, true), Vec2(0.5f), &fade),
              Rgb(32));
}

}  // namespace
}  // namespace chiaro
