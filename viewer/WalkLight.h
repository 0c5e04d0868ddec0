// The light of a scene that is walked through.
#pragma once

#include "radiosity/RadiosityNode.h"
#include "radiosity/process/LightingLink.h"
#include "scenegraph/Frustum.h"
#include "viewer/DrawList.h"

#include <memory>
#include <string>
#include <vector>

namespace penumbra {

class Walkthrough;

/// Keeps a RadiosityNode beside a walkthrough: tells it what is edited, held and seen, and lists
/// what is to be drawn, lit or not yet. Never waits.
class WalkLight {
public:
    /// \param walk its scene must outlive this
    /// \param link where the light is computed: a process, or, for tests, a thread
    WalkLight(const Walkthrough& walk, const RadiosityOptions& options,
              std::unique_ptr<LightingLink> link);
    ~WalkLight();
    WalkLight(const WalkLight&) = delete;
    WalkLight& operator=(const WalkLight&) = delete;

    /// To be called once a frame. Whether there is new light to be drawn.
    bool update(const Walkthrough& walk, const View& view);

    void setTrigger(Trigger trigger);
    void requestUpdate() { node_->requestUpdate(); }

    /// What is to be drawn in a view: the lit surfaces, and the meshes and lights of objects that
    /// have no light yet.
    DrawList listVisible(const Frustum& frustum) const;
    /// Everything that has light.
    const Group& lit() const { return node_->lit(); }
    /// Whether all that is visible has light.
    bool complete() const;

    RadiosityNode& node() { return *node_; }
    const RadiosityState& state() const { return node_->state(); }
    /// One line each, once, for people.
    std::vector<std::string> takeMessages() { return node_->takeMessages(); }

private:
    const Group& scene_;
    std::shared_ptr<RadiosityNode> node_;
    std::shared_ptr<const Transform> inHand_;
    Trigger trigger_;
    glm::dmat4 seenFrom_{0.0};
    std::uint64_t blocks_ = 0;
    RadiosityState::Phase phase_ = RadiosityState::Phase::off;
    std::size_t unlit_ = 0;
};

} // namespace penumbra
