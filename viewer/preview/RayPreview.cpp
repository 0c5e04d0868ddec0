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
/// \param corners with their entries in ascending order, as CornerFade has them
std::size_t drawnAt(const SplitCorners& corners, std::size_t vertices, std::uint32_t entry,
                    std::size_t vertex) {
    const auto at = std::lower_bound(corners.entries.begin(), corners.entries.end(), entry,
                                     [](const auto& r, std::uint32_t e) { return r.first < e; });
    if (at == corners.entries.end() || at->first != entry) return vertex;
    return vertices + at->second;
}

} // namespace

void RayPreview::Block::keep() {
    const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, light->vertices());
    std::copy(light->direct.begin() + std::ptrdiff_t(begin),
              light->direct.begin() + std::ptrdiff_t(end), before.begin());
}

void RayPreview::Block::restore() const {
    const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, light->vertices());
    std::copy(before.begin(), before.begin() + std::ptrdiff_t(end - begin),
              light->direct.begin() + std::ptrdiff_t(begin));
    light->touch(block);
}

void RayPreview::takeBack() {
    for (Surface& surface : surfaces_) {
        ShownLight& light = *surface.light;
        if (light.corners.empty()) continue;
        const std::size_t vertices = light.vertices();
        light.direct.resize(vertices);
        light.direct.insert(light.direct.end(), surface.copies.begin(), surface.copies.end());
        light.indirect.resize(light.direct.size());
        light.factors.resize(light.direct.size());
        light.behind.resize(light.direct.size());
        light.corners = std::move(surface.corners);
        light.touchCopies();
    }
    for (const Block& block : blocks_)
        if (block.light) block.restore();
    surfaces_.clear();
    blocks_.clear();
}

/// Factors of a light at a block, in the scene states of the anchors.
RayPreview::Then RayPreview::thenOf(const PreviewLighting& light, std::size_t at,
                                    std::size_t source) const {
    Then then{};
    for (std::size_t a = 0; a < light.anchors.size(); ++a)
        then[a] = &rows_.known(a + 1, at, source);
    return then;
}

/// The formula of PreviewLighting for one light, over its exitance. There is no less light than
/// none, and no more than without obstacles. Where rows of an anchor are missing, its light is what
/// the vertex carries.
/// \param unoccluded asked for what the light gives then, if that matters
template <class Unoccluded>
float RayPreview::change(const PreviewLighting& light, const ShownLight& shown, const Then& then,
                         std::size_t source, std::size_t vertex, float now,
                         const Unoccluded& unoccluded) {
    float change = 0;
    bool complete = true;
    for (std::size_t a = 0; a < light.anchors.size(); ++a) {
        const PreviewLighting::Anchor& anchor = light.anchors[a];
        const float share = glm::mix(anchor.rest, anchor.behind, shown.behind[vertex]);
        if (share == 0) continue;
        complete &= then[a]->of(vertex);
        change += share * (now - then[a]->factors[vertex % kBlock]);
    }
    const float known = shown.factors[vertex][source];
    if (!complete && known < 0) return 0;
    if (!complete) change = now - known;
    if (known < 0) return change;
    if (change > 0) change = std::min(change, std::max(0.0f, unoccluded() - known));
    return std::max(change, -known);
}

/// Lists what is reached and shown with factors of the lights.
void RayPreview::listReached(const PreviewLighting& light, const ShownOf& shown) {
    const std::span<const PreviewRows::Reached> reached = rows_.reached();
    blocks_.resize(reached.size());
    for (std::size_t i = 0; i < reached.size(); ++i) { // those of an object lie together
        const std::uint32_t object = reached[i].object;
        if (surfaces_.empty() || surfaces_.back().object != object) {
            ShownLight* const of = shown(*light.objects[object].geometry);
            if (!of || of->factors.empty()) continue;
            const auto copies = of->direct.begin() + std::ptrdiff_t(of->vertices());
            surfaces_.push_back({of, object, of->corners, {copies, of->direct.end()}});
        }
        blocks_[i].light = surfaces_.back().light;
        blocks_[i].block = reached[i].block;
    }
}

/// \return whether anything of the block has changed
bool RayPreview::bringUpToDate(const PreviewLighting& light, std::size_t reached) {
    const PreviewRows::Reached& at = rows_.reached()[reached];
    ShownLight& shown = *blocks_[reached].light;
    const std::size_t begin = at.block * kBlock, end = std::min(begin + kBlock, shown.vertices());
    blocks_[reached].keep();
    bool any = false;
    for (std::size_t l = 0; l < light.lights.size(); ++l) {
        if (!(at.lights >> l & 1)) continue;
        const PreviewRows::Known& now = rows_.known(0, reached, l);
        const Then then = thenOf(light, reached, l);
        for (std::size_t v = begin; v < end; ++v) {
            if (!(at.vertices >> (v - begin) & 1) || !now.of(v)) continue;
            const float by = change(light, shown, then, l, v, now.factors[v - begin],
                                    [&] { return rows_.unoccluded(at, l, v); });
            if (by == 0) continue;
            shown.direct[v] = shown.direct[v] + light.lights[l].exitance * by;
            any = true;
        }
    }
    if (any)
        for (std::size_t v = begin; v < end; ++v) shown.direct[v] = atLeastNone(shown.direct[v]);
    return any;
}

