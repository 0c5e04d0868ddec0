#include "viewer/preview/CornerFade.h"

#include "scenegraph/LitGeometry.h"
#include "viewer/preview/Smoothstep.h"

#include <algorithm>

namespace penumbra {

CornerFade::Over CornerFade::over(std::uint32_t entry) const {
    const auto corner = corners_.find(entry);
    return corner != corners_.end() ? corner->second.now : Over{};
}

void CornerFade::put(std::uint32_t entry, std::uint32_t vertex, const Over& over) {
    ++revision_;
    if (over == Over{})
        corners_.erase(entry);
    else
        corners_[entry] = {vertex, over, over};
}

void CornerFade::clear() {
    corners_.clear();
    ++revision_;
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
    if (shown.redrawnRevision != revision_) {
        shown.redrawnRevision = revision_;
        ++shown.revision;
    }
    if (corners_.empty()) return;
    ++shown.revision;
    const std::size_t first = shown.direct.size();
    for (const auto& [entry, corner] : corners_) {
        const std::uint32_t v = corner.vertex;
        shown.redrawn.emplace_back(entry, std::uint32_t(shown.copies.size()));
        shown.copies.push_back(v);
        shown.direct.push_back(shown.direct[v] + corner.now.direct);
        shown.indirect.push_back(shown.indirect[v] + corner.now.indirect);
        if (shown.factors.empty()) continue;
        shown.factors.emplace_back(shown.factors[v]);
        shown.behind.push_back(float(shown.behind[v]));
    }
    constexpr std::size_t kBlock = LitGeometry::kBlock;
    shown.blockRevisions.resize((shown.direct.size() + kBlock - 1) / kBlock);
    std::fill(shown.blockRevisions.begin() + std::ptrdiff_t(first / kBlock),
              shown.blockRevisions.end(), shown.revision);
}

void CornerFade::hide(ShownLight& shown, std::size_t vertices) {
    if (shown.copies.empty()) return;
    shown.copies.clear();
    shown.redrawn.clear();
    shown.direct.resize(vertices);
    shown.indirect.resize(vertices);
    if (!shown.factors.empty()) {
        shown.factors.resize(vertices);
        shown.behind.resize(vertices);
    }
    shown.blockRevisions.resize((vertices + LitGeometry::kBlock - 1) / LitGeometry::kBlock);
}

} // namespace penumbra
