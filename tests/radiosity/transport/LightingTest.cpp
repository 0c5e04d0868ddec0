// Light at vertices, taken together.
#include "radiosity/transport/Lighting.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Lighting, OfAnElementIsTheMeanOfAllLightAtItsCornersEachCountedOnce) {
    const Lighting light{{Rgb(1), Rgb(2), Rgb(3), Rgb(10)}, {Rgb(0), Rgb(1), Rgb(5), Rgb(2)}};
    Element quadrilateral, triangle;
    quadrilateral.vertices = {0, 1, 2, 3};
    triangle.vertices = {0, 1, 2, 2};
    EXPECT_EQ(elementMean(quadrilateral, light), Rgb(6)); // (1 + 3 + 8 + 12) / 4
    EXPECT_EQ(elementMean(triangle, light), Rgb(4));      // (1 + 3 + 8) / 3
}

} // namespace

} // namespace penumbra
