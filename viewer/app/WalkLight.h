// The light of a scene that is walked through.
#pragma once

#include "radiosity/process/LightingLink.h"
#include "radiosity/process/RadiosityNode.h"
#include "scenegraph/Frustum.h"
#include "scenegraph/Objects.h"
#include "viewer/overlay/BlockAges.h"
#include "viewer/preview/DrawList.h"
#include "viewer/preview/LightBlend.h"
#include "viewer/preview/Preview.h"
#include "viewer/preview/PreviewLightChoice.h"
#include "viewer/shadowmaps/MapPreview.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

class Walkthrough;

/// Keeps a RadiosityNode beside a walkthrough: reports to it what is edited, held and seen, and
/// lists what is to be drawn, lit or not yet. Never waits.
class WalkLight {
public:
    /// \param walk its scene must outlive this
    /// \param link where the light is computed: a process, or, for tests, a thread
    WalkLight(const Walkthrough& walk, const RadiosityOptions& options,
              std::unique_ptr<LightingLink> link, const BlendOptions& blend = {});
    ~WalkLight();
    WalkLight(const WalkLight&) = delete;
    WalkLight& operator=(const WalkLight&) = delete;

    /// To be called once a frame, at the walkthrough's time. Whether there is new light to be
    /// drawn.
    bool update(const Walkthrough& walk, const View& view);

    void setTrigger(Trigger trigger);
    void setPolicy(PolicyKind policy);
    /// See RadiosityNode.
    void watchDirty(bool watch) { node_->watchDirty(watch); }
    std::span<const std::vector<DirtyStatus>> dirtyBlocks() const { return node_->dirtyBlocks(); }
    void requestUpdate() { node_->requestUpdate(); }

    /// What is to be drawn in a view: the lit surfaces, and the meshes and lights of objects that
    /// have no light yet.
    DrawList listVisible(const Frustum& frustum) const;
    /// For the renderer to draw what moves by shadow maps; null: listVisible() has its light. Its
    /// context has to be current when this ends.
    MapPreview* maps() { return maps_; }
    PreviewMethod previewMethod() const { return preview_->method(); }
    std::size_t lightsPreviewed() const { return blend_.preview().lights.size(); }
    /// Whether direct light is on its way on the screen.
    bool fading() const { return blend_.fading(); }
    /// Whether vertices still wait for light that is exact for the scene as it is now.
    bool waiting() const { return blend_.waiting(); }
    /// Everything that has light.
    const Group& lit() const { return node_->lit(); }
    /// Whether all that is visible has light.
    bool complete() const;
    /// Whether the scene has had nothing to be lit by so far: all of it is listed as unlit. Lights
    /// that go out leave the dark.
    bool dark() const { return !hadLights_; }

    std::span<const LitObject> objects() const { return node_->objects(); }
    const PlacedScene& placed() const { return node_->placed(); }
    /// When the light of blocks was published, at the walkthrough's time.
    const BlockAges& ages() const { return ages_; }
    RadiosityNode& node() { return *node_; }
    const RadiosityState& state() const { return node_->state(); }
    /// One line each, once, for people.
    std::vector<std::string> takeMessages() { return node_->takeMessages(); }

private:
    void choosePreview();
    void chooseLights(const Walkthrough& walk);
    void updatePreview(const Walkthrough& walk, const View& view);
    PreviewMethod wantedMethod() const { return by_.value_or(choice_.method()); }

    const Group& scene_;
    std::shared_ptr<RadiosityNode> node_;
    LightBlend blend_;
    BlockAges ages_;
    std::optional<PreviewMethod> by_; ///< none: by choice_
    PreviewChoice choice_;
    std::unique_ptr<Preview> preview_;
    MapPreview* maps_ = nullptr; ///< preview_, if it is that
    int samples_;                ///< of the light, and of its preview by rays
    double slice_;               ///< see BlendOptions
    std::size_t mostLights_;     ///< emitters previewed at most
    PreviewMethod lightsBy_{};   ///< that previewed lights were chosen for
    bool lightsLit_ = false;     ///< lightsFor_ was answered when all was lit
    std::uint64_t lightsOf_ = 0; ///< revision of the walkthrough, and
    ObjectId lightsFor_;         ///< the object, that previewed lights were chosen for
    std::shared_ptr<const Transform> inHand_;
    Trigger trigger_;
    PolicyKind policy_;
    glm::dmat4 seenFrom_{0.0};
    std::uint64_t blocks_ = 0;
    RadiosityState::Phase phase_ = RadiosityState::Phase::off;
    SolutionState solution_ = SolutionState::working;
    std::size_t unlit_ = 0;
    bool hadLights_ = false;
};

} // namespace penumbra
