// Playing an animation under several scheduling policies, and watching the picture come right.
#include "comparison/ComparePolicies.h"

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
        scene_.root->add(ceilingLight({0, 0, 2.4f}, 0.6f, 0.6f, Rgb(300)));
        box_ = objectOf(
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

ComparisonResult compared(const std::vector<PolicyUnderTest>& policies = {{.name = "plain"}}) {
    PushedBox box;
    return comparePolicies(box.playback(3), policies, coarse());
}

TEST(ComparePolicies, StartsWithAVisibleErrorAndEndsAtTheTruth) {
    const ComparisonResult result = compared();
    ASSERT_EQ(result.policies.size(), 1u);
    const PolicyResult& plain = result.policies.front();
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

TEST(ComparePolicies, ShowsTheErrorFallBeforeAllRowsAreDone) {
    const ComparisonResult result = compared();
    const std::vector<ErrorSample>& samples = result.policies.front().frames.front();
    bool between = false;
    for (const ErrorSample& sample : samples)
        between |= sample.error.mean < 0.8 * samples.front().error.mean &&
                   sample.error.mean > 0.2 * samples.front().error.mean;
    EXPECT_TRUE(between);
}

TEST(ComparePolicies, CountsTheSameWorkEachTime) {
    const ComparisonResult one = compared(), other = compared();
    const auto& a = one.policies.front().frames.front();
    const auto& b = other.policies.front().frames.front();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].work, b[i].work);
        EXPECT_EQ(a[i].rays, b[i].rays);
        EXPECT_EQ(a[i].error.mean, b[i].error.mean);
    }
}

TEST(ComparePolicies, AllOrdersComeToTheSameEnd) {
    const ComparisonResult result = compared(usualPolicies());
    ASSERT_EQ(result.policies.size(), 5u);
    for (const PolicyResult& policy : result.policies) {
        EXPECT_LT(policy.differsFromTruth, 0.05) << policy.name;
        const double first = result.policies[0].frames[0][0].error.mean;
        EXPECT_NEAR(policy.frames[0][0].error.mean, first, 1e-3 * first) << policy.name;
    }
}

TEST(ComparePolicies, KnowingWhatComesOutIsBetterThanChance) {
    // Of direct light alone, for that is what this policy knows; fine enough for a choice.
    using Kind = PolicyUnderTest::Kind;
    ComparisonOptions options = coarse();
    options.solving.directOnly = true;
    options.meshing.elementSize = 0.0625f;
    options.filmFrame = 0;
    PushedBox box;
    const ComparisonResult result =
        comparePolicies(box.playback(2),
                        {{.kind = Kind::random, .name = "random"},
                         {.kind = Kind::random, .name = "another", .seed = 2},
                         {.kind = Kind::oracle, .name = "oracle"}},
                        options);
    const std::vector<PolicyFigures> figures = figuresOf(result);
    EXPECT_LT(figures[2].area, 0.8 * figures[0].area);
    EXPECT_LT(figures[2].area, 0.8 * figures[1].area);
}

ComparisonOptions directOnly() {
    ComparisonOptions options = coarse();
    options.solving.directOnly = true;
    options.filmFrame = 0;
    return options;
}

TEST(ComparePolicies, WhoKnowsWhatChangesDoesLessWorkForTheSamePicture) {
    PushedBox box;
    ComparisonOptions options = directOnly();
    const std::vector<PolicyUnderTest> policies = usualPolicies();
    const ComparisonResult all = comparePolicies(box.playback(4), policies, options);
    options.dirty = DirtySetKind::perfect;
    const ComparisonResult known = comparePolicies(box.playback(4), policies, options);
    for (std::size_t o = 0; o < policies.size(); ++o) {
        EXPECT_EQ(known.policies[o].differsFromTruth, 0) << policies[o].name;
        for (std::size_t i = 0; i < all.frames.size(); ++i) {
            EXPECT_LT(known.policies[o].work[i], all.policies[o].work[i]) << policies[o].name;
            EXPECT_GT(known.policies[o].work[i], 0) << policies[o].name;
            EXPECT_EQ(known.policies[o].frames[i][0].error.mean,
                      all.policies[o].frames[i][0].error.mean)
                << policies[o].name;
        }
    }
}

