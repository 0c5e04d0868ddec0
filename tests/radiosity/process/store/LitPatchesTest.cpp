// Patches as the node knows them, against those that the worker lights.
#include "radiosity/process/store/LitPatches.h"

#include "radiosity/mesh/PosedPatches.h"
#include "radiosity/transport/LitScene.h"
#include "tests/support/BallData.h"
#include "tests/support/LitNode.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace penumbra {

namespace {

using Corner = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, float, float, float>;

/// Of all elements in the order of their objects: object, element, corner, and where it is lit.
std::vector<Corner> litCorners(const PatchSet& set) {
    std::vector<Corner> corners;
    std::vector<std::uint32_t> count(set.objects.size());
    for (std::size_t e = 0; e < set.elements.size(); ++e) {
        const std::uint32_t object = set.elementObject[e].value;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const glm::vec3 at = set.vertices[set.elements[e].vertices[k]].receiver.position;
            corners.emplace_back(object, count[object], k, at.x, at.y, at.z);
        }
        ++count[object];
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Poses the objects of one set as those of another.
void poseAs(const PatchSet& other, PatchSet& set) {
    PosedPatches posed(set);
    std::vector<PosedPatches::ObjectPose> wanted;
    for (std::uint32_t o = 0; o < other.objects.size(); ++o)
        wanted.push_back({{o}, other.objects[o].pose, other.objects[o].present});
    posed.pose(wanted);
}

TEST(LitPatches, AreLitAndTouchedWhereTheWorkersAre) {
    LitRoom room;
    room.box->setMatrix(glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.2, 0)), 0.4,
                                    glm::dvec3(0, 0, 1)));
    ASSERT_TRUE(updateUntilSettled(*room.node));
    const LitScene scene(room.node->placed(), room.options.meshing, room.options.solving);

    std::optional<PatchSet> read = room.node->patches();
    ASSERT_TRUE(read.has_value());
    poseAs(scene.patches(), *read);

    EXPECT_EQ(litCorners(*read), litCorners(scene.patches()));
    EXPECT_GT(read->vertices.size(), read->firstPrivate) << "the box stands on the floor";
    ASSERT_EQ(read->rayMeshes.size(), scene.patches().rayMeshes.size());
    for (std::size_t o = 0; o < read->rayMeshes.size(); ++o) {
        EXPECT_EQ(read->rayMeshes[o].vertices, scene.patches().rayMeshes[o].vertices);
        EXPECT_EQ(read->rayMeshes[o].triangles, scene.patches().rayMeshes[o].triangles);
        EXPECT_EQ(read->rayMeshes[o].solid, scene.patches().rayMeshes[o].solid);
    }
}

/// Where each vertex of dense meshes takes its light from: vertex, receiver, weight.
std::vector<std::tuple<std::uint32_t, std::uint32_t, float>> receiversOf(const PatchSet& set) {
    std::vector<std::tuple<std::uint32_t, std::uint32_t, float>> all;
    for (std::uint32_t v = 0; v < set.firstPrivate; ++v)
        if (set.isBlended(v / PatchSet::kBlock))
            set.forEachReceiver(
                v, [&](std::uint32_t r, float weight) { all.emplace_back(v, r, weight); });
    return all;
}

TEST(LitPatches, TakeLightFromTheSameReceivers) {
    LitRoom room;
    const auto ball = objectOf("ball", {std::make_shared<Mesh>("mesh", ballData(40, 0.4f))});
    ball->setMatrix(glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 0.4, 0.2)));
    room.node->add(ball);
    ASSERT_TRUE(updateUntilSettled(*room.node));
    const LitScene scene(room.node->placed(), room.options.meshing, room.options.solving);
    std::optional<PatchSet> read = room.node->patches();
    ASSERT_TRUE(read.has_value());
    EXPECT_FALSE(read->vertexBlends.empty());
    poseAs(scene.patches(), *read);
    const auto ours = receiversOf(*read), theirs = receiversOf(scene.patches());
    const auto [a, b] = std::ranges::mismatch(ours, theirs);
    EXPECT_TRUE(a == ours.end() && b == theirs.end())
        << "the floor covers some; not so at vertex "
        << (a != ours.end() ? std::get<0>(*a) : PatchCoordinate::kNone);
}

TEST(LitPatches, AMeshThatShinesDoesSoFromTheWorkersEmitters) {
    LitRoom room;
    const auto glow = paint(Rgb(), Rgb(40));
    const auto panels = objectOf("panels", {std::make_shared<Mesh>("mesh", twoPanels(glow, glow))});
    panels->setMatrix(glm::rotate(moved(0.1, 0.2, 0.1), 0.3, glm::dvec3(0, 0, 1)));
    room.node->add(panels);
    ASSERT_TRUE(updateUntilSettled(*room.node));
    const LitScene scene(room.node->placed(), room.options.meshing, room.options.solving);

    std::vector<Emitter> emitters, expected;
    for (const LitObject& object : room.node->objects())
        for (const EmissiveMesh& mesh : object.emissive) {
            EXPECT_EQ(mesh.path, "/panels/mesh");
            const Pose pose = placementOf(object.toNode * object.toObject).pose;
            for (const Emitter& own : mesh.emitters) emitters.push_back(placedEmitter(own, pose));
        }
    for (const Emitter& emitter : scene.patches().emitters)
        if (emitter.path == "/panels/mesh") expected.push_back(emitter);
    ASSERT_EQ(emitters.size(), 2u);
    ASSERT_EQ(expected.size(), 2u);
    for (std::size_t e = 0; e < 2; ++e) {
        EXPECT_EQ(emitters[e].polygons, expected[e].polygons);
        EXPECT_EQ(emitters[e].area, expected[e].area);
    }
}

TEST(LitPatches, WhatIsNoMeshIsNotRead) {
    EXPECT_FALSE(readPatches({}, 10).has_value());
    const std::vector<std::byte> noise(4096, std::byte{0x5a});
    EXPECT_FALSE(readPatches(std::vector<std::span<const std::byte>>{noise}, 10).has_value());
}

} // namespace

} // namespace penumbra
