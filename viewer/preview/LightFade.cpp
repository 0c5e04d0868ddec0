#include "viewer/preview/LightFade.h"

#include "viewer/preview/Smoothstep.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace penumbra {

namespace {

Rgb mix(Rgb a, Rgb b, float w) {
    return a + (b - a) * w;
}

LightFactors mix(LightFactors a, const LightFactors& b, float w) {
    for (std::size_t l = 0; l < kMostPreviewed; ++l) a[l] += (b[l] - a[l]) * w;
    return a;
}

/// Whether two values differ by so little that a fade on its way to one may end at the other.
bool alike(Rgb a, Rgb b) {
    const float most = 2e-3f * std::max(maxChannel(a), maxChannel(b));
    return std::abs(a.r - b.r) <= most && std::abs(a.g - b.g) <= most &&
           std::abs(a.b - b.b) <= most;
}

/// Whether nobody sees the jump from one value to another, even on all of the screen: a quarter of
/// the step that is just seen there.
bool unseen(Rgb a, Rgb b) {
    return maxChannel(absolute(a - b)) <= 1e-3f * std::min(maxChannel(a), maxChannel(b));
}

} // namespace

LightFade::LightFade(const PublishedGeometry& geometry) {
    followTopology(geometry);
    seen_ = geometry.blockRevisions();
    revision_ = geometry.revision();
}

/// Vertices may have been added, and triangles may have other ones.
void LightFade::followTopology(const PublishedGeometry& geometry) {
    if (topology_ == geometry.topologyRevision()) return;
    topology_ = geometry.topologyRevision();
    const LitMeshData& data = geometry.data();
    const std::size_t before = vertices_, now = data.positions.size();
    vertices_ = now;
    shown_.direct.resize(now);
    shown_.indirect.resize(now);
    if (!shown_.factors.empty()) {
        shown_.factors.resize(now);
        shown_.behind.resize(now, 0);
    }
    for (std::size_t v = before; v < now; ++v) {
        shown_.direct[v] = data.direct[v];
        shown_.indirect[v] = data.indirect[v];
    }
    shown_.blockRevisions.resize(geometry.blockRevisions().size(), 1);
    seen_.resize(geometry.blockRevisions().size(), 0);
    std::erase_if(flights_, [&](const auto& f) { return f.first >= seen_.size(); });
    ++shown_.revision;
    if (before > 0) adopt(geometry);
    corners_ = data.indices;
    findBorders(data);
}

/// Vertices that represent none of their earlier corners any more take over what was shown at one
/// of those that they represent now. All others show their own light, and corners that have
/// come to be drawn with them go to that.
void LightFade::adopt(const PublishedGeometry& geometry) {
    const LitMeshData& data = geometry.data();
    shown_.adopted.clear();
    if (corners_.size() != data.indices.size()) return cornerFade_.clear();
    std::vector<bool> settled(data.positions.size());
    std::vector<std::pair<std::uint32_t, Light>> changed; // entries, and what was shown there:
    for (std::uint32_t i = 0; i < corners_.size(); ++i) { // a vertex may give and take
        if (data.indices[i] == corners_[i])
            settled[corners_[i]] = true;
        else
            changed.emplace_back(i, shownAt(i));
    }
    for (const auto& [entry, light] : changed) {
        const std::uint32_t v = data.indices[entry];
        if (settled[v]) continue;
        settled[v] = true;
        shown_.adopted.push_back({v, corners_[entry]});
        beginWith(v, light);
    }
    for (const auto& [entry, light] : changed)
        cornerFade_.put(entry, data.indices[entry], beyond(geometry, data.indices[entry], light));
}

LightFade::Light LightFade::shownAt(std::uint32_t entry) const {
    const std::uint32_t v = corners_[entry];
    const CornerFade::Over over = cornerFade_.over(entry);
    Light light{shown_.direct[v] + over.direct, shown_.indirect[v] + over.indirect};
    if (shown_.factors.empty()) return light;
    light.factors = shown_.factors[v];
    light.behind = shown_.behind[v];
    return light;
}

