#include "viewer/preview/CornerFade.h"

#include "viewer/preview/Smoothstep.h"

namespace penumbra {

CornerFade::Over CornerFade::over(std::uint32_t entry) const {
    const auto corner = corners_.find(entry);
    return corner != corners_.end() ? corner->second.now : Over{};
}

void CornerFade::put(std::uint32_t entry, std::uint32_t vertex, const Over& over) {
    if (over == Over{})
        corners_.erase(entry);
    else
        corners_[entry] = {vertex, over, over};
}

void CornerFade::advance(double time, double seconds, const FadeStart& fadeStart) {
    bool done = true;
    for (auto& [entry, corner] : corners_) {
        const std::optional<double> vertexStart = fadeStart(corner.vertex);
        if (vertexStart && (corner.start == kWaits || *vertexStart > corner.start)) {
            corner.start = time;
            corner.first = corner.now;
        }
        const float left = corner.start == kWaits ? 1 : 1 - smoothstep(time, corner.start, seconds);
        corner.now = {corner.first.direct * left, corner.first.indirect * left};
        done &= left == 0;
    }
    if (done) clear(); // all at once: which corners have copies is news for who draws them
}

void CornerFade::show(ShownLight& shown) const {
    if (corners_.empty()) return;
    for (const auto& [entry, corner] : corners_) {
        const std::uint32_t v = corner.vertex;
        shown.corners.entries.emplace_back(entry, std::uint32_t(shown.corners.copies.size()));
        shown.corners.copies.push_back(v);
        shown.direct.push_back(shown.direct[v] + corner.now.direct);
        shown.indirect.push_back(shown.indirect[v] + corner.now.indirect);
        if (shown.factors.empty()) continue;
        shown.factors.emplace_back(shown.factors[v]);
        shown.behind.push_back(float(shown.behind[v]));
    }
    shown.touchCopies();
}

void CornerFade::hide(ShownLight& shown) {
    if (shown.corners.empty()) return;
    const std::size_t vertices = shown.vertices();
    shown.corners = {};
    shown.direct.resize(vertices);
    shown.indirect.resize(vertices);
    if (!shown.factors.empty()) {
        shown.factors.resize(vertices);
        shown.behind.resize(vertices);
    }
    shown.touchCopies();
}

} // namespace penumbra
