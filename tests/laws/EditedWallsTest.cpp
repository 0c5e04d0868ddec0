// What hides a room from a light altogether is moved, hidden, taken out and brought back: light
// follows, and what stays hidden costs nothing.
#include "tests/support/LitDifference.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr MeshingOptions kMeshing{.patchSize = 0.5f, .elementSize = 0.125f};

/// Two rooms of 2 m without a wall between them, a partition there that reaches beyond them on all
/// sides, and a light in the first.
struct TwoRooms {
    std::shared_ptr<Transform> partition = objectOf(
        "partition", {std::make_shared<Mesh>(
                         "mesh", boxData({-0.05f, -1.3f, -1.3f}, {0.05f, 1.3f, 1.3f}, false))});
    std::shared_ptr<Switch> choice = make<Switch>("choice", {partition});
    std::shared_ptr<Transform> panel = panelAt(-1.2);
    Scene scene = sceneOf({room("first", -2.1f, -0.1f, {0, 2, 3, 4, 5}), choice,
                           room("second", 0.1f, 2.1f, {1, 2, 3, 4, 5}), panel});
    SolverOptions solving;
    LitScene lit;

    explicit TwoRooms(bool directOnly = true)
        : solving{.directOnly = directOnly}, lit(placeScene(scene), kMeshing, solving) {
        lit.solver().settle();
    }

    static std::shared_ptr<Transform> panelAt(double x, const char* name = "panel") {
        auto panel =
            objectOf(name, {std::make_shared<Light>("light", RectShape{0.4f, 0.3f}, Rgb(10))});
        panel->setMatrix(moved(x, 0, 0.95));
        return panel;
    }
    static NodePtr room(const char* name, float from, float to, std::initializer_list<int> faces) {
        MeshData mesh;
        addBox(mesh, {from, -1, -1}, {to, 1, 1}, true, faces);
        mesh.materials = {paint(Rgb(0.5f))};
        return object(name, std::move(mesh));
    }

    /// \return rays that it took
    std::uint64_t follow() {
        const std::uint64_t before = rays();
        EXPECT_FALSE(lit.follow(placeScene(scene)).rebuilt);
        lit.solver().settle();
        return rays() - before;
    }
    std::uint64_t rays() const { return lit.solver().statistics().direct.rays.total(); }

    const ObjectPart& part(const char* path) const {
        const auto& parts = lit.patches().objects;
        return *std::find_if(parts.begin(), parts.end(),
                             [&](const auto& p) { return p.path == path; });
    }
    /// Of the light onto the vertices of the second room.
    std::size_t entriesBehind() const {
        std::size_t entries = 0;
        const PatchSet& set = lit.patches();
        const std::uint32_t emitter = part("/panel").emitters.first;
        for (std::uint32_t b = 0; b < set.vertexBlockObject.size(); ++b)
            if (set.objects[set.vertexBlockObject[b].value].path == "/second")
                entries += std::size_t(lit.solver().direct().rows()[emitter][b].entryCount());
        return entries;
    }
    /// Of the light from patches of the first room onto nodes of the second.
    std::size_t indirectEntriesBehind() const {
        std::size_t entries = 0;
        const PatchSet& set = lit.patches();
        const Range nodes = part("/second").nodes;
        for (std::uint32_t s = 0; s < lit.solver().patchRows().size(); ++s) {
            const std::string& from =
                set.objects[lit.solver().indirect().senders().object(s).value].path;
            const Row& row = lit.solver().patchRows()[s];
            for (std::size_t i = 0; i < row.size() && from == "/first"; ++i)
                if (nodes.contains(row.blockAt(i) * PatchSet::kBlock))
                    entries += std::size_t(row.begin()[std::ptrdiff_t(i)].entryCount());
        }
        return entries;
    }
    bool litBehind() const {
        const Range vertices = part("/second").vertices;
        for (std::uint32_t v = vertices.first; v < vertices.end(); ++v)
            if (lit.solver().direct().vertices()[v].g > 0) return true;
        return false;
    }
    std::string differs() const {
        LitScene scratch(placeScene(scene), sizesOf(lit.patches()), solving);
        scratch.solver().settle();
        return difference(lit, scratch);
    }
    void expectDark(const char* what) const {
        EXPECT_EQ(entriesBehind(), 0u) << what;
        EXPECT_FALSE(litBehind()) << what;
        EXPECT_EQ(differs(), "") << what;
    }
    void expectLit(const char* what) const {
        EXPECT_GT(entriesBehind(), 200u) << what; // of those that no wall hides
        EXPECT_TRUE(litBehind()) << what;
        EXPECT_EQ(differs(), "") << what;
    }
};

TEST(EditedWalls, HideARoomWhereTheyAre) {
    TwoRooms rooms;
    rooms.expectDark("as loaded");
    rooms.partition->setMatrix(moved(0, 1.2, 0));
    rooms.follow();
    rooms.expectLit("the partition stands half across");
    rooms.partition->setMatrix(moved(5, 0, 0));
    rooms.follow();
    rooms.expectLit("it is elsewhere");
    rooms.partition->setMatrix(glm::dmat4(1.0));
    rooms.follow();
    rooms.expectDark("it is back");
}