/// Each block is listed once, so that they can be worked on side by side.
void RayPreview::bringAllUpToDate(const PreviewLighting& light) {
    parallelFor(blocks_.size(), 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (blocks_[i].light && !bringUpToDate(light, i)) blocks_[i].light = nullptr;
    });
    for (const Block& block : blocks_)
        if (block.light) block.light->touch(block.block);
}

/// Copies that there were already show so much more than their vertices as they did before.
/// \param over how much that is
void RayPreview::bringCopiesUpToDate(const Surface& surface, const std::vector<Rgb>& over) {
    ShownLight& shown = *surface.light;
    const std::size_t first = shown.vertices();
    for (std::size_t c = 0; c < over.size(); ++c)
        shown.direct[first + c] = atLeastNone(shown.direct[surface.corners.copies[c]] + over[c]);
    if (!over.empty()) shown.touchCopies();
}

/// The light of what is drawn at a corner, without previewed lights.
Rgb RayPreview::before(const Surface& surface, const PreviewRows::Touched& corner,
                       std::size_t drawn) const {
    const std::size_t vertices = surface.light->vertices();
    if (drawn >= vertices) return surface.copies[drawn - vertices];
    const Block& block = blocks_[corner.reached];
    return block.light ? block.before[drawn % kBlock] : surface.light->direct[drawn];
}

/// Corners that something touches now get vertices of their own for as long as the geometry has
/// none for them.
void RayPreview::splitTouched(const Surface& surface, std::span<const PreviewRows::Touched> touched,
                              const PreviewLighting& light) {
    if (touched.empty()) return;
    ShownLight& shown = *surface.light;
    const std::size_t vertices = shown.vertices();
    for (const PreviewRows::Touched& corner : touched) {
        std::size_t drawn = corner.vertex;
        for (const std::uint32_t entry : rows_.surface(corner.object).entriesOf(corner.corner)) {
            drawn = drawnAt(surface.corners, vertices, entry, drawn);
            shown.corners.entries.emplace_back(entry, std::uint32_t(shown.corners.copies.size()));
        }
        Rgb direct = before(surface, corner, drawn);
        for (std::size_t l = 0; l < light.lights.size(); ++l)
            direct = direct + light.lights[l].exitance *
                                  change(light, shown, thenOf(light, corner.reached, l), l,
                                         corner.vertex, corner.factors[l],
                                         [&] { return corner.unoccluded[l]; });
        const Rgb indirect = shown.indirect[drawn];
        shown.corners.copies.push_back(corner.vertex);
        shown.direct.push_back(atLeastNone(direct));
        shown.indirect.push_back(indirect);
        shown.factors.emplace_back();
        shown.behind.push_back(0);
    }
    shown.touchCopies();
}

void RayPreview::splitAllTouched(const PreviewLighting& light) {
    for (const Surface& surface : surfaces_) {
        const auto [first, last] = std::equal_range(
            rows_.touched().begin(), rows_.touched().end(), PreviewRows::Touched{surface.object},
            [](const auto& a, const auto& b) { return a.object < b.object; });
        splitTouched(surface, {first, last}, light);
    }
}

void RayPreview::rest(const PreviewLighting& expected, const ShownOf& shown, const View* view) {
    takeBack();
    if (expected.now) rows_.require(expected);
    if (expected.lights.empty())
        rows_.forget();
    else if (!rows_.knows(expected))
        rows_.prepare(expected, shown, view, seconds_);
}

void RayPreview::update(const PreviewLighting& light, const ShownOf& shown, const View* view) {
    takeBack();
    rows_.prepare(light, shown, view, seconds_);
    listReached(light, shown);
    std::vector<std::vector<Rgb>> over; // of copies over their vertices
    for (const Surface& surface : surfaces_) {
        std::vector<Rgb>& of = over.emplace_back(surface.copies);
        for (std::size_t c = 0; c < of.size(); ++c)
            of[c] = of[c] - surface.light->direct[surface.corners.copies[c]];
    }
    bringAllUpToDate(light);
    for (std::size_t s = 0; s < surfaces_.size(); ++s) bringCopiesUpToDate(surfaces_[s], over[s]);
    splitAllTouched(light);
}

} // namespace penumbra
