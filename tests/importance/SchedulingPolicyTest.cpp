// Ways of ordering dirty blocks.
#include "importance/SchedulingPolicy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

namespace penumbra {

namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;
using Ids = std::vector<std::uint64_t>;

/// Indices of pieces of work, in the order that comes of it.
Ids sorted(SchedulingPolicy& policy, const std::vector<CandidateBlock>& work) {
    WorkQueue queue;
    for (std::size_t i = 0; i < work.size(); ++i) {
        WorkQueue::Task task = policy.rank(work[i]);
        task.id = i;
        queue.add(task);
    }
    queue.rekey([&](std::uint32_t cluster) { return policy.value(cluster); });
    Ids ids;
    while (const auto task = queue.take(0)) ids.push_back(task->id);
    return ids;
}
Ids sorted(SchedulingPolicy&& policy, const std::vector<CandidateBlock>& work) {
    return sorted(policy, work);
}

/// Two senders and two blocks; the second sender's light on the second block may change most.
const std::vector<CandidateBlock> kWork{{.row = 1, .block = 0, .bound = 5, .cost = 10},
                                        {.row = 1, .block = 1, .bound = 40, .cost = 20},
                                        {.row = 0, .block = 0, .bound = 3, .cost = 10},
                                        {.row = 0, .block = 1, .bound = 1, .cost = 1}};

TEST(PlainPolicy, GoesSenderBySender) {
    EXPECT_THAT(sorted(PlainPolicy(), kWork), ElementsAre(2, 3, 0, 1));
}

TEST(PlainPolicy, TellsAMillionSendersApart) {
    const PlainPolicy plain;
    for (const std::uint32_t row : {0u, 999u, 1'000'000u})
        EXPECT_GT(float(plain.priority({.row = row})), float(plain.priority({.row = row + 1})));
}

TEST(BoundPolicy, TakesWhatMayChangeMostPerCost) {
    EXPECT_THAT(sorted(BoundPolicy(), kWork), ElementsAre(1, 3, 0, 2)); // 2, 1, 0.5, 0.3
}

TEST(RandomPolicy, IsAnyOrderButTheSameForTheSameSeed) {
    const Ids first = sorted(RandomPolicy(1), kWork);
    EXPECT_THAT(first, UnorderedElementsAre(0, 1, 2, 3));
    EXPECT_EQ(first, sorted(RandomPolicy(1), kWork));
    bool other = false;
    for (std::uint32_t seed = 2; seed < 8; ++seed)
        other |= sorted(RandomPolicy(seed), kWork) != first;
    EXPECT_TRUE(other);
}

TEST(RandomPolicy, PrefersNoRowAndNoBlock) {
    std::vector<CandidateBlock> work;
    for (std::uint32_t row = 0; row < 20; ++row)
        for (std::uint32_t block = 0; block < 50; ++block)
            work.push_back({.row = row, .block = block, .bound = 1, .cost = 1});
    const Ids ids = sorted(RandomPolicy(3), work);
    double rows = 0, blocks = 0; // means over the first half
    for (std::size_t i = 0; i < 500; ++i) {
        rows += work[ids[i]].row / 500.0;
        blocks += work[ids[i]].block / 500.0;
    }
    EXPECT_NEAR(rows, 9.5, 1.0); // standard deviation of the mean: 0.26, 0.65
    EXPECT_NEAR(blocks, 24.5, 2.5);
}

/// A camera that looks along -Z.
class TwoPlaces : public testing::Test {
protected:
    static Attention looking(double turn) { // about the vertical [degrees]
        glm::dmat4 camera(1.0);
        const double c = std::cos(glm::radians(turn)), s = std::sin(glm::radians(turn));
        camera[0] = {c, 0, -s, 0}, camera[2] = {s, 0, c, 0};
        Lens lens;
        lens.focalLength = 1;
        lens.horizontalAperture = 2;
        const Viewpoint viewpoint(makeView(lens, camera, 100, 100), 100, 100);
        return {viewpoint, Gaze(viewpoint), 50, {}, {}};
    }
};

/// Knows block 0 in front of the camera and block 1 behind it; all receivers of a block alike but
/// for the first two, of 100 pixels and of one.
class TwoClusters : public ImportancePolicy {
public:
    using ImportancePolicy::ImportancePolicy;
    void attend(const Attention& attention) { setAttention(attention); }

    std::uint64_t asked = 0; ///< receivers, of the last block

protected:
    ViewSample sample(std::uint32_t cluster) override {
        const glm::vec3 at = cluster == 0 ? glm::vec3(0, 0, -5) : glm::vec3(0, 0, 5);
        ReceiverCluster known;
        known.box.add(at - 0.1f), known.box.add(at + 0.1f);
        known.normal = glm::vec3(0, 0, cluster == 0 ? 1 : -1);
        known.area = 0.04f;
        known.luminance = 50;
        return {known, {}};
    }
    void sampleClosely(std::uint32_t, std::uint64_t which,
                       std::span<ClusterPriority> values) override {
        asked = which;
        values[0] = {100, 1, false}, values[1] = {1, 1, false}; // pixels; steps per nit
    }
};

TEST_F(TwoPlaces, ImportanceTakesWhatTheViewerSees) {
    TwoClusters policy({0, 1});
    policy.attend(looking(0));
    // Sender 1 may change 8 times as much on what is behind the viewer; it comes last all the same.
    EXPECT_THAT(sorted(policy, kWork), ElementsAre(0, 2, 1, 3));
    policy.attend(looking(180));
    EXPECT_THAT(sorted(policy, kWork), ElementsAre(1, 3, 0, 2));
}

TEST_F(TwoPlaces, ImportanceGainsWhereReceiversAreSeen) {
    TwoClusters policy({0, 1});
    EXPECT_FALSE(policy.probes()) << "nobody is there";
    policy.attend(looking(0));
    EXPECT_TRUE(policy.probes());
    const std::uint32_t view = policy.view();
    policy.attend(looking(1));
    EXPECT_NE(policy.view(), view);
    const float nit = std::numbers::pi_v<float>; // in what is reflected [lm/m^2]
    const std::vector<float> change{nit, nit, 0};
    std::vector<float> gains(3);
    policy.gains({}, change, gains);
    EXPECT_EQ(policy.asked, 0b11u);
    EXPECT_NEAR(gains[0], 100 * 0.5, 1e-3); // g(1) = 1/2
    EXPECT_NEAR(gains[1], 0.5, 1e-5);
    EXPECT_EQ(gains[2], 0);
}

TEST_F(TwoPlaces, ImportanceCountsWhatHasNoPlaceAsSomethingInView) {
    TwoClusters policy({ReceiverClusters::kNowhere, 1});
    policy.attend(looking(0));
    EXPECT_THAT(sorted(policy, {{.row = 0, .block = 0, .bound = 99, .cost = 1},
                                {.row = 0, .block = 7, .bound = 9, .cost = 1},
                                {.row = 0, .block = 1, .bound = 1, .cost = 1}}),
                ElementsAre(0, 1, 2));
}

} // namespace

} // namespace penumbra
