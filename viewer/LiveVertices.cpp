#include "viewer/LiveVertices.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::size_t kBlock = LitGeometry::kBlock;

} // namespace

void LiveVertices::restore(Copy& copy, const ShownLight& from, std::uint32_t block) {
    const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, from.direct.size());
    for (std::size_t v = begin; v < end; ++v) {
        copy.light.direct[v] = from.direct[v];
        copy.light.indirect[v] = from.indirect[v];
    }
    copy.touched[block] = 1;
}

/// Takes over what has changed of the light, and takes back what the last frame did to it.
void LiveVertices::follow(Copy& copy, const ShownLight& from) {
    const std::size_t blocks = from.blockRevisions.size();
    if (copy.seen.size() != blocks || copy.light.direct.size() != from.direct.size()) {
        copy.light.direct.resize(from.direct.size());
        copy.light.indirect.resize(from.direct.size());
        copy.light.blockRevisions.resize(blocks, 0);
        copy.seen.assign(blocks, 0);
    }
    copy.touched.assign(blocks, 0);
    for (const std::uint32_t block : copy.live)
        if (block < blocks) restore(copy, from, block);
    copy.live.clear();
    for (std::uint32_t block = 0; block < blocks; ++block) {
        if (copy.seen[block] == from.blockRevisions[block]) continue;
        copy.seen[block] = from.blockRevisions[block];
        restore(copy, from, block);
    }
}

/// The formula of LiveLight. There is no more light than without obstacles: a corner that something
/// covered has its light from beside it, which is not to be added to that of the corner itself.
void LiveVertices::bringUpToDate(Copy& copy, const LiveLight& light, const ShownLight& from,
                                 const LiveRows::Reached& at) {
    const std::size_t begin = at.block * kBlock, end = std::min(begin + kBlock, from.direct.size());
    bool any = false;
    for (std::size_t l = 0; l < light.lamps.size(); ++l) {
        if (!(at.lamps >> l & 1)) continue;
        const LiveRows::Factors& now = rows_.factors(0, at, l);
        std::array<const LiveRows::Factors*, 3> then{};
        for (std::size_t a = 0; a < light.anchors.size(); ++a)
            then[a] = &rows_.factors(a + 1, at, l);
        for (std::size_t v = begin; v < end; ++v) {
            float change = 0;
            for (std::size_t a = 0; a < light.anchors.size(); ++a) {
                const LiveLight::Anchor& anchor = light.anchors[a];
                const float share = glm::mix(anchor.rest, anchor.behind, from.behind[v]);
                change += share * (now[v - begin] - (*then[a])[v - begin]);
            }
            if (change == 0) continue;
            const float known = from.factors[v][int(l)];
            if (known >= 0) {
                if (change > 0)
                    change = std::min(change, std::max(0.0f, rows_.unoccluded(at, l, v) - known));
                change = std::max(change, -known);
            }
            copy.light.direct[v] = copy.light.direct[v] + light.lamps[l].exitance * change;
            any = true;
        }
    }
    if (!any) return;
    for (std::size_t v = begin; v < end; ++v)
        for (int c = 0; c < 3; ++c)
            (&copy.light.direct[v].r)[c] = std::max(0.0f, (&copy.light.direct[v].r)[c]);
    copy.touched[at.block] = 1;
    copy.live.push_back(at.block);
}

void LiveVertices::update(const LiveLight& light, const ShownOf& shown) {
    if (!light.active()) {
        copies_.clear();
        rows_.forget();
        return;
    }
    rows_.prepare(light);
    for (const LiveRows::Reached& at : rows_.reached()) {
        const LitGeometry& geometry = *light.objects[at.object].geometry;
        if (shown(geometry)) copies_[&geometry].object = at.object;
    }
    for (auto& [geometry, copy] : copies_)
        if (const ShownLight* from = shown(*geometry)) follow(copy, *from);
    for (const LiveRows::Reached& at : rows_.reached()) {
        const LitGeometry& geometry = *light.objects[at.object].geometry;
        const ShownLight* const from = shown(geometry);
        if (from && !from->factors.empty()) bringUpToDate(copies_[&geometry], light, *from, at);
    }
    for (auto& [geometry, copy] : copies_)
        for (std::size_t block = 0; block < copy.touched.size(); ++block)
            if (copy.touched[block])
                copy.light.blockRevisions[block] = copy.light.revision = ++revision_;
}

const ShownLight* LiveVertices::shown(const LitGeometry& geometry) const {
    const auto found = copies_.find(&geometry);
    return found == copies_.end() ? nullptr : &found->second.light;
}

} // namespace penumbra