void LightFade::beginWith(std::uint32_t vertex, const Light& light) {
    shown_.direct[vertex] = light.direct;
    shown_.indirect[vertex] = light.indirect;
    if (!shown_.factors.empty()) {
        shown_.factors[vertex] = light.factors;
        setBehind(vertex, light.behind);
    }
    Flight& flight = flightOf(vertex / kBlock);
    flight.direct[vertex % kBlock] = {};
    flight.indirect[vertex % kBlock] = {};
    shown_.touch(vertex / kBlock);
}

/// How much more light that is than what a vertex shows, without that of previewed lights: it is
/// brought up to date, from whatever it is in both, to what it is now.
CornerFade::Over LightFade::beyond(const PublishedGeometry& geometry, std::uint32_t vertex,
                                   const Light& light) const {
    CornerFade::Over over{light.direct - shown_.direct[vertex],
                          light.indirect - shown_.indirect[vertex]};
    if (shown_.factors.empty()) return over;
    const LightShares& shares = geometry.shares();
    for (std::size_t l = 0; l < shares.size() && l < kMostPreviewed; ++l) {
        const float was = light.factors[l], is = shown_.factors[vertex][l];
        if (was >= 0 && is >= 0) over.direct -= shares[l].exitance[vertex / kBlock] * (was - is);
    }
    return over;
}

void LightFade::findBorders(const LitMeshData& data) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs; // vertex, other block
    for (std::size_t t = 0; t < data.indices.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const std::uint32_t v = data.indices[t + i];
                const std::uint32_t block = data.indices[t + j] / kBlock;
                if (block != v / kBlock) pairs.emplace_back(v, block);
            }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    borderFirst_.assign(data.positions.size() + 1, 0);
    borders_.clear();
    for (const auto& [vertex, block] : pairs) {
        ++borderFirst_[vertex + 1];
        borders_.push_back(block);
    }
    for (std::size_t v = 0; v < data.positions.size(); ++v) borderFirst_[v + 1] += borderFirst_[v];
}

void LightFade::setLights(std::size_t lights) {
    assert(behind_ == 0);
    const std::size_t vertices = lights > 0 ? shown_.direct.size() : 0;
    shown_.factors.assign(vertices, LightFactors());
    shown_.behind.assign(vertices, 0);
    for (auto& [block, flight] : flights_)
        for (auto& way : flight.direct) way.from.factors = way.target.factors = LightFactors();
    for (std::size_t b = 0; b < shown_.blockRevisions.size(); ++b) shown_.touch(b);
    std::fill(seen_.begin(), seen_.end(), 0); // all are checked again
    revision_ = 0;
}

void LightFade::takeOver(const LightFade& before) {
    if (before.vertices_ != vertices_) return;
    for (std::size_t v = 0; v < vertices_; ++v) {
        shown_.direct[v] = before.shown_.direct[v];
        shown_.indirect[v] = before.shown_.indirect[v];
    }
    std::fill(seen_.begin(), seen_.end(), 0);
    revision_ = 0;
}

bool LightFade::blockReady(const PublishedGeometry& geometry, std::size_t block,
                           const Frame& frame) const {
    if (frame.lights == 0) return true;
    const LightShares& shares = geometry.shares();
    if (shares.size() != frame.lights) return false;
    return std::all_of(shares.begin(), shares.end(), [&](const LightShare& share) {
        return share.known[block] == LightShare::Known::exact;
    });
}

bool LightFade::ready(const PublishedGeometry& geometry, std::size_t vertex,
                      const Frame& frame) const {
    if (!frame.fresh || !blockReady(geometry, vertex / kBlock, frame)) return false;
    for (std::uint32_t i = borderFirst_[vertex]; i < borderFirst_[vertex + 1]; ++i)
        if (!blockReady(geometry, borders_[i], frame)) return false;
    return true;
}

