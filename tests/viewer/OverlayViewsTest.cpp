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

} // namespace

} // namespace penumbra
