// The eight ways to divide, against plane geometry.
#include "shading_cache/split.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

constexpr std::array<Split, 7> kAllSplits = {Split::quad_in_four,     Split::quad_across_s,
                                             Split::quad_across_t,    Split::triangle_in_four,
                                             Split::triangle_edge_01, Split::triangle_edge_12,
                                             Split::triangle_edge_20};

bool divides_quad(Split split) {
    return split <= Split::quad_across_t;
}

Vec2 random_place(bool quad, Rng& rng) {
    const Vec2 p(rng.uniform(), rng.uniform());
    return quad || p.x + p.y <= 1 ? p : Vec2(1) - p;
}

// How far a local point lies inside its patch; negative outside.
float depth(bool quad, Vec2 p) {
    const float low = std::min(p.x, p.y);
    return quad ? std::min(low, 1 - std::max(p.x, p.y)) : std::min(low, 1 - p.x - p.y);
}

// To a child and back is the identity, and the other way round.
TEST(Split, ToChildAndToParentAreInverse) {
    Rng rng(1);
    for (const Split split : kAllSplits)
        for (int child = 0; child < child_count(split); ++child)
            for (int i = 0; i < 1000; ++i) {
                const Vec2 p = random_place(divides_quad(split), rng);
                const Vec2 there = to_parent(split, child, to_child(split, child, p));
                const Vec2 back = to_child(split, child, to_parent(split, child, p));
                EXPECT_NEAR(glm::length(there - p), 0, 1e-6f);
                EXPECT_NEAR(glm::length(back - p), 0, 1e-6f);
            }
}

// Children cover their parent without overlap: each point lies in the child that child_at names,
// and in no other.
TEST(Split, EachPointLiesInOneChildOnly) {
    Rng rng(2);
    for (const Split split : kAllSplits) {
        const bool quad = divides_quad(split);
        for (int i = 0; i < 10'000; ++i) {
            const Vec2 p = random_place(quad, rng);
            const int named = child_at(split, p);
            ASSERT_LT(named, child_count(split));
            EXPECT_GE(depth(quad, to_child(split, named, p)), -1e-6f);
            for (int child = 0; child < child_count(split); ++child)
                if (child != named) {
                    EXPECT_LE(depth(quad, to_child(split, child, p)), 1e-6f);
                }
        }
    }
}

// Children have equal parts of their parent's area, and its winding.
TEST(Split, ChildrenShareTheAreaEqually) {
    for (const Split split : kAllSplits) {
        float sum = 0;
        for (int child = 0; child < child_count(split); ++child) {
            const Vec2 o = to_parent(split, child, {0, 0});
            const Vec2 s = to_parent(split, child, {1, 0}) - o;
            const Vec2 t = to_parent(split, child, {0, 1}) - o;
            const float part = s.x * t.y - s.y * t.x;
            EXPECT_FLOAT_EQ(part, 1.0f / static_cast<float>(child_count(split)));
            sum += part;
        }
        EXPECT_FLOAT_EQ(sum, 1);
    }
}

// The corners that a child is made of are those that its affine map has: dyadic numbers, exactly.
TEST(Split, CornerNodesAgreeWithTheMaps) {
    for (const Split split : kAllSplits) {
        const bool quad = divides_quad(split);
        for (int child = 0; child < child_count(split); ++child) {
            const auto nodes = child_corners(split, child);
            EXPECT_EQ(nodes[3] == kNoNode, !quad);
            for (int i = 0; i < (quad ? 4 : 3); ++i) {
                const Vec2 corner = node_place(quad, static_cast<Node>(i));
                EXPECT_EQ(to_parent(split, child, corner), node_place(quad, nodes[i]));
                EXPECT_EQ(to_child(split, child, node_place(quad, nodes[i])), corner);
            }
        }
    }
}

// The node between two corners lies in their middle; the centre between all four.
TEST(Split, NodesHalveTheEdges) {
    for (const bool quad : {true, false}) {
        const int n = quad ? 4 : 3;
        for (int e = 0; e < n; ++e)
            EXPECT_EQ(node_place(quad, static_cast<Node>(kFirstMidpoint + e)),
                      0.5f * (node_place(quad, static_cast<Node>(e)) +
                              node_place(quad, static_cast<Node>((e + 1) % n))));
    }
    EXPECT_EQ(node_place(true, kCentre), Vec2(0.5f));
}

TEST(Split, ALeafHasNoChildren) {
    EXPECT_EQ(child_count(Split::none), 0);
}

}  // namespace
}  // namespace chiaro
