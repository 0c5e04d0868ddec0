#include "viewer/preview/RayPreview.h"

#include "base/Parallel.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::size_t kBlock = LitGeometry::kBlock;

Rgb atLeastNone(Rgb light) {
    return {std::max(0.0f, light.r), std::max(0.0f, light.g), std::max(0.0f, light.b)};
}

/// What an entry of LitMeshData::indices is drawn with, if not with this vertex.
std::size_t drawnAt(const ShownLight& shown, std::uint32_t entry, std::size_t vertex) {
    const auto at = std::lower_bound(shown.redrawn.begin(), shown.redrawn.end(), entry,
                                     [](const auto& r, std::uint32_t e) { return r.first < e; });
    if (at == shown.redrawn.end() || at->first != entry) return vertex;
    return shown.direct.size() - shown.copies.size() + at->second;
}

} // namespace

void RayPreview::restore(Copy& copy, const ShownLight& from, std::uint32_t block) {
    const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, from.direct.size());
    for (std::size_t v = begin; v < end; ++v) {
        copy.light.direct[v] = from.direct[v];
        copy.light.indirect[v] = from.indirect[v];
    }
    copy.touched[block] = 1;
}

/// Takes over what has changed of the light, and takes back what the last frame did to it.
void RayPreview::follow(Copy& copy, const ShownLight& from) {
    const std::size_t blocks = from.blockRevisions.size();
    if (copy.seen.size() != blocks || copy.vertices != from.direct.size()) {
        copy.vertices = from.direct.size();
        copy.light.direct.resize(copy.vertices);
        copy.light.indirect.resize(copy.vertices);
        copy.light.blockRevisions.resize(blocks, 0);
        copy.seen.resize(blocks, 0);
    }
    copy.touched.assign(blocks, 0);
    for (const std::uint32_t block : copy.preview)
        if (block < blocks) restore(copy, from, block);
    copy.preview.clear();
    for (std::uint32_t block = 0; block < blocks; ++block) {
        if (copy.seen[block] == from.blockRevisions[block]) continue;
        copy.seen[block] = from.blockRevisions[block];
        restore(copy, from, block);
    }
}

/// Factors of a light at a block, in the scene states of the anchors.
RayPreview::Then RayPreview::thenOf(const PreviewLighting& light, std::size_t at,
                                    std::size_t source) const {
    Then then{};
    for (std::size_t a = 0; a < light.anchors.size(); ++a)
        then[a] = &rows_.factors(a + 1, at, source);
    return then;
}

/// The formula of PreviewLighting for one light, over its exitance. There is no less light than
/// none, and no more than without obstacles. \param unoccluded asked for what the light gives then,
/// if that matters
template <class Unoccluded>
float RayPreview::change(const PreviewLighting& light, const ShownLight& from, const Then& then,
                         std::size_t source, std::size_t vertex, float now,
                         const Unoccluded& unoccluded) {
    float change = 0;
    for (std::size_t a = 0; a < light.anchors.size(); ++a) {
        const PreviewLighting::Anchor& anchor = light.anchors[a];
        const float share = glm::mix(anchor.rest, anchor.behind, from.behind[vertex]);
        change += share * (now - (*then[a])[vertex % kBlock]);
    }
    const float known = from.factors[vertex][source];
    if (known < 0) return change;
    if (change > 0) change = std::min(change, std::max(0.0f, unoccluded() - known));
    return std::max(change, -known);
}

/// \return whether anything of the block differs from what it carries
bool RayPreview::bringUpToDate(Copy& copy, const PreviewLighting& light, const ShownLight& from,
                               std::size_t reached) const {
    const PreviewRows::Reached& at = rows_.reached()[reached];
    const std::size_t begin = at.block * kBlock, end = std::min(begin + kBlock, from.direct.size());
    bool any = false;
    for (std::size_t l = 0; l < light.lights.size(); ++l) {
        if (!(at.lights >> l & 1)) continue;
        const PreviewRows::Factors& now = rows_.factors(0, reached, l);
        const Then then = thenOf(light, reached, l);
        for (std::size_t v = begin; v < end; ++v) {
            if (!(at.vertices >> (v - begin) & 1)) continue;
            const float by = change(light, from, then, l, v, now[v - begin],
                                    [&] { return rows_.unoccluded(at, l, v); });
            if (by == 0) continue;
            copy.light.direct[v] = copy.light.direct[v] + light.lights[l].exitance * by;
            any = true;
        }
    }
    if (any)
        for (std::size_t v = begin; v < end; ++v)
            copy.light.direct[v] = atLeastNone(copy.light.direct[v]);
    return any;
}

