// What a worker knows of the viewer, and passes on to its solver.
#pragma once

#include "base/Bounds.h"
#include "importance/Priority.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Camera.h"

#include <optional>

namespace penumbra {

/// The viewer's camera, the things that were moved last, and the scheduling policy that is wanted.
/// News are passed on at most every 30 ms: a camera that turns all the time costs little, and still
/// nothing is ever done in an order that is older than two pictures.
class ViewerAttention {
public:
    void setPolicy(PolicyKind policy);
    void setCamera(const View& view);
    /// Things were moved. \param box around them [m, world]; none: nothing was, but other edits
    void setMoved(const std::optional<Bounds>& box);
    /// Whether light is shown by whole blocks only, as it is while lights are previewed.
    void setWhole(bool whole);
    /// There is a new solver: it knows nothing of the viewer.
    void solverIsNew() { policyStale_ = stale_ = true; }

    /// \param now steady clock [s]
    void update(Solver& solver, double now);

private:
    Attention attention() const;

    PolicyKind policy_ = PolicyKind::importance;
    std::optional<View> camera_;
    std::optional<Bounds> moved_;
    bool whole_ = false;
    bool policyStale_ = true, stale_ = false;
    double reported_ = 0; ///< when [s]
};

/// Where the eye is in a picture of this view: in the middle of it, or on what is moved.
/// \param moved box around the things in someone's hand, or moved last [m, world]
/// \param height of the picture [pixels]; its width follows the view
Attention attentionFor(const View& view, const std::optional<Bounds>& moved, int height = 720);

} // namespace penumbra
