#include "base/image.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

TEST(Image, StartsBlackAndIsStoredInRowsFromTheTop) {
    Image image(3, 2);
    ASSERT_EQ(image.pixels.size(), 6u);
    for (const Rgb& pixel : image.pixels) EXPECT_EQ(pixel, Rgb(0));
    image.at(2, 1) = {1, 2, 3};
    EXPECT_EQ(image.pixels[5], Rgb(1, 2, 3));
    EXPECT_EQ(const_cast<const Image&>(image).at(2, 1), Rgb(1, 2, 3));
}

TEST(Image, WithoutASizeIsEmpty) {
    const Image image;
    EXPECT_EQ(image.width, 0);
    EXPECT_EQ(image.height, 0);
    EXPECT_TRUE(image.pixels.empty());
}

}  // namespace
}  // namespace chiaro
