#include "viewer/OverlayViews.h"

#include "LitScenes.h"
#include "radiosity/RadiosityNode.h"
#include "viewer/BlockAges.h"
#include "viewer/ColourMap.h"

namespace penumbra {

namespace {

TEST(OverlayViews, TheListOfOverlaysIsARing) {
    EXPECT_EQ(after(Overlay::none, 1), Overlay::mesh);
    Overlay overlay = Overlay::none;
    for (std::size_t i = 0; i < std::size(kOverlayNames); ++i) overlay = after(overlay, 1);
    EXPECT_EQ(overlay, Overlay::none);
    EXPECT_EQ(after(after(Overlay::none, -1), 1), Overlay::none);
}

TEST(OverlayViews, TheMeshHasNoColoursOfBlocks) {
    EXPECT_TRUE(meshView().picture.mesh);
    EXPECT_TRUE(meshView().picture.blocks.empty());
    EXPECT_EQ(meshView().legend.kinds.size(), 2u);
}

TEST(OverlayViews, NewLightIsBrightAndOldLightDark) {
    std::vector<LitObject> objects{
        {"", glm::dmat4(1.0), true, glm::dmat4(1.0), litNode(litSquare())}};
    BlockAges ages;
    ages.advance(objects, 10);
    const auto colourAt = [&](double now) {
        return ageView(objects, ages, now).picture.blocks.at(objects[0].geometry.get()).at(0);
    };
    EXPECT_EQ(colourAt(10), blockColour(viridis(1)));
    EXPECT_EQ(colourAt(1000), blockColour(viridis(0)));
    // 10 s lie a third of the way from 100 s to 0.1 s.
    EXPECT_EQ(colourAt(20), blockColour(viridis(1 / 3.0f)));
    EXPECT_EQ(ageView(objects, ages, 20).legend.ticks.size(), 4u);
}

/// An object of three blocks.
std::vector<LitObject> threeBlocks() {
    LitMeshData data;
    data.positions.resize(160);
    data.normals.resize(160);
    data.direct.resize(160);
    data.indirect.resize(160);
    return {{"", glm::dmat4(1.0), true, glm::dmat4(1.0), litNode(std::move(data))}};
}

using Kind = BlockWork::Kind;

TEST(OverlayViews, EachKindOfOpenWorkHasAColourAndIsCounted) {
    const std::vector<LitObject> objects = threeBlocks();
    const std::vector<std::vector<BlockWork>> work{{{Kind::lamps, 1, 1}, {}, {Kind::coming, 0, 0}}};
    const OverlayView view = openWorkView(objects, work);
    const std::vector<glm::u8vec4>& colours = view.picture.blocks.at(objects[0].geometry.get());
    ASSERT_EQ(colours.size(), 3u);
    EXPECT_EQ(colours[0], blockColour(view.legend.kinds[0].colour));
    EXPECT_EQ(colours[1].a, 0) << "the picture stays where nothing is open";
    EXPECT_EQ(colours[2], blockColour(view.legend.kinds[1].colour));
    EXPECT_EQ(view.legend.kinds[0].label.substr(0, 2), "1 ");
    EXPECT_EQ(view.legend.kinds[2].label.substr(0, 2), "0 ");
}

TEST(OverlayViews, WorkThatIsWorthMoreIsBrighterAndTheScaleStays) {
    const std::vector<LitObject> objects = threeBlocks();
    std::vector<std::vector<BlockWork>> work{{{Kind::lamps, 1, 30}, {Kind::lamps, 1, 0.3f}, {}}};
    double most = 0;
    const auto colours = [&] {
        return importanceView(objects, work, most).picture.blocks.at(objects[0].geometry.get());
    };
    const std::vector<glm::u8vec4> first = colours(); // 0.01 ... 100
    EXPECT_EQ(most, 30);
    EXPECT_EQ(first[0], blockColour(viridis(LogScale{0.01, 100}.at(30))));
    EXPECT_EQ(first[1], blockColour(viridis(LogScale{0.01, 100}.at(0.3))));
    EXPECT_EQ(first[2].a, 0);
    work[0][0] = {};
    EXPECT_EQ(colours()[1], first[1]) << "though the most valuable work is done";
}

TEST(OverlayViews, NothingIsKnownOfWorkThatNobodyWatches) {
    const std::vector<LitObject> objects = threeBlocks();
    EXPECT_TRUE(openWorkView(objects, {}).picture.empty());
    double most = 0;
    EXPECT_TRUE(importanceView(objects, {}, most).picture.empty());
    EXPECT_FALSE(noImportanceView().legend.title.empty());
}

} // namespace

} // namespace penumbra