TEST(ComparePolicies, AViewerWhoTurnsJudgesByWhatIsSeenAtTheMoment) {
    PushedBox box;
    Playback pan = box.playback(2), still = pan;
    pan.pan = 40;
    const std::vector<PolicyUnderTest> policies = usualPolicies();
    const ComparisonResult panned = comparePolicies(pan, policies, directOnly());
    still.view = [view = pan.view](const PlacedScene& placed) {
        return turned(view(placed), {0, 0, 1}, -20); // where the viewer begins
    };
    const ComparisonResult before = comparePolicies(still, policies, directOnly());
    for (std::size_t o = 0; o < policies.size(); ++o) {
        EXPECT_EQ(panned.policies[o].frames[0].front().error.mean,
                  before.policies[o].frames[0].front().error.mean);
        EXPECT_EQ(panned.policies[o].differsFromTruth, 0) << policies[o].name;
    }
    // The policy `plain` knows nothing of the view: the same light, seen from elsewhere.
    const auto &ahead = panned.policies[0].frames[0], &aside = before.policies[0].frames[0];
    ASSERT_EQ(ahead.size(), aside.size());
    bool differ = false;
    for (std::size_t i = 0; i < ahead.size(); ++i)
        differ |= std::abs(ahead[i].error.mean - aside[i].error.mean) > 0.05 * aside[i].error.mean;
    EXPECT_TRUE(differ);
}

TEST(ComparePolicies, FilmsTheFrameThatIsAskedFor) {
    const ComparisonResult result = compared();
    EXPECT_EQ(result.filmFrame, 1);
    const std::vector<FilmPicture>& film = result.policies.front().film;
    ASSERT_EQ(film.size(), 2u);
    EXPECT_EQ(film[0].work, 0);
    EXPECT_GT(film[1].work, 0);
    EXPECT_EQ(film[0].picture.colours.size(), 64u * 48u);
    EXPECT_NE(film[0].picture.colours, result.truth.colours);
}

/// Pictures are letters in which any word may occur.
std::string withoutPictures(std::string page) {
    const std::string begins = "data:image/png;base64,";
    for (std::size_t at = 0; (at = page.find(begins, at)) != std::string::npos; ++at)
        page.erase(at, page.find('\'', at) - at);
    return page;
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
    EXPECT_THAT(withoutPictures(page), Not(HasSubstr("nan")));
}

TEST(HtmlReport, RanksNoOrderByWhatCantBeSeen) {
    PushedBox box;
    Playback away = box.playback(3);
    away.view = [view = away.view](const PlacedScene& placed) {
        return turned(view(placed), {0, 0, 1}, 180);
    };
    ComparisonResult result = comparePolicies(away, {{.name = "plain"}}, directOnly());
    EXPECT_TRUE(seenEdits(result).empty());
    const PolicyFigures figures = figuresOf(result).front();
    EXPECT_EQ(figures.area, -1);
    EXPECT_EQ(figures.work10, -1);
    EXPECT_GT(figures.work, 0);
    EXPECT_THAT(htmlReport(result, {}), HasSubstr("orders can&#39;t be ranked"));
    // One that is seen counts alone.
    result.policies[0].frames[1][0].error.mean = 1;
    EXPECT_EQ(seenEdits(result), std::vector<std::size_t>{1});
    EXPECT_THAT(htmlReport(result, {}), HasSubstr("nothing is seen of what changes in frame 1"));
    EXPECT_EQ(figuresOf(result).front().work, result.policies[0].work[1]);
    EXPECT_GE(figuresOf(result).front().area, 0);
}

TEST(HtmlReport, FiguresAreThoseOfTheCurves) {
    const ComparisonResult result = compared();
    const PolicyFigures figures = figuresOf(result).front();
    EXPECT_GT(figures.area, 0);
    EXPECT_LT(figures.area, 1);
    EXPECT_GT(figures.work10, 0);
    EXPECT_GE(figures.work1, figures.work10);
    const PolicyResult& plain = result.policies.front();
    EXPECT_GE(std::max(plain.work[0], plain.work[1]), figures.work1);
    EXPECT_EQ(figures.work, (plain.work[0] + plain.work[1]) / 2);
}

} // namespace

} // namespace penumbra
