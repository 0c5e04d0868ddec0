#include "radiosity/schedule/Pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace penumbra {
namespace {

constexpr double kPerRay = 1e-7; ///< that work takes in these tests [s]
constexpr std::size_t kMost = 1u << 20;

double& clock() {
    static double time = 0;
    return time;
}
double fakeTime() {
    return clock();
}

/// Work of which so much is left, as a piece.
struct Work {
    std::size_t left; ///< [rays]
    double perRay = kPerRay;
    std::size_t asked = 0; ///< of the last piece

    bool operator()(std::size_t effort) {
        if (left == 0) return false;
        asked = effort;
        const std::size_t done = std::min(effort, left);
        left -= done;
        clock() += perRay * double(done);
        return true;
    }
};

/// One that knows how long work takes; `work` has been asked for as much as it does in that time.
Pace settled(Work& work) {
    Pace pace(&fakeTime);
    pace.aim(1e-3, kMost);
    for (int i = 0; i < 30; ++i) pace.work(Pace::direct, std::ref(work));
    return pace;
}

TEST(Pace, PiecesComeToTakeAsLongAsIsWanted) {
    Pace pace(&fakeTime);
    for (const double wanted : {2e-3, 5e-4}) {
        pace.aim(wanted, kMost);
        Work work{100 * kMost};
        for (int i = 0; i < 30; ++i) pace.work(Pace::direct, std::ref(work));
        EXPECT_NEAR(double(work.asked) * kPerRay, wanted, 0.01 * wanted);
    }
}

TEST(Pace, WorkThatRunsOutDoesNotMakeTheNextPieceLarger) {
    Work work{100 * kMost};
    Pace pace = settled(work);
    const std::size_t usual = work.asked;
    for (int edit = 0; edit < 50; ++edit) {
        work.left = usual / 100;
        while (pace.work(Pace::direct, std::ref(work))) {
        }
    }
    work.left = kMost;
    pace.work(Pace::direct, std::ref(work));
    EXPECT_LE(work.asked, usual + usual / 10);
}

TEST(Pace, APieceThatTookTooLongCountsAtOnce) {
    Work work{100 * kMost};
    Pace pace = settled(work);
    const std::size_t usual = work.asked;
    work.perRay = 1.5 * kPerRay;
    pace.work(Pace::direct, std::ref(work));
    pace.work(Pace::direct, std::ref(work));
    EXPECT_NEAR(double(work.asked), double(usual) / 1.5, 0.01 * double(usual));
}

TEST(Pace, WhatOneKindOfWorkTakesSaysNothingOfOthers) {
    Pace pace(&fakeTime);
    pace.aim(1e-3, kMost);
    const double known = pace.secondsPerRay(Pace::rows);
    Work work{kMost};
    for (int i = 0; i < 5; ++i) pace.work(Pace::direct, std::ref(work));
    EXPECT_LT(pace.secondsPerRay(Pace::direct), known);
    EXPECT_EQ(pace.secondsPerRay(Pace::rows), known);
}

} // namespace
} // namespace penumbra
