// Playing an animation under several orders of work, and watching the picture come right.
#include "comparison/CompareOrders.h"

#include "comparison/HtmlReport.h"
#include "tests/support/Scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::Not;

/// A box that is pushed across the floor of a lit room, a step a frame.
class PushedBox {
public:
    PushedBox() {
        scene_.root->add(object("room", boxData({-2, -2, 0}, {2, 2, 2.5f}, true)));
        scene_.root->add(ceilingLamp({0, 0, 2.4f}, 0.6f, 0.6f, Rgb(300)));
        box_ = movable(
            "box", {std::make_shared<Mesh>("mesh", boxData({-0.3f, -0.3f, 0}, {0.3f, 0.3f, 0.8f},
                                                           false, paint(Rgb(0.3f))))});
        scene_.root->add(box_);
    }

    Playback playback(int frames) {
        Playback playback;
        for (int frame = 0; frame < frames; ++frame) playback.frames.push_back(frame);
        playback.show = [this](double frame) {
            box_->setMatrix(moved(-0.8 + 0.5 * frame, 0.4, 0));
            return placeScene(scene_);
        };
        playback.view = [](const PlacedScene&) {
            Lens lens;
            lens.focalLength = 1;
            lens.horizontalAperture = 1.8f;
            glm::dmat4 camera(1.0); // looks along +y, its up is z
            camera[1] = {0, 0, 1, 0}, camera[2] = {0, -1, 0, 0}, camera[3] = {0, -1.9, 1.4, 1};
            return makeView(lens, camera, 64, 48);
        };
        return playback;
    }

private:
    Scene scene_;
    std::shared_ptr<Transform> box_;
};

ComparisonOptions coarse() {
    ComparisonOptions options;
    options.meshing = {.patchSize = 0.5f, .elementSize = 0.125f};
    options.solving.residual = 1e-5;
    options.width = 64;
    options.height = 48;
    options.firstLook = 600;
    options.filmSeconds = {0, 1e-6};
    options.filmFrame = 1;
    return options;
}

ComparisonResult compared(const std::vector<OrderUnderTest>& orders = {{.name = "plain"}}) {
    PushedBox box;
    return compareOrders(box.playback(3), orders, coarse());
}

TEST(CompareOrders, StartsWithAVisibleErrorAndEndsAtTheTruth) {
    const ComparisonResult result = compared();
    ASSERT_EQ(result.orders.size(), 1u);
    const OrderResult& plain = result.orders.front();
    ASSERT_EQ(plain.frames.size(), 2u);
    for (const std::vector<ErrorSample>& samples : plain.frames) {
        ASSERT_GT(samples.size(), 5u);
        EXPECT_EQ(samples.front().work, 0);
        EXPECT_EQ(samples.front().rays, 0u);
        EXPECT_GT(samples.front().error.p99, 2);
        EXPECT_LT(samples.back().error.most, 0.05);
        EXPECT_GT(samples.back().rays, 100u);
        for (std::size_t i = 1; i < samples.size(); ++i) {
            EXPECT_GE(samples[i].work, samples[i - 1].work);
            EXPECT_GE(samples[i].seconds, samples[i - 1].seconds);
        }
    }
    EXPECT_LT(plain.differsFromTruth, 0.05);
}

TEST(CompareOrders, ShowsTheErrorFallBeforeAllRowsAreDone) {
    const ComparisonResult result = compared();
    const std::vector<ErrorSample>& samples = result.orders.front().frames.front();
    bool between = false;
    for (const ErrorSample& sample : samples)
        between |= sample.error.mean < 0.8 * samples.front().error.mean &&
                   sample.error.mean > 0.2 * samples.front().error.mean;
    EXPECT_TRUE(between);
}

TEST(CompareOrders, CountsTheSameWorkEachTime) {
    const ComparisonResult one = compared(), other = compared();
    const auto& a = one.orders.front().frames.front();
    const auto& b = other.orders.front().frames.front();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].work, b[i].work);
        EXPECT_EQ(a[i].rays, b[i].rays);
        EXPECT_EQ(a[i].error.mean, b[i].error.mean);
    }
}

TEST(CompareOrders, AllOrdersComeToTheSameEnd) {
    const ComparisonResult result = compared(usualOrders());
    ASSERT_EQ(result.orders.size(), 5u);
    for (const OrderResult& order : result.orders) {
        EXPECT_LT(order.differsFromTruth, 0.05) << order.name;
        const double first = result.orders[0].frames[0][0].error.mean;
        EXPECT_NEAR(order.frames[0][0].error.mean, first, 1e-3 * first) << order.name;
    }
}

TEST(CompareOrders, KnowingWhatComesOutIsBetterThanChance) {
    // Of direct light alone, for that is what this order knows; fine enough for a choice.
    using Kind = OrderUnderTest::Kind;
    ComparisonOptions options = coarse();
    options.solving.directOnly = true;
    options.meshing.elementSize = 0.0625f;
    options.filmFrame = 0;
    PushedBox box;
    const ComparisonResult result =
        compareOrders(box.playback(2),
                      {{.kind = Kind::random, .name = "random"},
                       {.kind = Kind::random, .name = "another", .seed = 2},
                       {.kind = Kind::oracle, .name = "oracle"}},
                      options);
    const std::vector<OrderFigures> figures = figuresOf(result);
    EXPECT_LT(figures[2].area, 0.8 * figures[0].area);
    EXPECT_LT(figures[2].area, 0.8 * figures[1].area);
}

ComparisonOptions directOnly() {
    ComparisonOptions options = coarse();
    options.solving.directOnly = true;
    options.filmFrame = 0;
    return options;
}

