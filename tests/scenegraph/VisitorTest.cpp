#include "scenegraph/Visitor.h"

#include "RandomParts.h"
#include "SceneParts.h"
#include "scenegraph/LitGeometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace penumbra {

namespace {

using ::testing::ElementsAre;

/// Writes down every leaf with its path and transform.
class Recorder : public Visitor {
public:
    using Visitor::visit;
    void visit(const Mesh&) override { record(); }
    void visit(const Light&) override { record(); }
    void visit(const Camera&) override { record(); }
    void visit(const LitGeometry&) override { record(); }

    std::vector<std::string> paths;
    std::vector<glm::dmat4> places;

private:
    void record() {
        paths.push_back(path());
        places.push_back(toWorld());
    }
};

Recorder walk(const Scene& scene) {
    Recorder recorder;
    scene.root->accept(recorder);
    return recorder;
}

TEST(Visitor, ReachesEveryKindOfLeafInOrder) {
    const auto camera = std::make_shared<Camera>("camera", Lens());
    const auto lit = std::make_shared<LitGeometry>("lit", ObjectId{0}, LitMeshData());
    const Scene scene = sceneOf({square("mesh"), make("group", {light("lamp"), camera}), lit});
    EXPECT_THAT(walk(scene).paths, ElementsAre("/mesh", "/group/lamp", "/group/camera", "/lit"));
}

TEST(Visitor, PathNamesTheNodesBelowTheRoot) {
    const Scene scene = sceneOf({make("World", {objectOf("Seat", {square("Cushion")})})});
    EXPECT_THAT(walk(scene).paths, ElementsAre("/World/Seat/Cushion"));
}

TEST(Visitor, ASharedNodeIsVisitedOnceInEachOfItsPlaces) {
    const auto chair = square("chair");
    const Scene scene = sceneOf(
        {placed("left", moved(-1, 0, 0), {chair}), placed("right", moved(1, 0, 0), {chair})});
    const Recorder seen = walk(scene);
    EXPECT_THAT(seen.paths, ElementsAre("/left/chair", "/right/chair"));
    EXPECT_THAT(seen.places, ElementsAre(moved(-1, 0, 0), moved(1, 0, 0)));
}

TEST(Visitor, ATransformMovesItsChildrenAndNotItsSiblings) {
    const Scene scene =
        sceneOf({placed("moved", moved(1, 2, 3), {square("in")}), square("beside")});
    EXPECT_THAT(walk(scene).places, ElementsAre(moved(1, 2, 3), glm::dmat4(1.0)));
}

TEST(Visitor, TheOuterTransformIsAppliedLast) {
    const Scene scene =
        sceneOf({placed("outer", scaled(2), {placed("inner", moved(1, 0, 0), {square("mesh")})})});
    const glm::dvec4 origin = walk(scene).places.at(0) * glm::dvec4(0, 0, 0, 1);
    EXPECT_EQ(origin, glm::dvec4(2, 0, 0, 1));
}

TEST(Visitor, ASwitchHidesAllThatIsBelowIt) {
    const auto hidden = make<Switch>("lights", {make("row", {light("a"), light("b")})});
    const Scene scene = sceneOf({hidden, square("floor")});
    EXPECT_EQ(walk(scene).paths.size(), 3u);
    hidden->setVisible(false);
    EXPECT_THAT(walk(scene).paths, ElementsAre("/floor"));
}

TEST(Visitor, ASharedNodeIsHiddenOnlyWhereItsSwitchIsOff) {
    const auto chair = square("chair");
    const auto off = make<Switch>("off", {chair});
    off->setVisible(false);
    EXPECT_THAT(walk(sceneOf({off, make<Switch>("on", {chair})})).paths, ElementsAre("/on/chair"));
}

RC_GTEST_PROP(Visitor, ToWorldIsTheProductOfTheMatricesAbove, ()) {
    NodePtr node = square("leaf");
    glm::dmat4 product(1.0);
    const int depth = *rc::gen::inRange(0, 6);
    for (int i = 0; i < depth; ++i) { // from the leaf up
        const glm::dmat4 matrix = frame();
        node = placed("level", matrix, {node});
        product = matrix * product;
    }
    const glm::dmat4 seen = walk(sceneOf({node})).places.at(0);
    for (int column = 0; column < 4; ++column)
        RC_ASSERT(glm::length(seen[column] - product[column]) <=
                  1e-12 * (1 + glm::length(product[column])));
}

} // namespace

} // namespace penumbra
