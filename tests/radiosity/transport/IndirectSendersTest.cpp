// Light of far patches comes by their clusters, and all of it comes once.
#include "radiosity/transport/IndirectSenders.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr MeshingOptions kFine{.patchSize = 0.1f, .elementSize = 0.1f};

Scene furnishedRoom() {
    const auto box = std::make_shared<Mesh>(
        "mesh", boxData({-0.2f, -0.3f, 0}, {0.2f, 0.3f, 0.5f}, false, paint({0.8f, 0.3f, 0.2f})));
    const auto chair = objectOf("chair", {box});
    chair->setMatrix(moved(0.6, 0.5, 0));
    return sceneOf(
        {object("room", boxData({-1, -1, 0}, {1, 1, 2}, true, paint({0.7f, 0.6f, 0.5f}))), chair,
         object("board", boxData({-0.6f, -0.5f, 0.4f}, {-0.2f, 0.5f, 0.5f}, false)),
         ceilingLight({0, 0, 1.99f}, 0.8f, 0.6f, {10, 9, 8})});
}

class SendersOfARoom : public testing::Test {
protected:
    SendersOfARoom() {
        for (std::size_t b = 0; b * PatchSet::kBlock < set().nodes.size(); ++b) {
            Bounds box;
            for (std::size_t n = b * PatchSet::kBlock; n < (b + 1) * PatchSet::kBlock; ++n)
                if (!isPadding(set().nodes[n])) box.add(set().nodes[n].position);
            blocks.append(box);
        }
    }
    const PatchSet& set() const { return built.patches; }

    Scene scene = furnishedRoom();
    BuiltPatches built = meshed(scene, kFine);
    IndirectSenders senders{built.patches, true};
    BoundsTree blocks;
};

TEST_F(SendersOfARoom, GiveEachBlockTheLightOfEachPatchOnce) {
    std::size_t links = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        for (std::uint32_t p = 0; p < senders.patchCount(); ++p) {
            int linked = 0;
            for (std::uint32_t s = p; s != Clusters::kNone; s = senders.parent(s))
                linked += senders.linked(s, blocks[b]);
            ASSERT_EQ(linked, 1) << "patch " << p << " onto block " << b;
        }
    for (std::size_t b = 0; b < blocks.size(); ++b)
        senders.forEachLinked(blocks[b], [&](std::uint32_t) { ++links; });
    EXPECT_LT(links, blocks.size() * senders.patchCount() * 6 / 10); // it pays
}

TEST_F(SendersOfARoom, AreLinkedToTheSameBlocksFromEitherSide) {
    std::vector<std::vector<std::uint32_t>> bySender(senders.count());
    for (std::uint32_t b = 0; b < blocks.size(); ++b)
        senders.forEachLinked(blocks[b], [&](std::uint32_t s) { bySender[s].push_back(b); });
    for (std::uint32_t s = 0; s < senders.count(); ++s)
        EXPECT_EQ(senders.linkedBlocks(s, blocks), bySender[s]) << "sender " << s;
}

TEST_F(SendersOfARoom, SendWhatTheirPatchesDoOnAverage) {
    std::vector<glm::dvec3> light(senders.cellCount());
    const auto cellsOf = [&](std::uint32_t s) {
        return std::span(light).subspan(senders.cells(s).first, senders.cells(s).count);
    };
    std::vector<double> sum(senders.count()), area(senders.count());
    for (std::uint32_t p = 0; p < senders.patchCount(); ++p) {
        double middle = double(set().patches[p].centre.x), step = 0.01;
        for (glm::dvec3& cell : cellsOf(p)) cell = {middle += step, 1, double(p % 7)};
        const double mean = meanOf(cellsOf(p)).x;
        for (std::uint32_t s = senders.parent(p); s != Clusters::kNone; s = senders.parent(s)) {
            sum[s] += double(senders.area(p)) * mean;
            area[s] += double(senders.area(p));
        }
    }
    senders.average(light);
    for (std::uint32_t s = senders.patchCount(); s < senders.count(); ++s) {
        EXPECT_NEAR(area[s], double(senders.area(s)), 1e-5 * area[s]);
        glm::dvec3 mean(0);
        ASSERT_EQ(cellsOf(s).size(), kClusterCells);
        for (const glm::dvec3& quarter : cellsOf(s).subspan(kSenderCells)) {
            EXPECT_NEAR(quarter.y, 1, 1e-6);
            mean += 0.25 * quarter;
        }
        EXPECT_NEAR(mean.x, sum[s] / area[s], 0.1); // quarters are of about the same area
    }
}

TEST_F(SendersOfARoom, StandWhereAnObjectWasBuiltInPlace) {
    // Moved there, a chair sends from the same boxes as if it had been there from the start.
    const std::vector<std::uint32_t> before = senders.linkedBlocks(senders.count() - 1, blocks);
    const ObjectId chair = senders.object(senders.count() - 1);
    const Pose there = placementOf(glm::rotate(moved(-0.5, -0.6, 0.8), 0.7, {0, 0, 1})).pose;
    const Pose here = set().objects[chair.value].pose;
    placeObject(built.patches, chair, there);
    senders.place(chair);
    const IndirectSenders fresh(set(), true);
    for (std::uint32_t s = 0; s < senders.count(); ++s) {
        EXPECT_EQ(senders.box(s).lower, fresh.box(s).lower);
        EXPECT_EQ(senders.box(s).upper, fresh.box(s).upper);
    }
    placeObject(built.patches, chair, here);
    senders.place(chair);
    EXPECT_EQ(senders.linkedBlocks(senders.count() - 1, blocks), before);
}

