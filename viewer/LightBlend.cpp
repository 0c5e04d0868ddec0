#include "viewer/LightBlend.h"

#include "radiosity/Parallel.h"
#include "radiosity/RadiosityNode.h"
#include "viewer/Arrangements.h"
#include "viewer/Smoothstep.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace penumbra {

void LightBlend::want(std::vector<std::string> lamps) {
    assert(lamps.size() <= kMostLampsDrawnLive);
    wanted_ = std::move(lamps);
}

/// \return whether there are other geometries than before
bool LightBlend::followObjects(const RadiosityNode& node) {
    const auto objects = node.objects();
    const auto same = [](const Entry& entry, const LitObject& object) {
        return entry.geometry == object.geometry && entry.path == object.path;
    };
    if (std::equal(entries_.begin(), entries_.end(), objects.begin(), objects.end(), same))
        return false;
    std::unordered_map<std::string, Entry> before;
    for (Entry& entry : entries_) before.emplace(entry.path, std::move(entry));
    entries_.clear();
    byGeometry_.clear();
    for (const LitObject& object : objects) {
        Entry entry{object.path, object.geometry, nullptr};
        if (object.geometry) {
            const auto old = before.find(object.path);
            if (old != before.end() && old->second.geometry == object.geometry) {
                entry.fade = std::move(old->second.fade);
            } else {
                entry.fade = std::make_unique<LightFade>(*object.geometry);
                if (old != before.end() && old->second.fade)
                    entry.fade->takeOver(*old->second.fade);
                if (!lamps_.empty()) entry.fade->setLamps(lamps_.size());
            }
            byGeometry_[object.geometry.get()] = entry.fade.get();
        }
        entries_.push_back(std::move(entry));
    }
    return true;
}

/// How things stand now; the same pointer as long as they do.
void LightBlend::lookAround(const RadiosityNode& node) {
    Arrangement now = arrangementOf(node, lamps_);
    for (const ArrangementPtr& known : {now_, next_, rest_, behind_})
        if (known && sameArrangement(*known, now)) {
            now_ = known;
            return;
        }
    now_ = std::make_shared<const Arrangement>(std::move(now));
}

void LightBlend::restAnew() {
    rest_ = sent_ = now_;
    next_ = behind_ = nullptr;
}

/// Nothing moves, nothing is on its way.
bool LightBlend::quiet() const {
    return rest_ == now_ && !next_ && !behind_;
}

void LightBlend::followLamps(RadiosityNode& node) {
    if (wanted_ == lamps_ || !quiet()) return;
    lamps_ = wanted_;
    node.setLiveLamps(lamps_);
    for (Entry& entry : entries_)
        if (entry.fade) entry.fade->setLamps(lamps_.size());
    now_ = nullptr;
    rest_ = nullptr;
    lookAround(node);
    restAnew();
}

LightFade::Frame LightBlend::frameAt(double time, bool fresh) const {
    return {time,
            options_.seconds,
            lamps_.size(),
            fresh,
            next_ ? 1 - restShare(time) : 0,
            !next_ || !behind_ || behind_ == rest_};
}

/// What was sent is exact, at least in part: it comes to rest.
void LightBlend::comeToRest(double time) {
    if (next_) return; // one after the other
    const LightFade::Frame frame = frameAt(time, true);
    const auto unready = [&](const Entry& entry) {
        return entry.fade && entry.fade->anyUnready(*entry.geometry, frame);
    };
    if (behind_ && std::any_of(entries_.begin(), entries_.end(), unready)) return;
    for (Entry& entry : entries_)
        if (entry.fade) entry.fade->leaveBehind(*entry.geometry, frame);
    if (!behind_) behind_ = rest_;
    next_ = sent_;
    since_ = time;
}

/// While light is solved after an edit, indirect light goes up and down: rows are followed one
/// sender after another, and what they change is sent on last. So it is taken when it has settled;
/// if that is not soon, now and then.
bool LightBlend::indirectSetsOut(const RadiosityState& state, double time) {
    constexpr double kLongest = 2; // [s]
    const bool settled = state.phase == RadiosityState::Phase::settled && state.queued == 0;
    if (!lamps_.empty() && !settled && time - indirectSince_ < kLongest) return false;
    indirectSince_ = time;
    return true;
}

