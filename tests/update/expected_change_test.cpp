// What is expected of light that has not been looked at since an edit.
#include "update/expected_change.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// An edit's own expectation counts as 8 finds: 8 more that found nothing halve it, on that object
// and in that channel alone.
TEST(ExpectedChange, WhatIsFoundOnAnObjectIsExpectedOfTheRestOfIt) {
    ExpectedChange change;
    for (int channel = 0; channel < 2; ++channel) change.expect(2, channel, 0.5f);
    for (int i = 0; i < 8; ++i) change.found(ObjectId{1}, 0, 0);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{1}, 0), 0.25f);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{1}, 1), 0.5f);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{0}, 0), 0.5f);
    for (int i = 0; i < 16; ++i) change.found(ObjectId{1}, 0, 1);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{1}, 0), (4.0f + 16) / 32);
}

// Of one object more may be expected than of all, and not less; the others stay as they are.
TEST(ExpectedChange, MoreMayBeExpectedOfOneObject) {
    ExpectedChange change;
    change.expect(2, 0, 0.1f);
    change.expect_of(ObjectId{1}, 0, 0.5f);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{1}, 0), 0.5f);
    change.expect_of(ObjectId{1}, 0, 0.2f);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{1}, 0), 0.5f);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{0}, 0), 0.1f);
}

// The next edit is another: what was found counts half, and a smaller expectation does not take
// back that things were changing.
TEST(ExpectedChange, EditsThatGoOnKeepHalfOfWhatWasFound) {
    ExpectedChange change;
    change.expect(1, 0, 0.02f);
    for (int i = 0; i < 8; ++i) change.found(ObjectId{0}, 0, 1);
    const float before = change.relative2(ObjectId{0}, 0);
    EXPECT_FLOAT_EQ(before, (8 * 0.02f + 8) / 16);
    change.expect(1, 0, 0.02f);
    EXPECT_FLOAT_EQ(change.relative2(ObjectId{0}, 0), (8 * 0.5f * before + 4) / 12);
}

// However much was found of a harmless edit, it does not drown what the next one lets expect.
TEST(ExpectedChange, TheNextEditIsExpectedAnew) {
    ExpectedChange change;
    change.expect(1, 0, 0.02f);
    for (int i = 0; i < 10'000; ++i) change.found(ObjectId{0}, 0, 0);
    change.expect(1, 0, 1);
    EXPECT_NEAR(change.relative2(ObjectId{0}, 0), 0.5f, 1e-3f);
}

// Noise is subtracted from what is found, so that nothing may be less than that; and one place that
// was nearly black before counts as a few.
TEST(ExpectedChange, NothingIsTheLeast) {
    ExpectedChange change;
    change.expect(1, 0, 0);
    EXPECT_EQ(change.relative2(ObjectId{0}, 0), ExpectedChange::kLeast);
    change.found(ObjectId{0}, 0, -1);
    EXPECT_EQ(change.relative2(ObjectId{0}, 0), ExpectedChange::kLeast);
    change.expect(1, 0, 0);
    change.found(ObjectId{0}, 0, 1e6f);
    EXPECT_LT(change.relative2(ObjectId{0}, 0), 1);
}

}  // namespace
}  // namespace chiaro