TEST_F(SendersOfARoom, AreBrightBesideALight) {
    // The light is beside the ceiling, and two metres above the chair's and the floor's patches of
    // a tenth of a metre.
    const auto isBright = [&](const IndirectSenders& of, std::uint32_t s) {
        return of.brightness(s) != IndirectSenders::Brightness::usual;
    };
    std::size_t bright = 0, others = 0;
    for (std::uint32_t p = 0; p < senders.patchCount(); ++p) {
        if (set().patches[p].elementCount == 0) continue;
        ++(isBright(senders, p) ? bright : others);
        if (set().patches[p].centre.z == 2) EXPECT_TRUE(isBright(senders, p)) << "patch " << p;
        if (set().patches[p].centre.z == 0) EXPECT_FALSE(isBright(senders, p)) << "patch " << p;
    }
    EXPECT_GT(bright, 100u);
    EXPECT_GT(others, 100u);

    const auto expectFresh = [&](const SceneChange& change) {
        std::vector<IndirectSenders::Brightness> before;
        for (std::uint32_t s = 0; s < senders.count(); ++s) before.push_back(senders.brightness(s));
        const std::vector<std::uint32_t> changed = senders.followEmitters(change);
        const IndirectSenders fresh(set(), true);
        for (std::uint32_t s = 0; s < senders.count(); ++s) {
            EXPECT_EQ(senders.brightness(s), fresh.brightness(s)) << "sender " << s;
            EXPECT_EQ(std::ranges::binary_search(changed, s), senders.brightness(s) != before[s])
                << "sender " << s;
        }
        return changed.size();
    };
    const auto objectAt = [&](const char* path) {
        return ObjectId{std::uint32_t(std::ranges::find(set().objects, path, &ObjectPart::path) -
                                      set().objects.begin())};
    };
    const ObjectId chair = objectAt("/chair"), light = objectAt("/lamp");
    ASSERT_LT(std::max(chair.value, light.value), set().objects.size());
    placeObject(built.patches, chair, placementOf(moved(0, 0, 1.4)).pose);
    senders.place(chair);
    EXPECT_GT(expectFresh({.objects = {chair}}), 0u);
    built.patches.emitters[0].exitance = Rgb(0.0f);
    EXPECT_EQ(expectFresh({.emitters = {0}}), 0u) << "it is dark, and may shine again";
    placeObject(built.patches, light, placementOf(moved(0, 0, 0.6)).pose);
    senders.place(light);
    EXPECT_GT(expectFresh({.objects = {light}}), 0u);
    built.patches.objects[light.value].present = false;
    EXPECT_GT(expectFresh({.objects = {light}}), 0u) << "it is hidden";
}

TEST(IndirectSenders, GlareRightBesideASmallLightAndSoDoTheirClusters) {
    // A bulb hangs five centimetres below a box of thirty.
    const auto bulb = std::make_shared<Light>("bulb", SphereShape{0.02f}, Rgb(1e4f));
    const BuiltPatches built =
        meshed(sceneOf({object("room", boxData({-2, -2, 0}, {2, 2, 3}, true)),
                        object("box", boxData({-0.15f, -0.15f, 1.6f}, {0.15f, 0.15f, 1.9f}, false)),
                        placed("bulb", moved(0, 0, 1.53), {bulb})}),
               kFine);
    const PatchSet& set = built.patches;
    const IndirectSenders senders(set, true);
    std::size_t patches = 0, clusters = 0;
    for (std::uint32_t s = 0; s < senders.count(); ++s) {
        const bool glares = senders.brightness(s) == IndirectSenders::Brightness::glaring;
        (s < senders.patchCount() ? patches : clusters) += glares && senders.object(s).value == 1;
        if (!glares) continue;
        EXPECT_GT(senders.object(s).value, 0u) << "sender " << s << " is of the room";
        if (s < senders.patchCount()) EXPECT_LT(set.patches[s].centre.z, 1.75f) << "patch " << s;
    }
    EXPECT_GE(patches, 9u);
    EXPECT_GT(clusters, 0u);
}

TEST(IndirectSenders, WithoutClustersArePatchesAlone) {
    const BuiltPatches built = meshed(furnishedRoom(), kFine);
    const IndirectSenders senders(built.patches, false);
    EXPECT_EQ(senders.count(), senders.patchCount());
}

TEST(IndirectSenders, ByTheirClustersLightARoomAsPatchesDo) {
    // Clusters differ by what light changes within a quarter of one: less than 1 %.
    const Scene scene = furnishedRoom();
    const PlacedScene placed = placeScene(scene);
    double power[2] = {};
    std::size_t entries[2] = {};
    for (int clustered = 0; clustered < 2; ++clustered) {
        LitScene lit(placed, kFine, {.residual = 1e-5, .clusters = clustered != 0});
        lit.solver().settle();
        const std::vector<Rgb> radiosity = lit.solver().radiosity();
        for (std::size_t p = 0; p < radiosity.size(); ++p)
            power[clustered] += double(lit.patches().patches[p].area * radiosity[p].g);
        entries[clustered] = lit.solver().statistics().entries;
    }
    EXPECT_NEAR(power[1] / power[0], 1, 0.005);
    EXPECT_LT(entries[1], entries[0] * 2 / 3);
}

} // namespace

} // namespace penumbra
