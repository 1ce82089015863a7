#include "base/error.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

TEST(Error, ReadsWhereWhatRemedyInOneLine) {
    const Error error("room.obj:12", "vertex 9 does not exist", "count from 1");
    EXPECT_STREQ(error.what(), "room.obj:12: vertex 9 does not exist; count from 1");
    EXPECT_EQ(error.where(), "room.obj:12");
    EXPECT_EQ(error.remedy(), "count from 1");
}

TEST(Error, LeavesOutARemedyThatIsNotThere) {
    EXPECT_STREQ(Error("--size", "not two numbers").what(), "--size: not two numbers");
}

TEST(CheckDeathTest, ABreachEndsTheProgramAndSaysWhich) {
    EXPECT_DEATH(check(false, "two is odd"), "chiaro: internal error: two is odd");
    check(true, "nothing happens");
}

}  // namespace
}  // namespace chiaro
