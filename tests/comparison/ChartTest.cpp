// Curves as an SVG drawing.
#include "comparison/Chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::Not;

std::string sample() {
    return lineChart({{"plain", {{0, 8}, {1000, 4}, {100'000, 0}}}, {"<i>", {{0, 8}, {2000, 1}}}},
                     {.title = "A & B", .xLabel = "work [rays]", .yLabel = "error [JND]"});
}

TEST(Chart, HasACurveAndALegendEntryForEachSeries) {
    const std::string svg = sample();
    std::size_t paths = 0;
    for (std::size_t at = svg.find("<path"); at != std::string::npos;
         at = svg.find("<path", at + 1))
        ++paths;
    EXPECT_EQ(paths, 2u);
    EXPECT_THAT(svg, HasSubstr(">plain</text>"));
    EXPECT_THAT(svg, HasSubstr("work [rays]"));
    EXPECT_THAT(svg, HasSubstr("error [JND]"));
    EXPECT_THAT(svg, HasSubstr(">10 k</text>")); // a tick
}

TEST(Chart, MakesTextHarmless) {
    EXPECT_THAT(sample(), HasSubstr("A &amp; B"));
    EXPECT_THAT(sample(), HasSubstr("&lt;i&gt;"));
    EXPECT_THAT(sample(), Not(HasSubstr("<i>")));
    EXPECT_EQ(escaped("\"a'"), "&quot;a&#39;");
}

TEST(Chart, CallsNothingFromElsewhere) {
    std::string svg = sample();
    const std::string name = "http://www.w3.org/2000/svg"; // names SVG, is not fetched
    svg.erase(svg.find(name), name.size());
    EXPECT_THAT(svg, Not(HasSubstr("http")));
    EXPECT_THAT(svg, Not(HasSubstr("<script")));
}

TEST(Chart, SwallowsWhatHasNothingToShow) {
    for (const std::vector<CurvePoint>& points :
         {std::vector<CurvePoint>{}, {{0, 0}}, {{0, 0}, {5, 0}}}) {
        const std::string svg =
            lineChart({{"none", points}}, {.title = "t", .xLabel = "x", .yLabel = "y"});
        EXPECT_THAT(svg, Not(HasSubstr("nan")));
        EXPECT_THAT(svg, Not(HasSubstr("inf")));
    }
}

TEST(Chart, WritesNumbersForPeople) {
    EXPECT_EQ(figure(0.12345), "0.123");
    EXPECT_EQ(figure(1234), "1234");
    EXPECT_EQ(figure(45'678), "45.7 k");
    EXPECT_EQ(figure(3.2e6), "3.2 M");
    EXPECT_EQ(figure(0), "0");
}

TEST(Chart, TellsItsSeriesApart) {
    for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(seriesColour(a), seriesColour(b));
}

} // namespace

} // namespace penumbra