TEST(EditedWalls, HideARoomFromIndirectLightAsWell) {
    TwoRooms rooms(false);
    const auto expectDark = [&](const char* what) {
        EXPECT_EQ(rooms.indirectEntriesBehind(), 0u) << what;
        EXPECT_EQ(rooms.differs(), "") << what;
    };
    const auto expectLit = [&](const char* what) {
        EXPECT_GT(rooms.indirectEntriesBehind(), 200u) << what;
        EXPECT_EQ(rooms.differs(), "") << what;
    };
    rooms.scene.root->add(TwoRooms::panelAt(1.2, "another")); // light is there in any case
    rooms.follow();
    expectDark("it has a light of its own");
    rooms.partition->setMatrix(moved(0, 1.2, 0));
    rooms.follow();
    expectLit("the partition stands half across");
    rooms.partition->setMatrix(moved(0.1, 0, 0));
    rooms.follow();
    expectDark("it is back, nearly");
    rooms.choice->setVisible(false);
    rooms.follow();
    expectLit("it is hidden");
    rooms.choice->setVisible(true);
    rooms.partition->setMatrix(glm::dmat4(1.0));
    rooms.follow();
    expectDark("it is back");
}

TEST(EditedWalls, HideNothingWhileTheyAreHiddenOrTakenOut) {
    TwoRooms rooms;
    rooms.choice->setVisible(false);
    rooms.follow();
    rooms.expectLit("hidden");
    rooms.choice->setVisible(true);
    rooms.follow();
    rooms.expectDark("shown");
    rooms.choice->remove(rooms.partition);
    rooms.follow();
    rooms.expectLit("taken out");
    rooms.choice->add(rooms.partition);
    rooms.follow();
    rooms.expectDark("brought back");
}

TEST(EditedWalls, HideWhatTheyReachWhenTheyAreResized) {
    TwoRooms rooms;
    rooms.partition->setMatrix(glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0.5, 1)));
    rooms.follow();
    rooms.expectLit("smaller");
    rooms.partition->setMatrix(glm::dmat4(1.0));
    rooms.follow();
    rooms.expectDark("as before");
}

TEST(EditedWalls, HideWhatASecondOneHidesAsWell) {
    TwoRooms rooms;
    const auto second = std::make_shared<Transform>("another");
    for (const NodePtr& child : rooms.partition->children()) second->add(child);
    second->setMatrix(moved(0.4, 0, 0));
    second->setBeginsObject(true);
    rooms.scene.root->add(second);
    rooms.follow();
    rooms.partition->setMatrix(moved(5, 0, 0));
    rooms.follow();
    EXPECT_EQ(rooms.differs(), "") << "one left, and the other one hides most of the room";
    second->setMatrix(moved(0.4, 5, 0));
    rooms.follow();
    rooms.expectLit("both left");
    rooms.partition->setMatrix(glm::dmat4(1.0));
    second->setMatrix(moved(0.1, 0, 0));
    rooms.follow();
    rooms.expectDark("both are back");
    rooms.partition->setMatrix(moved(5, 0, 0));
    rooms.follow();
    rooms.expectDark("one of them is enough");
    second->setMatrix(moved(5, 0, 0));
    rooms.follow();
    rooms.expectLit("it is gone as well");
}

TEST(EditedWalls, HideFromALightThatComesAndGoes) {
    TwoRooms rooms;
    rooms.panel->setMatrix(moved(1.2, 0, 0.95));
    rooms.follow();
    rooms.expectLit("it is in the second room");
    rooms.panel->setMatrix(moved(-1.1, 0, 0.95));
    rooms.follow();
    rooms.expectDark("it is back in the first");
    rooms.partition->setMatrix(moved(0, 1.2, 0));
    rooms.follow();
    rooms.expectLit("the partition makes way");
}

TEST(EditedWalls, HideAnEditThatComesWhileAnotherIsUnderWay) {
    TwoRooms rooms;
    for (int pieces = 0; pieces < 60; pieces += 7) {
        rooms.partition->setMatrix(moved(0, 1.2, 0));
        rooms.lit.follow(placeScene(rooms.scene));
        for (int i = 0; i < pieces; ++i) rooms.lit.solver().step(1e-9);
        rooms.partition->setMatrix(glm::dmat4(1.0));
        rooms.follow();
        rooms.expectDark("there and back");
    }
    rooms.choice->setVisible(false);
    rooms.follow();
    rooms.expectLit("it is still known who hides the room");
}

TEST(EditedWalls, CostNoRayForWhatTheyHideBeforeAndAfter) {
    TwoRooms rooms, alone;
    alone.scene.root->remove(alone.scene.root->children()[2]);
    alone.follow();
    const std::uint64_t scratch = rooms.rays();
    for (const double x : {0.02, -0.01, 0.0}) {
        rooms.partition->setMatrix(moved(x, 0, 0));
        alone.partition->setMatrix(moved(x, 0, 0));
        const std::uint64_t rays = rooms.follow();
        EXPECT_EQ(rays, alone.follow()) << "as if there were no room behind it";
        EXPECT_LT(rays, scratch);
        rooms.expectDark("moved a little");
    }
}

} // namespace

} // namespace penumbra
