#include "radiosity/process/snapshot/SceneSnapshot.h"

#include "radiosity/process/LightingTask.h"
#include "radiosity/process/snapshot/SceneDiff.h"
#include "radiosity/process/snapshot/SceneReplica.h"
#include "scenegraph/Objects.h"
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {

namespace {

std::vector<std::byte> bytesOf(const SceneSnapshot& snapshot) {
    ByteWriter out;
    write(out, LightingTask{}, snapshot);
    return out.take();
}

std::vector<std::byte> bytesOf(const SceneGrowth& growth) {
    ByteWriter out;
    write(out, growth);
    return out.take();
}

std::optional<SceneGrowth> readGrowth(const std::vector<std::byte>& bytes) {
    ByteReader in(bytes);
    return readSceneGrowth(in);
}

std::optional<LightingTask> read(const std::vector<std::byte>& bytes) {
    ByteReader in(bytes);
    return readLightingTask(in);
}

/// What differs between two placed scenes; empty: nothing.
std::string difference(const PlacedScene& a, const PlacedScene& b) {
    if (a.objects.size() != b.objects.size()) return "number of objects";
    for (std::size_t o = 0; o < a.objects.size(); ++o)
        if (a.objects[o].path != b.objects[o].path ||
            a.objects[o].toWorld != b.objects[o].toWorld ||
            a.objects[o].visible != b.objects[o].visible)
            return a.objects[o].path;
    if (a.meshes.size() != b.meshes.size()) return "number of meshes";
    for (std::size_t m = 0; m < a.meshes.size(); ++m) {
        const MeshData& x = a.meshes[m].node->data();
        const MeshData& y = b.meshes[m].node->data();
        if (a.meshes[m].path != b.meshes[m].path || a.meshes[m].toWorld != b.meshes[m].toWorld ||
            x.points != y.points || x.faceVertexIndices != y.faceVertexIndices ||
            x.scheme != y.scheme || x.doubleSided != y.doubleSided ||
            x.materials.size() != y.materials.size() ||
            x.materials[0]->reflectance() != y.materials[0]->reflectance() ||
            x.materials[0]->emission() != y.materials[0]->emission())
            return a.meshes[m].path;
    }
    if (a.lights.size() != b.lights.size()) return "number of lights";
    for (std::size_t l = 0; l < a.lights.size(); ++l)
        if (a.lights[l].node->luminance() != b.lights[l].node->luminance() ||
            a.lights[l].toWorld != b.lights[l].toWorld)
            return a.lights[l].path;
    return "";
}

TEST(SceneSnapshot, ACopyIsTheSameSceneAndStaysItThroughAllEdits) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        EditableRoom room(seed);
        SceneDiff table(*room.scene().root);
        table.diff();
        auto task = read(bytesOf(table.snapshot()));
        ASSERT_TRUE(task);
        SceneReplica copy(std::move(task->scene));
        for (int edit = 0; edit < 40; ++edit) {
            const std::string what = room.edit();
            const SceneDiff::Change change = table.diff();
            if (change.growth) {
                EXPECT_TRUE(copy.apply(readGrowth(bytesOf(*change.growth)).value()));
            }
            for (const GraphEdit& e : change.edits)
                if (table.report(e)) EXPECT_TRUE(copy.apply(e));
            ASSERT_EQ(difference(placeScene(room.scene()), placeScene(copy.scene())), "")
                << "seed " << seed << " " << what;
        }
        const SceneReplica late(read(bytesOf(table.snapshot()))->scene); // all edits so far at once
        EXPECT_EQ(difference(placeScene(room.scene()), placeScene(late.scene())), "");
    }
}

TEST(SceneSnapshot, WhatComesAndGoesAgainLeavesWhatStaysAsItIs) {
    EditableRoom room(2);
    SceneDiff table(*room.scene().root);
    table.diff();
    SceneReplica copy(read(bytesOf(table.snapshot()))->scene);
    const Node* const first = copy.scene().root->children().front().get();
    const NodePtr shelf = object("shelf", floorData(0, 1, 0, 1, 0.5));
    std::size_t nodes = 0;
    for (int i = 0; i < 3; ++i) {
        room.scene().root->add(shelf);
        EXPECT_EQ(table.diff().growth.has_value(), i == 0) << "it is known, until others come";
        room.scene().root->remove(shelf);
        EXPECT_FALSE(table.diff().growth);
        nodes = table.snapshot().nodes.size();
    }
    room.scene().root->add(object("desk", floorData(0, 1, 0, 1, 0.4)));
    const SceneDiff::Change change = table.diff();
    ASSERT_TRUE(change.growth);
    EXPECT_EQ(change.growth->firstNode, nodes);
    EXPECT_FALSE(table.numberOf(*shelf)) << "forgotten";
    SceneReplica late(read(bytesOf(table.snapshot()))->scene);
    EXPECT_EQ(difference(placeScene(room.scene()), placeScene(late.scene())), "");
    EXPECT_EQ(copy.scene().root->children().front().get(), first);
}