LightFade::Direct LightFade::target(const PublishedGeometry& geometry, std::size_t vertex) const {
    Direct direct{geometry.data().direct[vertex]};
    if (shown_.factors.empty()) return direct;
    const LightShares& shares = geometry.shares();
    for (std::size_t l = 0; l < shares.size() && l < kMostPreviewed; ++l)
        if (shares[l].known[vertex / kBlock] != LightShare::Known::no)
            direct.factors[l] = shares[l].factor[vertex];
    return direct;
}

/// The share o of the old scene state in a vertex is `behind` b of it and, with the state that all
/// others leave, o = b + (1 - b) rest.
LightFade::Direct LightFade::shownDirect(std::size_t vertex, const Frame& frame) const {
    if (shown_.factors.empty()) return {shown_.direct[vertex]};
    const float behind = shown_.behind[vertex];
    const float old = frame.behindIsRest ? behind + (1 - behind) * frame.rest : behind;
    return {shown_.direct[vertex], shown_.factors[vertex], old};
}

void LightFade::setShown(std::size_t vertex, const Direct& direct, const Frame& frame) {
    directChanged_ = true;
    shown_.direct[vertex] = direct.light;
    if (shown_.factors.empty()) return;
    shown_.factors[vertex] = direct.factors;
    const bool fades = frame.behindIsRest && frame.rest > 0 && frame.rest < 1;
    const float ahead = direct.old - frame.rest; // up to rounding, of those that fade with it: 0
    setBehind(vertex, !fades ? direct.old : ahead > 1e-5f ? ahead / (1 - frame.rest) : 0);
}

void LightFade::setBehind(std::size_t vertex, float behind) {
    behind_ += std::size_t(behind > 0) - std::size_t(shown_.behind[vertex] > 0);
    shown_.behind[vertex] = behind;
}

LightFade::Flight& LightFade::flightOf(std::size_t block) {
    Flight& flight = flights_[block];
    const std::size_t size = std::min(kBlock, vertices_ - block * kBlock);
    flight.direct.resize(size);
    flight.indirect.resize(size);
    return flight;
}

/// Goes on along a way to the frame's time.
void LightFade::goOn(std::size_t vertex, Way<Direct>& way, const Frame& frame) {
    if (way.start == kNever) return;
    const float w = smoothstep(frame.time, way.start, frame.seconds);
    const Direct &a = way.from, &b = way.target;
    if (w >= 1) {
        setShown(vertex, b, frame);
        way.start = kNever;
        return;
    }
    fading_ = true;
    setShown(vertex,
             {mix(a.light, b.light, w), mix(a.factors, b.factors, w), a.old + (b.old - a.old) * w},
             frame);
}

bool LightFade::advanceDirect(const PublishedGeometry& geometry, std::size_t vertex,
                              Way<Direct>& way, const Frame& frame) {
    goOn(vertex, way, frame);
    const bool behind = !shown_.factors.empty() && shown_.behind[vertex] > 0;
    const bool early = behind && !frame.behindIsRest && frame.rest > 0;
    if (early || !ready(geometry, vertex, frame)) {
        waiting_ = true;
        return false;
    }
    const Direct wanted = target(geometry, vertex);
    const Direct now = shownDirect(vertex, frame);
    if (!behind && way.start == kNever && wanted.light == now.light &&
        wanted.factors == now.factors)
        return true;
    if (wanted == (way.start != kNever ? way.target : now)) return way.start == kNever;
    if (wanted.light == now.light && wanted.old == now.old) {
        setShown(vertex, wanted, frame); // lights have become known: nothing is seen of that
        way.start = kNever;
        return true;
    }
    way = {now, wanted, frame.time};
    // What was not known is taken to be as it is now.
    for (std::size_t l = 0; l < kMostPreviewed; ++l)
        if (way.from.factors[l] < 0) way.from.factors[l] = wanted.factors[l];
    goOn(vertex, way, frame);
    return way.start == kNever;
}

