#include "viewer/preview/PreviewScene.h"

#include "base/Clock.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace penumbra {

PreviewScene::PreviewScene(PatchSet set)
    : set_(std::move(set)), posed_(set_), aside_(raysThrough(set_)), poses_(set_.objects.size()),
      asideAs_(set_.objects.size()) {
    for (std::uint32_t o = 0; o < set_.objects.size(); ++o)
        asidePoses_.push_back({{o}, set_.objects[o].pose, set_.objects[o].present});
    for (const VertexBlend& blend : set_.vertexBlends)
        for (std::size_t k = 0; k < 4 && blend.weights[k] > 0; ++k)
            receivers_.push_back(blend.vertices[k]);
    std::ranges::sort(receivers_);
    receivers_.erase(std::unique(receivers_.begin(), receivers_.end()), receivers_.end());
}

/// What has another pose than in `places`, which follow.
std::vector<PosedPatches::ObjectPose> PreviewScene::follow(ObjectStates& states,
                                                           const SceneState& sceneState) {
    std::vector<ObjectPose> wanted;
    const std::size_t count = std::min(states.size(), sceneState.objects.size());
    for (std::uint32_t o = 0; o < count; ++o) {
        const SceneState::ObjectState& place = sceneState.objects[o];
        if (states[o] == place) continue;
        states[o] = place;
        wanted.push_back({{o}, placementOf(place.toWorld).pose, place.visible});
    }
    return wanted;
}

void PreviewScene::pose(const SceneState& sceneState) {
    const double begun = steadySeconds();
    posed_.pose(follow(poses_, sceneState));
    if (!secondsForAll_) secondsForAll_ = steadySeconds() - begun;
}

bool PreviewScene::isPosedAs(const SceneState& sceneState) const {
    return std::ranges::equal(poses_, sceneState.objects);
}

double PreviewScene::secondsToPose(const std::vector<bool>& moves) const {
    double elements = 0;
    for (std::uint32_t o = 0; o < set_.objects.size(); ++o)
        if (moves[o]) elements += set_.objects[o].elements.count;
    return secondsForAll_.value_or(0) * elements / std::max(1.0, double(set_.elements.size()));
}

const RayScene& PreviewScene::raysAt(const SceneState& sceneState) {
    bool changed = false;
    for (const ObjectPose& pose : follow(asideAs_, sceneState)) {
        const ObjectId object = pose.object;
        ObjectPose& now = asidePoses_[object.value];
        if (pose.present == now.present && pose.pose == now.pose) continue;
        changed = true;
        if (pose.present != now.present) aside_.show(object, pose.present);
        if (pose.pose != now.pose) {
            std::vector<glm::vec3> vertices = set_.objects[object.value].shape.rayVertices;
            for (glm::vec3& vertex : vertices) vertex = pose.pose.point(vertex);
            aside_.move(object, vertices);
        }
        now = pose;
    }
    if (changed) aside_.commit();
    return aside_;
}

std::vector<std::uint32_t> PreviewScene::receiversAside() const {
    std::vector<std::uint32_t> aside;
    std::ranges::copy_if(receivers_, std::back_inserter(aside),
                         [&](std::uint32_t v) { return !set_.isDrawnAsIs(v); });
    return aside;
}

Bounds PreviewScene::withReceivers(const Bounds& box) const {
    return grown(box, hoverAt(set_.skin, magnitude(box)));
}

Receiver PreviewScene::receiver(std::uint32_t object, std::size_t vertex) const {
    return set_.vertices[set_.objects[object].vertices.first + vertex].receiver;
}

Receiver PreviewScene::receiver(std::uint32_t object, std::size_t vertex, const Pose& pose) const {
    const ObjectPart& part = set_.objects[object];
    return placedReceiver(part.shape.vertices[vertex].receiver, pose, set_.skin);
}

std::vector<TouchedCorner> PreviewScene::touched() const {
    std::vector<TouchedCorner> found;
    for (std::size_t i = 0; i < set_.privateElement.size(); ++i) {
        const std::size_t vertex = set_.firstPrivate + i;
        const Receiver& at = set_.vertices[vertex].receiver;
        if (isPadding(at)) continue;
        const std::uint32_t element = set_.privateElement[i];
        const ObjectId object = set_.elementObject[element];
        const auto& corners = set_.elements[element].vertices;
        const auto k = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
        if (k == 4) continue;
        const std::uint32_t local = element - set_.objects[object.value].elements.first;
        found.push_back({object.value, 4 * local + std::uint32_t(k), at});
    }
    std::sort(found.begin(), found.end(), [](const TouchedCorner& a, const TouchedCorner& b) {
        return std::tie(a.object, a.corner) < std::tie(b.object, b.corner);
    });
    return found;
}

std::span<const Element> PreviewScene::elements(std::uint32_t object) const {
    const Range& range = set_.objects[object].elements;
    return std::span(set_.uncoveredElements).subspan(range.first, range.count);
}

} // namespace penumbra
