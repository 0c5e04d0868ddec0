// Patches by the nodes at which they receive.
#include "radiosity/mesh/NodePatches.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {

namespace {

TEST(NodePatches, AreThoseThatReceiveThereInOrder) {
    const BuiltPatches built =
        meshed(sceneOf({object("room", boxData({-1, -1, 0}, {1, 1, 2}, true))}),
               {.patchSize = 0.5f, .elementSize = 0.5f});
    const PatchSet& set = built.patches;
    const NodePatches patches(set);
    std::size_t shared = 0;
    for (std::uint32_t n = 0; n < set.nodes.size(); ++n) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
            const Patch& patch = set.patches[p];
            const auto& corners = patch.cornerNodes;
            if (patch.centreNode == n ||
                (patch.hasCornerNodes && std::count(corners.begin(), corners.end(), n) > 0))
                expected.push_back(p);
        }
        const auto found = patches.of(n);
        EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected) << "node " << n;
        shared += expected.size() > 1;
    }
    EXPECT_GT(shared, 0u);
}

} // namespace

} // namespace penumbra
