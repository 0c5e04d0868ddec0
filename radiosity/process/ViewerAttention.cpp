#include "radiosity/process/ViewerAttention.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra {

Attention attentionFor(const View& view, const std::optional<Bounds>& moved, int height) {
    const double shape = std::abs(view.projection[1][1] / view.projection[0][0]);
    const double width = std::isfinite(shape) ? std::clamp(height * shape, 1.0, 1e5) : height;
    const Viewpoint from(view, int(width), height);
    GazeHints hints;
    if (moved) hints.dragged = glm::dvec3(moved->centre());
    Attention attention{from, Gaze(from, hints), 0, moved, {}};
    return attention;
}

void ViewerAttention::setPolicy(PolicyKind policy) {
    policyStale_ |= std::exchange(policy_, policy) != policy;
}

void ViewerAttention::setCamera(const View& view) {
    camera_ = view;
    stale_ = true;
}

void ViewerAttention::setMoved(const std::optional<Bounds>& box) {
    if (!box) return;
    moved_ = box;
    stale_ = true;
}

void ViewerAttention::setWhole(bool whole) {
    stale_ |= std::exchange(whole_, whole) != whole;
}

void ViewerAttention::update(Solver& solver, double now) {
    constexpr double kOften = 0.03; // [s]
    if (std::exchange(policyStale_, false)) solver.setPolicy(policy_);
    if (!stale_ || !camera_ || now - reported_ < kOften) return;
    Attention attention = attentionFor(*camera_, moved_);
    attention.whole = whole_;
    solver.attend(attention);
    stale_ = false;
    reported_ = now;
}

} // namespace penumbra
