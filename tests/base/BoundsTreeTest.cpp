// Boxes found through the hierarchy, against a test of each of them.
#include "base/BoundsTree.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace penumbra {

namespace {

Bounds randomBox() {
    const auto number = [] { return float(*rc::gen::inRange(0, 20)); };
    if (*rc::gen::inRange(0, 6) == 0) return {}; // a block of padding
    const glm::vec3 lower(number(), number(), number());
    return {lower, lower + glm::vec3(number(), number(), number()) / 4.0f};
}

std::vector<std::size_t> found(const BoundsTree& tree, const Bounds& target) {
    std::vector<std::size_t> indices;
    tree.query([&](std::size_t n) { return tree.node(n).overlaps(target); },
               [&](std::size_t i) { indices.push_back(i); });
    return indices;
}

std::vector<std::size_t> searched(const std::vector<Bounds>& boxes, const Bounds& target) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].empty() && boxes[i].overlaps(target)) indices.push_back(i);
    return indices;
}

RC_GTEST_PROP(BoundsTree, FindsInOrderWhatASearchFindsHoweverItWasMade, ()) {
    std::vector<Bounds> boxes;
    for (int i = *rc::gen::inRange(0, 40); i > 0; --i) boxes.push_back(randomBox());
    BoundsTree tree(boxes);
    for (int i = *rc::gen::inRange(0, 60); i > 0; --i) {
        if (boxes.empty() || *rc::gen::inRange(0, 2) == 0) {
            boxes.push_back(randomBox());
            tree.append(boxes.back());
        } else {
            const std::size_t place = *rc::gen::inRange<std::size_t>(0, boxes.size());
            boxes[place] = randomBox();
            tree.set(place, boxes[place]);
        }
        const Bounds target = randomBox();
        RC_ASSERT(found(tree, target) == searched(boxes, target));
    }
    RC_ASSERT(tree.size() == boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        RC_ASSERT(tree[i].lower == boxes[i].lower);
        RC_ASSERT(tree[i].upper == boxes[i].upper);
    }
}

TEST(BoundsTree, LooksAtFewNodesWhenFewBoxesMeet) {
    std::vector<Bounds> row;
    for (int i = 0; i < 1024; ++i) row.push_back({{i, 0, 0}, {i + 1, 1, 1}});
    const BoundsTree tree(row);
    std::size_t looked = 0;
    const Bounds target{{700.5f, 0, 0}, {700.6f, 1, 1}};
    tree.query([&](std::size_t n) { return ++looked, tree.node(n).overlaps(target); },
               [](std::size_t i) { EXPECT_EQ(i, 700u); });
    EXPECT_LE(looked, 21u); // two a level
}

TEST(BoundsTree, OfNothingFindsNothing) {
    EXPECT_TRUE(found(BoundsTree(), {{0, 0, 0}, {1, 1, 1}}).empty());
}

} // namespace

} // namespace penumbra
