// Pictures that are part of a page.
#include "comparison/ReportImages.h"

#include "io/image/ToneCurve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

namespace penumbra {

namespace {

using testing::StartsWith;

std::string encoded(const std::string& text) {
    return base64(std::as_bytes(std::span(text.data(), text.size())));
}

TEST(Base64, IsThatOfTheStandard) { // RFC 4648, section 10
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foob"), "Zm9vYg==");
    EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(ReportImages, ArePngFilesWithinTheirAddress) {
    const Picture picture{4, 2, std::vector<Rgb>(8, Rgb(50)), {50}};
    const std::string uri = pictureUri(picture, toneFor(picture));
    EXPECT_THAT(uri, StartsWith("data:image/png;base64,iVBORw0KGgo")); // the signature of PNG
    EXPECT_THAT(differenceUri(Plane(4, 2, 1)), StartsWith("data:image/png;base64,iVBORw0KGgo"));
}

TEST(ReportImages, AreExposedByWhatIsMeteredAndTonedAsTheWindowIs) {
    const Picture dim{1, 1, {Rgb(50)}, {50}}, bright{1, 1, {Rgb(50)}, {500}};
    EXPECT_NEAR(toneFor(dim)(Rgb(50)).g, 0.18, 1e-4);
    const ToneCurve agx(ToneStyle::agx);
    EXPECT_NEAR(toneFor(bright)(Rgb(90, 50, 10)).r, agx.shown(Rgb(90, 50, 10) * 0.00036f).r, 1e-4);
    const Picture black{1, 1, {Rgb(0)}, {}};
    EXPECT_EQ(toneFor(black)(Rgb(0)), Rgb(0));
}

TEST(ReportImages, ShowDifferencesOnAScaleThatEndsOnBothSides) {
    EXPECT_EQ(differenceUri(Plane(4, 2, 0)), differenceUri(Plane(4, 2, 0.25f)));
    EXPECT_EQ(differenceUri(Plane(4, 2, 16)), differenceUri(Plane(4, 2, 1e9f)));
    EXPECT_NE(differenceUri(Plane(4, 2, 1)), differenceUri(Plane(4, 2, 2)));
}

} // namespace

} // namespace penumbra