void LightBlend::advanceFades(const LightFade::Frame& frame) {
    parallelFor(entries_.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t e = first; e < last; ++e)
            if (entries_[e].fade) entries_[e].fade->advance(*entries_[e].geometry, frame);
    });
    changing_ = fading_ = waiting_ = false;
    bool behind = false;
    for (const Entry& entry : entries_) {
        if (!entry.fade) continue;
        changing_ |= entry.fade->changing();
        fading_ |= entry.fade->fading();
        waiting_ |= entry.fade->waiting();
        behind |= entry.fade->anyBehind();
    }
    if (!behind && !next_) behind_ = nullptr;
}

/// Of next_ in the vertices that are not behind.
float LightBlend::restShare(double time) const {
    return next_ ? smoothstep(time, since_, options_.seconds) : 0;
}

void LightBlend::describeLive(const RadiosityNode& node, double time) {
    live_ = {};
    live_.points = options_.points;
    live_.now = now_;
    const float share = restShare(time);
    const auto anchor = [&](const ArrangementPtr& of, float rest, float behind) {
        if (of && of != now_ && (rest > 0 || behind > 0))
            live_.anchors.push_back({of, rest, behind});
    };
    if (lamps_.empty()) return;
    anchor(rest_, 1 - share, behind_ == rest_ ? 1.0f : 0.0f);
    anchor(next_, share, 0);
    if (behind_ != rest_) anchor(behind_, 0, 1);
    if (live_.anchors.empty()) return;
    for (std::size_t o = 0; o < entries_.size(); ++o) {
        const bool moves = std::any_of(live_.anchors.begin(), live_.anchors.end(),
                                       [&](const LiveLight::Anchor& a) {
                                           return !(a.arrangement->objects[o] == now_->objects[o]);
                                       });
        live_.objects.push_back({entries_[o].geometry, moves});
    }
    describeLamps(node, live_);
}

/// \param light with its anchors
void LightBlend::describeLamps(const RadiosityNode& node, LiveLight& light) const {
    const PlacedScene& placed = node.placed();
    for (const std::string& path : lamps_) {
        LiveLight::Lamp lamp{exitanceOf(placed, path)};
        const std::size_t l = light.lamps.size();
        lamp.moves = std::any_of(light.anchors.begin(), light.anchors.end(),
                                 [&](const LiveLight::Anchor& a) {
                                     return !sameLamp(a.arrangement->lamps[l], now_->lamps[l]);
                                 });
        light.lamps.push_back(lamp);
    }
}

LiveLight LightBlend::expecting(const RadiosityNode& node, const std::string& object) const {
    LiveLight light;
    if (lamps_.empty()) return light;
    light.now = now_;
    for (const Entry& entry : entries_)
        light.objects.push_back({entry.geometry, entry.path == object});
    describeLamps(node, light);
    const PlacedScene& placed = node.placed();
    const auto moveWith = [&](const auto& lamps) {
        for (const auto& lamp : lamps)
            for (std::size_t l = 0; l < lamps_.size(); ++l)
                if (lamp.path == lamps_[l] && placed.objects[lamp.object.value].path == object)
                    light.lamps[l].moves = true;
    };
    moveWith(placed.lights);
    moveWith(placed.meshes);
    return light;
}

void LightBlend::advance(RadiosityNode& node, double time) {
    const bool others = followObjects(node);
    if (others) now_ = rest_ = next_ = behind_ = nullptr;
    lookAround(node);
    if (others || lamps_.empty()) restAnew();
    followLamps(node);
    if (next_ && time - since_ >= options_.seconds) rest_ = std::exchange(next_, nullptr);
    const RadiosityState& state = node.state();
    if (state.held == 0) sent_ = now_;
    if (state.lampsMarked && sent_ != (next_ ? next_ : rest_)) comeToRest(time);
    const bool fresh = lamps_.empty() || (state.lampsMarked && sent_ == (next_ ? next_ : rest_));
    LightFade::Frame frame = frameAt(time, fresh);
    frame.indirect = indirectSetsOut(state, time);
    advanceFades(frame);
    changing_ |= next_ != nullptr;
    waiting_ |= !fresh;
    describeLive(node, time);
}

const ShownLight* LightBlend::shown(const LitGeometry& geometry) const {
    const auto found = byGeometry_.find(&geometry);
    return found == byGeometry_.end() ? nullptr : &found->second->shown();
}

} // namespace penumbra
