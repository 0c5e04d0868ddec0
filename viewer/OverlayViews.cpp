#include "viewer/OverlayViews.h"

#include "radiosity/RadiosityNode.h"
#include "viewer/BlockAges.h"
#include "viewer/ColourMap.h"
#include "viewer/OverlayPass.h"

namespace penumbra {

OverlayView meshView() {
    OverlayView view;
    view.picture.mesh = true;
    view.legend.title = "Mesh";
    view.legend.kinds = {
        {kindColour(OverlayPass::kPatchKind), "patches, which send light"},
        {kindColour(OverlayPass::kElementKind), "elements, at whose corners it is received"}};
    return view;
}

OverlayView ageView(std::span<const LitObject> objects, const BlockAges& ages, double now) {
    OverlayView view;
    view.legend.title = "Age of the light [s]";
    view.legend.ticks = ticksOf(kAgeScale);
    for (const LitObject& object : objects) {
        if (!object.geometry) continue;
        std::vector<glm::u8vec4>& colours = view.picture.blocks[object.geometry.get()];
        for (const double time : ages.times(*object.geometry))
            colours.push_back(blockColour(viridis(kAgeScale.at(now - time))));
    }
    return view;
}

} // namespace penumbra
