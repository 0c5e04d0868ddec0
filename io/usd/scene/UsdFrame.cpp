#include "io/usd/scene/UsdFrame.h"

#include <utility>

namespace penumbra {

struct UsdFrame::Motion {
    UsdFrame above;
    std::shared_ptr<const Transform> node;
};

// The same products as when a scene is loaded, from the root down: so they round alike.
glm::dmat4 UsdFrame::toWorld() const {
    return motion_ ? motion_->above.toWorld() * motion_->node->matrix() : fixed_;
}

UsdFrame UsdFrame::below(std::shared_ptr<const Transform> node, bool changes) const {
    UsdFrame frame;
    if (moves() || changes)
        frame.motion_ = std::make_shared<Motion>(Motion{*this, std::move(node)});
    else
        frame.fixed_ = fixed_ * node->matrix();
    return frame;
}

} // namespace penumbra
