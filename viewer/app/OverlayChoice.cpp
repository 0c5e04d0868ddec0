#include "viewer/app/OverlayChoice.h"

#include "radiosity/query/LightProbe.h"

#include <optional>
#include <vector>

namespace penumbra {

namespace {

/// At the pointer, in the scene as it is now, so that the answer keeps up with what is moved.
OverlayView blockers(const Walkthrough& walk, const WalkLight& light, glm::ivec2 picture) {
    const std::optional<Touch> touch = walk.pointedAt(picture);
    const auto& selection = walk.selection();
    const bool one = selection && !selection->lights.empty();
    std::vector<EmitterAccount> lights;
    if (touch)
        lights = lightsOf(probeLight(walk.placed(), walk.rays(), touch->position, touch->normal),
                          one ? selection->objectPath : std::string());
    return blockersView(light.objects(), light.placed(), walk.placed(), lights,
                        one ? "of what is selected, at the pointer" : "at the pointer");
}

} // namespace

OverlayView overlayView(Overlay overlay, const Walkthrough& walk, const WalkLight& light,
                        glm::ivec2 picture, bool ranked, double& highestPriority) {
    switch (overlay) {
    case Overlay::none:
        break;
    case Overlay::mesh:
        return meshView();
    case Overlay::age:
        return ageView(light.objects(), light.ages(), walk.time());
    case Overlay::dirtyBlocks:
        return dirtyView(light.objects(), light.dirtyBlocks());
    case Overlay::importance:
        if (!ranked) return noImportanceView();
        return importanceView(light.objects(), light.dirtyBlocks(), highestPriority);
    case Overlay::blockers:
        return blockers(walk, light, picture);
    }
    return {};
}

bool overlayChanging(Overlay overlay, const Walkthrough& walk, const WalkLight& light) {
    if (watchesDirty(overlay)) return !light.state().reached(SolutionState::exact);
    return overlay == Overlay::age && walk.time() - light.ages().newest() < kAgeScale.first;
}

} // namespace penumbra
