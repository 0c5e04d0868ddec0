#include "radiosity/process/GraphImage.h"

#include "radiosity/process/GraphCopy.h"
#include "radiosity/process/GraphTable.h"
#include "radiosity/process/LightingTask.h"
#include "scenegraph/Objects.h"
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {

namespace {

std::vector<std::byte> bytesOf(const GraphImage& image) {
    ByteWriter out;
    write(out, LightingTask{}, image);
    return out.take();
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

TEST(GraphImage, ACopyIsTheSameSceneAndStaysItThroughAllEdits) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        EditableRoom room(seed);
        GraphTable table(*room.scene().root);
        table.look();
        auto task = read(bytesOf(table.image()));
        ASSERT_TRUE(task);
        auto copy = std::make_unique<GraphCopy>(std::move(task->scene));
        for (int edit = 0; edit < 40; ++edit) {
            const std::string what = room.edit();
            const GraphTable::Change change = table.look();
            if (change.structure) {
                for (const GraphEdit& e : change.edits) table.tell(e);
                copy = std::make_unique<GraphCopy>(read(bytesOf(table.image()))->scene);
            } else {
                for (const GraphEdit& e : change.edits) {
                    table.tell(e);
                    EXPECT_TRUE(copy->apply(e));
                }
            }
            ASSERT_EQ(difference(placeScene(room.scene()), placeScene(copy->scene())), "")
                << "seed " << seed << " " << what;
        }
        const GraphCopy late(read(bytesOf(table.image()))->scene); // all edits so far at once
        EXPECT_EQ(difference(placeScene(room.scene()), placeScene(late.scene())), "");
    }
}

TEST(GraphImage, EditsOutliveBeingWrittenDown) {
    const std::vector<GraphEdit> edits{SetMatrix{3, glm::dmat4(2.0)}, SetVisible{4, false},
                                       SetLuminance{5, Rgb(1, 2, 3)},
                                       SetMaterial{6, Rgb(0.1f), Rgb(7)}, SetChildren{7, {8, 9}}};
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

TEST(GraphImage, CirclesAndGraphsWithoutEndAreRefused) {
    using Kind = NodeImage::Kind;
    GraphImage image;
    image.nodes.resize(101);
    for (std::uint32_t n = 0; n < 101; ++n) {
        image.nodes[n].kind = Kind::group;
        if (n < 100) image.nodes[n].children = {n + 1};
    }
    EXPECT_TRUE(walkable(image));
    EXPECT_FALSE(apply(image, SetChildren{100, {50}}));
    EXPECT_TRUE(image.nodes[100].children.empty());
    for (std::uint32_t n = 0; n < 100; ++n) image.nodes[n].children = {n + 1, n + 1};
    EXPECT_FALSE(walkable(image)); // 2^100 paths
}

TEST(GraphImage, BytesThatWereTamperedWithAreReadOrRefusedButNeverBelieved) {
    EditableRoom room(4);
    GraphTable table(*room.scene().root);
    table.look();
    const std::vector<std::byte> good = bytesOf(table.image());
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::byte> bytes = good;
        for (unsigned k = 0; k <= random() % 4; ++k)
            bytes[random() % bytes.size()] = std::byte(random());
        if (random() % 4 == 0) bytes.resize(random() % bytes.size());
        auto task = read(bytes);
        refused += !task;
        if (task) placeScene(GraphCopy(std::move(task->scene)).scene());
    }
    EXPECT_GT(refused, 500);
}

} // namespace

} // namespace penumbra