TEST(CompareOrders, WhoKnowsWhatChangesDoesLessWorkForTheSamePicture) {
    PushedBox box;
    ComparisonOptions options = directOnly();
    const std::vector<OrderUnderTest> orders = usualOrders();
    const ComparisonResult all = compareOrders(box.playback(4), orders, options);
    options.dirty = DirtySet::perfect;
    const ComparisonResult known = compareOrders(box.playback(4), orders, options);
    for (std::size_t o = 0; o < orders.size(); ++o) {
        EXPECT_EQ(known.orders[o].differsFromTruth, 0) << orders[o].name;
        for (std::size_t i = 0; i < all.frames.size(); ++i) {
            EXPECT_LT(known.orders[o].work[i], all.orders[o].work[i]) << orders[o].name;
            EXPECT_GT(known.orders[o].work[i], 0) << orders[o].name;
            EXPECT_EQ(known.orders[o].frames[i][0].error.mean,
                      all.orders[o].frames[i][0].error.mean)
                << orders[o].name;
        }
    }
}

TEST(CompareOrders, AViewerWhoTurnsJudgesByWhatIsSeenAtTheMoment) {
    PushedBox box;
    Playback pan = box.playback(2), still = pan;
    pan.pan = 40;
    const std::vector<OrderUnderTest> orders = usualOrders();
    const ComparisonResult panned = compareOrders(pan, orders, directOnly());
    still.view = [view = pan.view](const PlacedScene& placed) {
        return turned(view(placed), {0, 0, 1}, -20); // where the viewer begins
    };
    const ComparisonResult before = compareOrders(still, orders, directOnly());
    for (std::size_t o = 0; o < orders.size(); ++o) {
        EXPECT_EQ(panned.orders[o].frames[0].front().error.mean,
                  before.orders[o].frames[0].front().error.mean);
        EXPECT_EQ(panned.orders[o].differsFromTruth, 0) << orders[o].name;
    }
    // Plain order knows nothing of the view: the same light, seen from elsewhere.
    const auto &ahead = panned.orders[0].frames[0], &aside = before.orders[0].frames[0];
    ASSERT_EQ(ahead.size(), aside.size());
    bool differ = false;
    for (std::size_t i = 0; i < ahead.size(); ++i)
        differ |= std::abs(ahead[i].error.mean - aside[i].error.mean) > 0.05 * aside[i].error.mean;
    EXPECT_TRUE(differ);
}

TEST(CompareOrders, FilmsTheFrameThatIsAskedFor) {
    const ComparisonResult result = compared();
    EXPECT_EQ(result.filmFrame, 1);
    const std::vector<FilmPicture>& film = result.orders.front().film;
    ASSERT_EQ(film.size(), 2u);
    EXPECT_EQ(film[0].work, 0);
    EXPECT_GT(film[1].work, 0);
    EXPECT_EQ(film[0].picture.colours.size(), 64u * 48u);
    EXPECT_NE(film[0].picture.colours, result.truth.colours);
}

TEST(HtmlReport, SaysAllThatWasFoundInOneFile) {
    const ComparisonResult result = compared();
    const std::string page = htmlReport(
        result, {.title = "a <room>", .settings = {{"scene", "r&d"}}, .machine = {{"cpu", "x"}}});
    EXPECT_THAT(page, HasSubstr("<title>a &lt;room&gt;</title>"));
    EXPECT_THAT(page, HasSubstr("<td>r&amp;d</td>"));
    EXPECT_THAT(page, HasSubstr("plain</td>"));
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("mean visible error [JND]"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(page, Not(HasSubstr("src='http")));
    EXPECT_THAT(page, Not(HasSubstr("url(http")));
    EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST(HtmlReport, RanksNoOrderByWhatCantBeSeen) {
    PushedBox box;
    Playback away = box.playback(3);
    away.view = [view = away.view](const PlacedScene& placed) {
        return turned(view(placed), {0, 0, 1}, 180);
    };
    ComparisonResult result = compareOrders(away, {{.name = "plain"}}, directOnly());
    EXPECT_TRUE(seenEdits(result).empty());
    const OrderFigures figures = figuresOf(result).front();
    EXPECT_EQ(figures.area, -1);
    EXPECT_EQ(figures.work10, -1);
    EXPECT_GT(figures.work, 0);
    EXPECT_THAT(htmlReport(result, {}), HasSubstr("orders can&#39;t be ranked"));
    // One that is seen counts alone.
    result.orders[0].frames[1][0].error.mean = 1;
    EXPECT_EQ(seenEdits(result), std::vector<std::size_t>{1});
    EXPECT_THAT(htmlReport(result, {}), HasSubstr("nothing is seen of what changes in frame 1"));
    EXPECT_EQ(figuresOf(result).front().work, result.orders[0].work[1]);
    EXPECT_GE(figuresOf(result).front().area, 0);
}

TEST(HtmlReport, FiguresAreThoseOfTheCurves) {
    const ComparisonResult result = compared();
    const OrderFigures figures = figuresOf(result).front();
    EXPECT_GT(figures.area, 0);
    EXPECT_LT(figures.area, 1);
    EXPECT_GT(figures.work10, 0);
    EXPECT_GE(figures.work1, figures.work10);
    const OrderResult& plain = result.orders.front();
    EXPECT_GE(std::max(plain.work[0], plain.work[1]), figures.work1);
    EXPECT_EQ(figures.work, (plain.work[0] + plain.work[1]) / 2);
}

} // namespace

} // namespace penumbra
