#include "import/ear_clip.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chiaro {
namespace {

std::vector<PolygonPiece> pieces_of(const std::vector<Vec3>& corners) {
    std::vector<PolygonPiece> pieces;
    EXPECT_TRUE(split_polygon(corners, pieces));
    return pieces;
}

// Corner `i` of a regular polygon of unit radius.
Vec3 on_circle(int i, int count) {
    const double angle = 2 * std::numbers::pi * i / count;
    return Vec3(glm::dvec3(std::cos(angle), std::sin(angle), 0));
}

// The vector area of the triangles that a piece is drawn as: (0, 1, 3) and (2, 3, 1) for a quad.
glm::dvec3 vector_area(const std::vector<Vec3>& p, const PolygonPiece& piece) {
    const auto triangle = [&](int a, int b, int c) {
        const glm::dvec3 o(p[piece[a]]);
        return 0.5 * glm::cross(glm::dvec3(p[piece[b]]) - o, glm::dvec3(p[piece[c]]) - o);
    };
    if (piece[3] == Primitive::kNoCorner) return triangle(0, 1, 2);
    return triangle(0, 1, 3) + triangle(2, 3, 1);
}

// Area covered along +z, and the sum of the sizes: equal only if no piece folds or overlaps.
struct Cover {
    double signed_area = 0, total_area = 0;
};
Cover cover_of(const std::vector<Vec3>& corners) {
    Cover cover;
    for (const PolygonPiece& piece : pieces_of(corners)) {
        const glm::dvec3 area = vector_area(corners, piece);
        cover.signed_area += area.z;
        cover.total_area += glm::length(area);
    }
    return cover;
}

TEST(EarClip, AFlatConvexQuadStaysOneQuad) {
    const auto pieces = pieces_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0], (PolygonPiece{0, 1, 2, 3}));
}

TEST(EarClip, AConcaveQuadIsCutAlongItsInnerDiagonal) {
    for (int turn = 0; turn < 4; ++turn) {
        std::vector<Vec3> dart = {{0, 0, 0}, {2, 0, 0}, {0.3f, 0.3f, 0}, {0, 2, 0}};
        std::rotate(dart.begin(), dart.begin() + turn, dart.end());
        EXPECT_EQ(pieces_of(dart).size(), 2u);
        EXPECT_NEAR(cover_of(dart).signed_area, 0.6, 1e-6);
        EXPECT_NEAR(cover_of(dart).total_area, 0.6, 1e-6);
    }
}

TEST(EarClip, AQuadThatBendsByHalfARightAngleBecomesTriangles) {
    EXPECT_EQ(pieces_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}).size(), 2u);
}

TEST(EarClip, AConvexPolygonIsCoveredByQuadsAndAtMostOneTriangle) {
    for (int count : {5, 6, 9, 40}) {
        std::vector<Vec3> ring;
        for (int i = 0; i < count; ++i) ring.push_back(on_circle(i, count) + Vec3(0, 0, 3));
        const auto pieces = pieces_of(ring);
        EXPECT_EQ(pieces.size(), static_cast<std::size_t>((count - 1) / 2));
        const double area = 0.5 * count * std::sin(2 * std::numbers::pi / count);
        EXPECT_NEAR(cover_of(ring).signed_area, area, 1e-5);
    }
}

TEST(EarClip, RandomStarsAreCoveredExactlyOnceInAnyPlane) {
    Rng rng(7);
    for (int trial = 0; trial < 200; ++trial) {
        const int count = 5 + static_cast<int>(rng.below(60));
        std::vector<Vec3> star;
        double area = 0;
        for (int i = 0; i < count; ++i) {
            star.push_back((0.2f + rng.uniform()) * on_circle(i, count));
        }
        for (int i = 0; i < count; ++i) {
            const Vec3 a = star[i], b = star[(i + 1) % count];
            area += 0.5 * (double{a.x} * b.y - double{a.y} * b.x);
        }
        EXPECT_NEAR(cover_of(star).signed_area, area, 1e-5);
        EXPECT_NEAR(cover_of(star).total_area, area, 1e-5);
        for (Vec3& p : star) p = Vec3(p.y, 5, p.x);  // faces +y
        double total = 0;
        for (const PolygonPiece& piece : pieces_of(star)) total += vector_area(star, piece).y;
        EXPECT_NEAR(total, area, 1e-5);
    }
}

TEST(EarClip, APolygonWithABridgeToItsHoleKeepsTheHole) {
    const std::vector<Vec3> frame = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                     {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    EXPECT_NEAR(cover_of(frame).signed_area, 8, 1e-6);
    EXPECT_NEAR(cover_of(frame).total_area, 8, 1e-6);
}

TEST(EarClip, APolygonThatRunsRoundItsLoopManyTimesCountsOnce) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 200; ++i)
        for (const Vec3 p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
            corners.push_back(p);
    EXPECT_EQ(pieces_of(corners).size(), 1u);
}

TEST(EarClip, PolygonsWithoutAreaOrWithCrossingsEndInSomePieces) {
    EXPECT_FALSE(pieces_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).empty());
    EXPECT_FALSE(pieces_of(std::vector<Vec3>(9, Vec3(1))).empty());
    EXPECT_FALSE(pieces_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).empty());
    Rng rng(3);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<Vec3> tangle(4 + rng.below(12));
        for (Vec3& p : tangle) p = Vec3(rng.below(4), rng.below(4), rng.below(2));
        const auto pieces = pieces_of(tangle);
        EXPECT_LT(pieces.size(), tangle.size());
        for (const PolygonPiece& piece : pieces)
            for (const std::uint32_t corner : piece)
                EXPECT_TRUE(corner < tangle.size() || corner == Primitive::kNoCorner);
    }
}

TEST(EarClip, AConcavePolygonBeyondTheLimitIsRefusedAndAConvexOneIsNot) {
    std::vector<Vec3> ring;
    const int count = 30000;
    for (int i = 0; i < count; ++i) ring.push_back(100.0f * on_circle(i, count));
    for (int i = 0; i < count; i += 2) ring[i] *= 0.5f;
    std::vector<PolygonPiece> pieces;
    EXPECT_FALSE(split_polygon(ring, pieces));
    EXPECT_TRUE(pieces.empty());

    std::vector<Vec3> square;
    const int side = 10000;
    for (int i = 0; i < side; ++i) square.emplace_back(i, 0, 0);
    for (int i = 0; i < side; ++i) square.emplace_back(side, i, 0);
    for (int i = 0; i < side; ++i) square.emplace_back(side - i, side, 0);
    for (int i = 0; i < side; ++i) square.emplace_back(0, side - i, 0);
    EXPECT_TRUE(split_polygon(square, pieces));
}

TEST(EarClip, ACombOfTenThousandCornersIsCoveredOnce) {
    std::vector<Vec3> comb;
    const int teeth = 5000;
    for (int i = 0; i < teeth; ++i) {
        comb.emplace_back(i, 0, 0);
        comb.emplace_back(static_cast<float>(i) + 0.5f, 10, 0);
    }
    comb.emplace_back(teeth, 20, 0);
    comb.emplace_back(0, 20, 0);
    const Cover cover = cover_of(comb);
    EXPECT_NEAR(cover.signed_area, cover.total_area, 1e-3 * cover.total_area);
}

}  // namespace
}  // namespace chiaro