TEST(SceneSnapshot, GrowthThatWasTamperedWithIsReadOrRefusedButNeverBelieved) {
    EditableRoom room(4);
    SceneDiff table(*room.scene().root);
    table.diff();
    const std::vector<std::byte> before = bytesOf(table.snapshot());
    room.scene().root->remove(NodePtr(room.scene().root->children().back()));
    room.scene().root->add(object("shelf", floorData(0, 1, 0, 1, 0.5)));
    const std::vector<std::byte> good = bytesOf(table.diff().growth.value());
    ASSERT_TRUE(SceneReplica(read(before)->scene).apply(readGrowth(good).value()));
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::byte> bytes = good;
        for (unsigned k = 0; k <= random() % 4; ++k)
            bytes[random() % bytes.size()] = std::byte(random());
        if (random() % 4 == 0) bytes.resize(random() % bytes.size());
        const auto growth = readGrowth(bytes);
        SceneReplica copy(read(before)->scene);
        if (growth && copy.apply(*growth))
            placeScene(copy.scene());
        else
            ++refused;
    }
    EXPECT_GT(refused, 500);
}

TEST(SceneSnapshot, NormalsOfAMeshGoWithIt) {
    MeshData data = floorData(0, 1, 0, 1, 0);
    data.normals.assign(4, glm::vec3(0, 0.6f, 0.8f));
    const Scene scene = sceneOf({object("floor", data)});
    SceneDiff table(*scene.root);
    table.diff();
    const SceneReplica copy(read(bytesOf(table.snapshot()))->scene);
    EXPECT_EQ(placeScene(copy.scene()).meshes.at(0).node->data().normals, data.normals);
}

TEST(SceneSnapshot, EditsOutliveBeingWrittenDown) {
    const std::vector<GraphEdit> edits{
        SetMatrix{3, glm::dmat4(2.0)},     SetVisible{4, false},   SetLuminance{5, Rgb(1, 2, 3)},
        SetMaterial{6, Rgb(0.1f), Rgb(7)}, SetChildren{7, {8, 9}}, SetBeginsObject{8, true}};
    std::vector<std::uint64_t> keys;
    for (const GraphEdit& edit : edits) {
        ByteWriter out;
        write(out, edit);
        ByteReader in(out.bytes());
        const auto back = readGraphEdit(in);
        ASSERT_TRUE(back && in.atEnd());
        EXPECT_EQ(back->index(), edit.index());
        EXPECT_EQ(keyOf(*back), keyOf(edit));
    }
}

TEST(SceneSnapshot, CirclesAndGraphsWithoutEndAreRefused) {
    using Kind = NodeSnapshot::Kind;
    SceneSnapshot snapshot;
    snapshot.nodes.resize(101);
    for (std::uint32_t n = 0; n < 101; ++n) {
        snapshot.nodes[n].kind = Kind::group;
        if (n < 100) snapshot.nodes[n].children = {n + 1};
    }
    EXPECT_TRUE(walkable(snapshot));
    EXPECT_FALSE(apply(snapshot, SetChildren{100, {50}}));
    EXPECT_TRUE(snapshot.nodes[100].children.empty());
    for (std::uint32_t n = 0; n < 100; ++n) snapshot.nodes[n].children = {n + 1, n + 1};
    EXPECT_FALSE(walkable(snapshot)); // 2^100 paths
}

TEST(SceneSnapshot, BytesThatWereTamperedWithAreReadOrRefusedButNeverBelieved) {
    EditableRoom room(4);
    SceneDiff table(*room.scene().root);
    table.diff();
    const std::vector<std::byte> good = bytesOf(table.snapshot());
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::byte> bytes = good;
        for (unsigned k = 0; k <= random() % 4; ++k)
            bytes[random() % bytes.size()] = std::byte(random());
        if (random() % 4 == 0) bytes.resize(random() % bytes.size());
        auto task = read(bytes);
        refused += !task;
        if (task) placeScene(SceneReplica(std::move(task->scene)).scene());
    }
    EXPECT_GT(refused, 500);
}

} // namespace

} // namespace penumbra
