// The dirty status that is published while somebody watches, and that it is true.
#include "tests/support/LitNode.h"
#include "tests/support/SteppedLink.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>

namespace penumbra {

namespace {

using Kind = DirtyStatus::Kind;

/// A room whose worker takes a step a frame.
class WatchedRoom {
public:
    void frame() {
        link_->step(1e-9); // one piece of work
        room.node->update();
    }
    template <class Look>
    bool settle(Look look) {
        for (int i = 0; i < 20'000; ++i) {
            frame();
            look();
            if (room.node->state().reached(SolutionState::exact)) return true;
        }
        return false;
    }
    /// The dirty status is published anew only now and then.
    template <class Until>
    bool frameUntil(Until until) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (!until() && std::chrono::steady_clock::now() < end) frame();
        return until();
    }
    /// Blocks of each kind, of objects that have light.
    std::map<Kind, int> count() const {
        std::map<Kind, int> kinds;
        const auto work = room.node->dirtyBlocks();
        for (std::size_t o = 0; o < work.size(); ++o)
            for (const DirtyStatus& block : work[o]) ++kinds[block.kind];
        return kinds;
    }
    /// From a corner of the room to its middle.
    void look() {
        const glm::dvec3 eye(0.9, 0.9, 1.5);
        const glm::dmat4 toCamera = glm::lookAt(eye, glm::dvec3(0, 0, 0.5), glm::dvec3(0, 0, 1));
        room.node->setCamera({toCamera, glm::perspective(1.0, 1.5, 0.01, 100.0), eye});
    }

private:
    std::unique_ptr<LightingLink> takeLink() {
        auto link = std::make_unique<SteppedLink>();
        link_ = link.get();
        return link;
    }
    SteppedLink* link_ = nullptr;

public:
    LitRoom room{takeLink()};
};

TEST(WatchedDirtySet, IsSaidOfEachBlockAndGoneInTheEnd) {
    WatchedRoom watched;
    RadiosityNode& node = *watched.room.node;
    node.watchDirty(true);
    watched.look();
    ASSERT_TRUE(watched.settle([] {})) << describe(node);
    watched.room.box->setMatrix(glm::translate(glm::dmat4(1.0), {0.5, 0, 0}));
    std::map<Kind, int> most;
    float priority = 0;
    ASSERT_TRUE(watched.settle([&] {
        for (const auto& [kind, blocks] : watched.count())
            most[kind] = std::max(most[kind], blocks);
        for (const auto& object : node.dirtyBlocks())
            for (const DirtyStatus& block : object) {
                priority = std::max(priority, block.priority);
                EXPECT_TRUE(block.rows > 0 || (block.priority == 0 && block.kind != Kind::lights));
            }
    })) << describe(node);
    EXPECT_GT(most[Kind::lights], 0);
    EXPECT_GT(priority, 0);
    EXPECT_TRUE(watched.frameUntil([&] { return watched.count().size() == 1; }));
    EXPECT_GT(watched.count()[Kind::none], 0);
    for (std::size_t o = 0; o < node.objects().size(); ++o) {
        const auto& geometry = node.objects()[o].geometry;
        if (!geometry) continue;
        EXPECT_EQ(node.dirtyBlocks()[o].size(), geometry->blockRevisions().size());
    }
}

TEST(WatchedDirtySet, IsNotSaidIfNobodyWatches) {
    WatchedRoom watched;
    RadiosityNode& node = *watched.room.node;
    ASSERT_TRUE(watched.settle([] {}));
    EXPECT_TRUE(node.dirtyBlocks().empty());
    node.watchDirty(true);
    EXPECT_TRUE(watched.frameUntil([&] { return !watched.count().empty(); }));
    node.watchDirty(false);
    EXPECT_TRUE(node.dirtyBlocks().empty());
    // What was published then is no answer to those who ask now.
    node.watchDirty(true);
    node.update();
    EXPECT_TRUE(watched.count().empty());
}

TEST(WatchedDirtySet, AnotherWorkerIsAskedAsWell) {
    WatchedRoom watched;
    RadiosityNode& node = *watched.room.node;
    node.watchDirty(true);
    ASSERT_TRUE(watched.settle([] {}));
    node.stop();
    node.start();
    ASSERT_TRUE(watched.settle([] {}));
    EXPECT_TRUE(watched.frameUntil([&] { return !watched.count().empty(); }));
}

} // namespace

} // namespace penumbra
