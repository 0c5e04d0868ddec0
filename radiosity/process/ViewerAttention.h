// What a worker knows of the viewer, and tells its solver.
#pragma once

#include "importance/WorkValue.h"
#include "radiosity/Solver.h"
#include "scenegraph/Bounds.h"
#include "scenegraph/Camera.h"

#include <optional>

namespace penumbra {

/// The viewer's camera, the things that were moved last, and the order of work that is wanted.
/// News are passed on at most every 30 ms: a camera that turns all the time costs little, and still
/// nothing is ever done in an order that is older than two pictures.
class ViewerAttention {
public:
    void setOrder(UpdateOrder order);
    void setCamera(const View& view);
    /// Things were moved. \param box around them [m, world]; none: nothing was, but other edits
    void setMoved(const std::optional<Bounds>& box);
    /// Whether light is shown by whole blocks only, as it is while lamps are live.
    void setWhole(bool whole);
    /// The solver is another one: it knows nothing.
    void solverIsNew() { orderStale_ = stale_ = true; }

    /// \param now steady clock [s]
    void tell(Solver& solver, double now);

private:
    Attention attention() const;

    UpdateOrder order_ = UpdateOrder::importance;
    std::optional<View> camera_;
    std::optional<Bounds> moved_;
    bool whole_ = false;
    bool orderStale_ = true, stale_ = false;
    double told_ = 0; ///< when [s]
};

/// How a picture of this view is looked at: the eye in the middle of it, or on what is moved.
/// \param moved box around the things in someone's hand, or moved last [m, world]
/// \param height of the picture [pixels]; its width follows the view
Attention attentionFor(const View& view, const std::optional<Bounds>& moved, int height = 720);

} // namespace penumbra