/// Each block is listed once, so that they can be worked on side by side.
void RayPreview::bringAllUpToDate(const PreviewLighting& light, const ShownOf& shown) {
    const std::span<const PreviewRows::Reached> reached = rows_.reached();
    const auto geometryOf = [&](std::size_t i) {
        return light.objects[reached[i].object].geometry.get();
    };
    std::vector<std::uint8_t> differs(reached.size());
    parallelFor(reached.size(), 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const ShownLight* const from = shown(*geometryOf(i));
            if (from && !from->factors.empty())
                differs[i] = bringUpToDate(copies_.at(geometryOf(i)), light, *from, i);
        }
    });
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (!differs[i]) continue;
        Copy& copy = copies_.at(geometryOf(i));
        copy.touched[reached[i].block] = 1;
        copy.preview.push_back(reached[i].block);
    }
}

/// Copies that are there already show so much more than their vertices as they do without previewed
/// lights.
void RayPreview::bringCopiesUpToDate(Copy& copy, const ShownLight& from) {
    const std::size_t first = from.direct.size() - from.copies.size();
    for (std::size_t c = 0; c < from.copies.size(); ++c) {
        const std::uint32_t v = from.copies[c];
        const Rgb over = from.direct[first + c] - from.direct[v];
        copy.light.direct[first + c] = atLeastNone(copy.light.direct[v] + over);
    }
    if (!from.copies.empty())
        std::fill(copy.touched.begin() + std::ptrdiff_t(first / kBlock), copy.touched.end(), 1);
}

/// Corners that something touches now get vertices of their own for as long as the geometry has
/// none for them.
void RayPreview::drawTouched(Copy& copy, std::span<const PreviewRows::Touched> touched,
                             const PreviewLighting& light, const ShownLight& from) {
    std::vector<std::uint32_t> copies = from.copies;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> redrawn = from.redrawn;
    copy.light.direct.resize(copy.vertices);
    copy.light.indirect.resize(copy.vertices);
    for (const PreviewRows::Touched& corner : touched) {
        const PreviewSurface& surface = rows_.surface(corner.object);
        std::size_t drawn = corner.vertex; // without previewed lights
        for (const std::uint32_t entry : surface.entriesOf(corner.corner)) {
            drawn = drawnAt(from, entry, drawn);
            redrawn.emplace_back(entry, std::uint32_t(copies.size()));
        }
        copies.push_back(corner.vertex);
        Rgb direct = from.direct[drawn];
        for (std::size_t l = 0; l < light.lights.size(); ++l)
            direct =
                direct + light.lights[l].exitance *
                             change(light, from, thenOf(light, corner.reached, l), l, corner.vertex,
                                    corner.factors[l], [&] { return corner.unoccluded[l]; });
        copy.light.direct.push_back(atLeastNone(direct));
        copy.light.indirect.push_back(from.indirect[drawn]);
    }
    const std::size_t blocks = (copy.light.direct.size() + kBlock - 1) / kBlock;
    copy.light.blockRevisions.resize(blocks);
    copy.touched.resize(blocks, 1);
    if (!copies.empty())
        std::fill(copy.touched.begin() + std::ptrdiff_t(copy.vertices / kBlock), copy.touched.end(),
                  1);
    if (copies == copy.light.copies && redrawn == copy.light.redrawn) return;
    copy.light.copies = std::move(copies);
    copy.light.redrawn = std::move(redrawn);
    copy.light.redrawnRevision = copy.light.revision = ++revision_;
}

void RayPreview::drawAllTouched(const PreviewLighting& light, const ShownOf& shown) {
    for (auto& [geometry, copy] : copies_) {
        const ShownLight* const from = shown(*geometry);
        if (!from || from->factors.empty()) continue;
        bringCopiesUpToDate(copy, *from);
        const auto [first, last] = std::equal_range(
            rows_.touched().begin(), rows_.touched().end(), PreviewRows::Touched{copy.object},
            [](const auto& a, const auto& b) { return a.object < b.object; });
        drawTouched(copy, {first, last}, light, *from);
    }
}

void RayPreview::rest(const PreviewLighting& expected, const ShownOf& shown, const View* view) {
    copies_.clear();
    if (expected.lights.empty())
        rows_.forget();
    else if (!rows_.knows(expected))
        rows_.prepare(expected, shown, view);
}

void RayPreview::update(const PreviewLighting& light, const ShownOf& shown, const View* view) {
    rows_.prepare(light, shown, view);
    for (const PreviewRows::Reached& at : rows_.reached()) {
        const LitGeometry& geometry = *light.objects[at.object].geometry;
        if (shown(geometry)) copies_[&geometry].object = at.object;
    }
    for (auto& [geometry, copy] : copies_)
        if (const ShownLight* from = shown(*geometry)) follow(copy, *from);
    bringAllUpToDate(light, shown);
    drawAllTouched(light, shown);
    for (auto& [geometry, copy] : copies_)
        for (std::size_t block = 0; block < copy.touched.size(); ++block)
            if (copy.touched[block])
                copy.light.blockRevisions[block] = copy.light.revision = ++revision_;
}

const ShownLight* RayPreview::shown(const LitGeometry& geometry) const {
    const auto found = copies_.find(&geometry);
    return found == copies_.end() ? nullptr : &found->second.light;
}

} // namespace penumbra
