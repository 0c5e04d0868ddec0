#include "viewer/OverlayViews.h"

#include "radiosity/RadiosityNode.h"
#include "viewer/BlockAges.h"
#include "viewer/ColourMap.h"
#include "viewer/OverlayPass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace penumbra {

namespace {

/// Calls visit(geometry, work) for all blocks of objects of which the work is known.
template <class Visit>
void forEachBlock(std::span<const LitObject> objects, WorkOfObjects work, Visit visit) {
    for (std::size_t o = 0; o < std::min(objects.size(), work.size()); ++o)
        if (objects[o].geometry)
            for (const BlockWork& block : work[o]) visit(*objects[o].geometry, block);
}

} // namespace

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

OverlayView openWorkView(std::span<const LitObject> objects, WorkOfObjects work) {
    struct Shown {
        BlockWork::Kind kind;
        std::size_t colour; ///< see kindColour()
        const char* label;
        std::size_t blocks = 0;
    };
    std::array<Shown, 4> kinds{{{BlockWork::Kind::lamps, 0, "light of lamps is open"},
                                {BlockWork::Kind::coming, 3, "worked on, about to be shown"},
                                {BlockWork::Kind::patches, 1, "light from patches is open"},
                                {BlockWork::Kind::putOff, 6, "put off: too little to matter yet"}}};
    OverlayView view;
    forEachBlock(objects, work, [&](const LitGeometry& geometry, const BlockWork& block) {
        glm::u8vec4 colour(0);
        for (Shown& shown : kinds)
            if (block.kind == shown.kind) {
                colour = blockColour(kindColour(shown.colour));
                ++shown.blocks;
            }
        view.picture.blocks[&geometry].push_back(colour);
    });
    view.legend.title = "Open work [blocks of 64 vertices]";
    for (const Shown& shown : kinds)
        view.legend.kinds.push_back(
            {kindColour(shown.colour), std::to_string(shown.blocks) + "  " + shown.label});
    return view;
}

OverlayView importanceView(std::span<const LitObject> objects, WorkOfObjects work, double& most) {
    OverlayView view;
    std::size_t open = 0;
    forEachBlock(objects, work, [&](const LitGeometry&, const BlockWork& block) {
        open += block.worth > 0;
        most = std::max(most, double(block.worth));
    });
    const double last = most > 0 ? std::pow(10.0, std::ceil(std::log10(most))) : 1;
    const LogScale scale{1e-4 * last, last};
    forEachBlock(objects, work, [&](const LitGeometry& geometry, const BlockWork& block) {
        view.picture.blocks[&geometry].push_back(
            block.worth > 0 ? blockColour(viridis(scale.at(double(block.worth)))) : glm::u8vec4(0));
    });
    view.legend.title =
        "Worth of open work [visible steps x pixel / ray], " + std::to_string(open) + " blocks";
    view.legend.ticks = ticksOf(scale);
    return view;
}

OverlayView noImportanceView() {
    OverlayView view;
    view.legend.title = "No importance: the order of work is another one";
    return view;
}

} // namespace penumbra
