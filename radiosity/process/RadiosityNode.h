// The part of a scene graph that is lit by radiosity.
#pragma once

#include "base/Bounds.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/process/RadiosityOptions.h"
#include "radiosity/process/RadiosityState.h"
#include "radiosity/process/store/DirtyStatus.h"
#include "radiosity/process/store/PublishedGeometry.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Group.h"

#include "scenegraph/Objects.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

class LightingLink;
class Transform;

/// One object below a RadiosityNode as it is lit.
struct LitObject {
    std::string path;         ///< of the object, from below the node: that of Object
    glm::dmat4 toNode{1.0};   ///< of its own frame now, to the node's
    bool visible = true;      ///< false: hidden, or no longer in the graph
    glm::dmat4 toObject{1.0}; ///< of the geometry's frame to the object's own
    /// Its patches with their light; the same node as long as the scene is not meshed anew. Null
    /// until all of it has light.
    std::shared_ptr<PublishedGeometry> geometry;
    std::vector<EmissiveMesh> emissive = {}; ///< in the frame of the geometry
};

/// A group of which everything below is lit by radiosity, in a thread or a process of its own.
///
///     auto lit = std::make_shared<RadiosityNode>("lit", options, makeThreadLink());
///     lit->add(room);                  // instead of root->add(room)
///     root->add(lit);
///     for (;;) {                       // the render loop
///         chair->setMatrix(...);       // edits are made to the graph, and nowhere else
///         lit->update();               // never waits
///         renderer.render(*root, ...); // draws lit(), which is below this node
///     }
///
/// update() finds what was edited below by the nodes' revisions: Transform matrices, Switch
/// visibility, lights, materials, children that come and go. It sends this when the trigger says
/// so, and takes in what has been computed since: only the blocks that changed are copied. An
/// object that has light is drawn by its LitGeometry, where the object is now; what has none
/// yet is listed in unlit() for the renderer to shade as it can.
///
/// The worker may die, hang or write nonsense: the node says so once (takeMessages()), goes on
/// with the light it has, starts another worker and hands it the scene with all edits so far.
///
/// All calls belong to one thread, the renderer's. Frames and paths are those of this node: what
/// is above it does not count.
class RadiosityNode : public Group {
public:
    RadiosityNode(std::string name, const RadiosityOptions& options,
                  std::unique_ptr<LightingLink> link);
    ~RadiosityNode() override;

    /// The children, and then lit().
    void accept(Visitor& visitor) const override;

    /// To be called once a frame. Takes at most a few milliseconds, whatever the worker does.
    void update();
    /// Ends the worker; the light that there is stays.
    /// update() does nothing until start(). A new node has started.
    void stop();
    void start();

    /// When edits are sent. All may be switched at any time, also in the middle of a drag.
    void setTrigger(Trigger trigger);
    /// For edits of one node (Transform, Switch, Light), instead of the trigger of all; none: back
    /// to that.
    void setTrigger(const Node& node, std::optional<Trigger> trigger);
    /// A person has taken hold of a node, or lets go of it again.
    void grab(const Node& node);
    void release(const Node& node);
    /// Sends all that was held back: what Trigger::onDemand waits for.
    void requestUpdate();

    /// Has what lies in a box, or is crossed by light through it, evaluated anew [m, this frame].
    void invalidate(const Bounds& box);
    /// Which dirty blocks come first, from now on. The light that comes out is the same.
    void setPolicy(PolicyKind policy);
    /// From where the scene is seen: with the policy `importance`, what is in view comes first.
    void setCamera(const View& view);
    /// Lights of which each one's own part is wanted as well, by their paths as Placed<Light> and
    /// Emitter have them, at most kMostPreviewLights. Their light comes as one LightShare each, in
    /// this order.
    void setPreviewLights(std::vector<std::string> paths);
    const std::vector<std::string>& previewLights() const;

    /// Has the worker report its dirty set, some thirty times a second. It costs nothing when
    /// nobody watches.
    void watchDirty(bool watch);
    /// By object, one a block of its geometry; empty: nobody watches, or it is not known yet.
    std::span<const std::vector<DirtyStatus>> dirtyBlocks() const;

    /// Everything below that has light: Switches with a Transform and a LitGeometry each. They
    /// follow the objects in update().
    const Group& lit() const { return *lit_; }
    /// The objects of lit(); LitGeometry::object() is the index.
    std::span<const LitObject> objects() const;
    /// What of objects() receives light and stands in its way, without the light, for those who
    /// trace rays of their own: objects, vertices and elements are those of the geometries, in the
    /// same order (see readPatches()). Takes some time: to be kept as long as the geometries are
    /// the same. None: there is no light, or none that makes sense.
    std::optional<PatchSet> patches() const;
    /// What is visible, but not in lit(): toWorld is to the node's frame.
    const std::vector<Placed<Mesh>>& unlit() const;
    /// What is below, as update() saw it last.
    const PlacedScene& placed() const;

    const RadiosityState& state() const;
    /// One line each, for people; each is given once.
    std::vector<std::string> takeMessages();

private:
    struct Impl;
    std::shared_ptr<Group> lit_;
    std::unique_ptr<Impl> impl_;
};

} // namespace penumbra