bool LightFade::advanceIndirect(const LitMeshData& data, std::size_t vertex, Way<Rgb>& way,
                                const Frame& frame) {
    Rgb& now = shown_.indirect[vertex];
    const Rgb wanted = data.indirect[vertex];
    const auto step = [&] {
        const float w = smoothstep(frame.time, way.start, frame.seconds);
        indirectChanged_ = true;
        now = w >= 1 ? way.target : mix(way.from, way.target, w);
        if (w >= 1) way.start = kNever;
    };
    if (way.start != kNever) {
        if (alike(wanted, way.target)) way.target = wanted; // too little to start anew
        step();
    }
    if (wanted == (way.start != kNever ? way.target : now)) return way.start == kNever;
    if (!frame.indirect) return false;
    if (way.start == kNever && unseen(now, wanted)) { // copied once, not in each frame of a fade
        now = wanted;
        indirectChanged_ = true;
        return true;
    }
    way = {now, wanted, frame.time};
    step();
    return way.start == kNever;
}

/// Nothing of the block has changed but its indirect light.
void LightFade::touchIndirect(std::size_t block) {
    if (shown_.indirectRuns.size() <= block) shown_.indirectRuns.resize(block + 1);
    ShownLight::IndirectRun& run = shown_.indirectRuns[block];
    const std::uint64_t before = shown_.blockRevisions[block];
    shown_.touch(block);
    if (run.to != before) run.from = before;
    run.to = shown_.blockRevisions[block];
}

/// \return whether all of the block has come to rest at what the geometry carries
bool LightFade::advanceBlock(const PublishedGeometry& geometry, std::size_t block, Flight& flight,
                             const Frame& frame) {
    directChanged_ = indirectChanged_ = false;
    bool done = true;
    for (std::size_t i = 0; i < flight.direct.size(); ++i) {
        done &= advanceDirect(geometry, block * kBlock + i, flight.direct[i], frame);
        done &= advanceIndirect(geometry.data(), block * kBlock + i, flight.indirect[i], frame);
    }
    if (directChanged_)
        shown_.touch(block);
    else if (indirectChanged_)
        touchIndirect(block);
    return done;
}

void LightFade::advanceCorners(const PublishedGeometry& geometry, const Frame& frame) {
    const auto fadeStart = [&](std::uint32_t vertex) -> std::optional<double> {
        if (!ready(geometry, vertex, frame)) return std::nullopt;
        const auto flight = flights_.find(vertex / kBlock);
        return flight != flights_.end() ? flight->second.direct[vertex % kBlock].start : kNever;
    };
    cornerFade_.advance(frame.time, frame.seconds, fadeStart);
    cornerFade_.show(shown_);
    fading_ |= !cornerFade_.empty();
}

void LightFade::advance(const PublishedGeometry& geometry, const Frame& frame) {
    CornerFade::hide(shown_);
    followTopology(geometry);
    if (revision_ != geometry.revision()) {
        revision_ = geometry.revision();
        const std::vector<std::uint64_t>& latest = geometry.blockRevisions();
        for (std::size_t block = 0; block < latest.size(); ++block) {
            if (seen_[block] == latest[block]) continue;
            seen_[block] = latest[block];
            flightOf(block);
        }
    }
    fading_ = waiting_ = false;
    for (auto flight = flights_.begin(); flight != flights_.end();)
        if (advanceBlock(geometry, flight->first, flight->second, frame))
            flight = flights_.erase(flight);
        else
            ++flight;
    advanceCorners(geometry, frame);
}

bool LightFade::anyUnready(const PublishedGeometry& geometry, const Frame& frame) const {
    for (std::size_t block = 0; block < seen_.size(); ++block)
        if (!blockReady(geometry, block, frame)) return true;
    return false;
}

bool LightFade::leaveBehind(const PublishedGeometry& geometry, const Frame& frame) {
    if (shown_.factors.empty() || !anyUnready(geometry, frame)) return false;
    for (std::size_t v = 0; v < vertices_; ++v) {
        if (ready(geometry, v, frame)) continue;
        Flight& flight = flightOf(v / kBlock);
        Way<Direct>& way = flight.direct[v % kBlock];
        way.from.old = way.target.old = 1;
        setBehind(v, 1);
        shown_.touch(v / kBlock);
    }
    return behind_ > 0;
}

} // namespace penumbra
