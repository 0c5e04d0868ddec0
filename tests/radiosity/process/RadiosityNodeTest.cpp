#include "radiosity/process/RadiosityNode.h"

#include "radiosity/process/LightingLink.h"
#include "tests/support/EditedScenes.h"
#include "tests/support/LitNode.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

using Phase = RadiosityState::Phase;

TEST(RadiosityNode, LightsWhatStandsBelowIt) {
    LitRoom room;
    room.node->update();
    EXPECT_EQ(room.node->unlit().size(), 2u);
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.node->unlit().size(), 0u);
    EXPECT_EQ(room.difference(), "");
    EXPECT_GT(room.node->state().certificate, 0);
    EXPECT_TRUE(room.node->takeMessages().empty());
}

TEST(RadiosityNode, FollowsWhateverIsEditedBelowIt) {
    LitRoom room;
    ASSERT_TRUE(updateUntilSettled(*room.node));
    room.box->setMatrix(moved(0.7, 0.2, 0));
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "") << "moved";
    room.light->setLuminance(Rgb(30, 60, 90));
    room.wallPaint->setReflectance(Rgb(0.3f));
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "") << "repainted";
    room.node->remove(room.box);
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "") << "removed";
    room.node->add(room.box);
    const NodePtr shelf = object("shelf", boxData({1, 1, 1}, {1.5f, 1.5f, 1.1f}, false));
    room.node->add(shelf);
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "") << "given back, and a new thing";
    room.node->remove(shelf);
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "") << "the new thing taken out again";
    room.box->setMatrix(moved(0.2, 0.3, 0));
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "") << "moved where something is no more";
}

const LitObject* find(const RadiosityNode& node, const std::string& path) {
    const auto objects = node.objects();
    const auto found = std::ranges::find(objects, path, &LitObject::path);
    return found != objects.end() ? &*found : nullptr;
}

TEST(RadiosityNode, DrawsWhatComesAndKeepsWhatThereIs) {
    LitRoom room;
    ASSERT_TRUE(updateUntilSettled(*room.node));
    const auto box = find(*room.node, "/box")->geometry;
    room.node->add(object("shelf", boxData({1, 1, 1}, {1.5f, 1.5f, 1.1f}, false)));
    ASSERT_TRUE(updateUntilSettled(*room.node));
    ASSERT_TRUE(find(*room.node, "/shelf") && find(*room.node, "/shelf")->geometry);
    EXPECT_EQ(find(*room.node, "/box")->geometry, box) << "the same surface";
    EXPECT_EQ(room.difference(), "");
    room.node->setPreviewLights({"/lamp/light"});
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "");
}

TEST(RadiosityNode, WhatIsMadeAnewIsDrawnAsItWasUntilItIsLit) {
    LitRoom room;
    ASSERT_TRUE(updateUntilSettled(*room.node));
    const auto before = find(*room.node, "/box")->geometry;
    bool gone = false;
    room.box->setMatrix(glm::scale(glm::dmat4(1.0), glm::dvec3(1.5, 1, 1)));
    ASSERT_TRUE(updateUntil(*room.node, [&] {
        const LitObject* const box = find(*room.node, "/box");
        gone |= !box || !box->geometry || !room.node->unlit().empty();
        return room.node->state().reached(SolutionState::exact);
    }));
    EXPECT_FALSE(gone);
    EXPECT_NE(find(*room.node, "/box")->geometry, before);
    EXPECT_EQ(std::ranges::count(room.node->objects(), "/box", &LitObject::path), 1);
    EXPECT_EQ(room.difference(), "");
}

TEST(RadiosityNode, AnotherSceneIsMeshedAsOneOfItsOwn) {
    LitRoom room;
    ASSERT_TRUE(updateUntilSettled(*room.node));
    while (!room.node->children().empty()) room.node->remove(NodePtr(room.node->children().back()));
    room.node->add(object("hall", boxData({0, 0, 0}, {6, 5, 4}, true)));
    room.node->add(std::make_shared<Light>("sun", SphereShape{0.2f}, Rgb(100)));
    ASSERT_TRUE(updateUntilSettled(*room.node)) << describe(*room.node);
    EXPECT_EQ(room.difference(), "");
    EXPECT_EQ(find(*room.node, "/box"), nullptr) << "nothing is kept of the other one";
}

TEST(RadiosityNode, DrawsAMovedObjectAtItsPlaceAtOnceWithTheLightThatItHad) {
    LitRoom room;
    ASSERT_TRUE(updateUntilSettled(*room.node));
    room.node->setTrigger(Trigger::onDemand);
    room.box->setMatrix(moved(1, 0, 0));
    room.node->update();
    const auto objects = room.node->objects();
    const auto box = std::find_if(objects.begin(), objects.end(),
                                  [](const LitObject& o) { return o.path == "/box"; });
    ASSERT_NE(box, objects.end());
    ASSERT_TRUE(box->geometry);
    EXPECT_EQ(box->toNode, moved(1, 0, 0));
    EXPECT_EQ(room.node->state().held, 1u);
}

TEST(RadiosityNode, KeepsItsLightWhenItIsStopped) {
    LitRoom room;
    ASSERT_TRUE(updateUntilSettled(*room.node));
    room.node->stop();
    room.box->setMatrix(moved(0.5, 0.5, 0));
    room.node->update();
    EXPECT_EQ(room.node->state().phase, Phase::off);
    EXPECT_EQ(room.node->unlit().size(), 0u);
    room.node->start();
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_EQ(room.difference(), "");
}

TEST(RadiosityNode, IsInTheEndAsIfSolvedFromScratchWhateverWasDone) {
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        EditableRoom room(seed);
        const RadiosityOptions options{
            .meshing = EditableRoom::meshing(), .solving = {}, .trigger = Trigger::continuous};
        const auto node = std::make_shared<RadiosityNode>("lit", options, makeThreadLink());
        node->add(room.scene().root);
        std::string done;
        for (int edit = 0; edit < 12; ++edit) {
            done += room.edit() + "; ";
            node->setPolicy(PolicyKind(edit % 3));
            glm::dmat4 camera(1.0);
            camera[3] = {0.1 * edit, 0, 1, 1};
            node->setCamera(makeView({}, camera, 160, 90));
            node->update(); // some of them are taken in together, some are not
        }
        ASSERT_TRUE(updateUntilSettled(*node))
            << describe(*node) << "\nseed " << seed << ": " << done;
        EXPECT_EQ(differenceFromScratch(*node, options), "") << "seed " << seed << ": " << done;
    }
}

} // namespace

} // namespace penumbra
