#include "viewer/overlay/OverlayViews.h"

#include "radiosity/process/RadiosityNode.h"
#include "scenegraph/Objects.h"
#include "tests/viewer/gl/LitScenes.h"
#include "viewer/overlay/BlockAges.h"
#include "viewer/overlay/ColourMap.h"

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

using Kind = DirtyStatus::Kind;

TEST(OverlayViews, EachKindOfDirtySetHasAColourAndIsCounted) {
    const std::vector<LitObject> objects = threeBlocks();
    const std::vector<std::vector<DirtyStatus>> work{
        {{Kind::lights, 1, 1}, {}, {Kind::coming, 0, 0}}};
    const OverlayView view = dirtyView(objects, work);
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
    std::vector<std::vector<DirtyStatus>> work{
        {{Kind::lights, 1, 30}, {Kind::lights, 1, 0.3f}, {}}};
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
    EXPECT_TRUE(dirtyView(objects, {}).picture.empty());
    double most = 0;
    EXPECT_TRUE(importanceView(objects, {}, most).picture.empty());
    EXPECT_FALSE(noImportanceView().legend.title.empty());
}

/// 60 of 100 lux of one light are taken, 40 by a box and 20 by the walls; another one gives 100.
std::vector<EmitterAccount> twoLights() {
    return {{"/ceiling/lamp", Rgb(100), Rgb(40), {{ObjectId{1}, Rgb(40)}, {ObjectId{0}, Rgb(20)}}},
            {"/desk/lamp", Rgb(100), Rgb(100), {}}};
}

TEST(OverlayViews, BlockersAreTintedByTheirShareAndNamedWithTheirLux) {
    const std::vector<LitObject> objects{
        {"//", glm::dmat4(1.0), true, glm::dmat4(1.0), litNode(litSquare(), 0)},
        {"//box", glm::dmat4(1.0), true, glm::dmat4(1.0), litNode(litSquare(), 1)}};
    PlacedScene below, scene;
    below.objects = {{"//"}, {"//box"}};
    scene.objects = {{"/"}, {"/box"}};
    const std::vector<EmitterAccount> lights = twoLights();
    const OverlayView all = blockersView(objects, below, scene, lights, "here");
    EXPECT_EQ(all.picture.blocks.size(), 1u) << "walls are everywhere: they are only named";
    EXPECT_EQ(all.picture.blocks.at(objects[1].geometry.get()).at(0), blockColour(viridis(0.2f)));
    ASSERT_EQ(all.legend.kinds.size(), 2u);
    EXPECT_EQ(all.legend.kinds[0].label, "40 lux (20 %) taken by /box");
    EXPECT_EQ(all.legend.kinds[1].label, "20 lux (10 %) taken by what can't be moved");
    EXPECT_EQ(all.legend.lines.at(0), "40 of 100 lux from /ceiling/lamp");
    EXPECT_EQ(all.legend.lines.at(1), "100 of 100 lux from /desk/lamp");

    const OverlayView one =
        blockersView(objects, below, scene, lightsOf(lights, "/ceiling"), "here");
    EXPECT_EQ(one.legend.kinds[0].label, "40 lux (40 %) taken by /box");
}

TEST(OverlayViews, OfASelectedLightOnlyItsOwnAccountIsGiven) {
    EXPECT_EQ(lightsOf(twoLights(), "").size(), 2u);
    ASSERT_EQ(lightsOf(twoLights(), "/desk").size(), 1u);
    EXPECT_EQ(lightsOf(twoLights(), "/desk")[0].path, "/desk/lamp");
    EXPECT_EQ(lightsOf(twoLights(), "/ceil").size(), 2u) << "another name";
}

TEST(OverlayViews, WhereNoLightShinesThatIsSaid) {
    const OverlayView view = blockersView({}, {}, {}, {}, "here");
    EXPECT_TRUE(view.picture.empty());
    EXPECT_EQ(view.legend.lines.size(), 1u);
}

} // namespace

} // namespace penumbra
