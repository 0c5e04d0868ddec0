#include "viewer/preview/LightBlend.h"

#include "base/Parallel.h"
#include "radiosity/process/RadiosityNode.h"
#include "viewer/preview/SceneStates.h"
#include "viewer/preview/Smoothstep.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace penumbra {

void LightBlend::want(std::vector<std::string> lights) {
    assert(lights.size() <= kMostPreviewed);
    wanted_ = std::move(lights);
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
                if (!lights_.empty()) entry.fade->setLights(lights_.size());
            }
            byGeometry_[object.geometry.get()] = entry.fade.get();
        }
        entries_.push_back(std::move(entry));
    }
    return true;
}

/// The scene state now; the same pointer for as long as it does not change.
void LightBlend::observe(const RadiosityNode& node) {
    SceneState now = sceneStateOf(node, lights_);
    for (const SceneStatePtr& known : {now_, next_, rest_, behind_})
        if (known && sameSceneState(*known, now)) {
            now_ = known;
            return;
        }
    now_ = std::make_shared<const SceneState>(std::move(now));
}

void LightBlend::restAnew() {
    rest_ = sent_ = now_;
    next_ = behind_ = nullptr;
}

/// Nothing moves, nothing is on its way.
bool LightBlend::quiet() const {
    return rest_ == now_ && !next_ && !behind_;
}

void LightBlend::followLights(RadiosityNode& node) {
    if (wanted_ == lights_ || !quiet()) return;
    lights_ = wanted_;
    node.setPreviewLights(lights_);
    for (Entry& entry : entries_)
        if (entry.fade) entry.fade->setLights(lights_.size());
    now_ = nullptr;
    rest_ = nullptr;
    observe(node);
    restAnew();
}

LightFade::Frame LightBlend::frameAt(double time, bool fresh) const {
    return {time,
            options_.seconds,
            lights_.size(),
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
/// sender after another, and what they change is sent on last. So it is taken when it is certified;
/// if that is not soon, now and then.
bool LightBlend::indirectFadeStarts(const RadiosityState& state, double time) {
    constexpr double kLongest = 2; // [s]
    const bool certified = state.reached(SolutionState::certified) && state.queued == 0;
    if (!lights_.empty() && !certified && time - indirectSince_ < kLongest) return false;
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

void LightBlend::describePreview(const RadiosityNode& node, double time) {
    preview_ = {};
    preview_.points = options_.points;
    preview_.now = now_;
    preview_.awaited = sent_;
    const float share = restShare(time);
    const auto anchor = [&](const SceneStatePtr& of, float rest, float behind) {
        if (of && of != now_ && (rest > 0 || behind > 0))
            preview_.anchors.push_back({of, rest, behind});
    };
    if (lights_.empty()) return;
    anchor(rest_, 1 - share, behind_ == rest_ ? 1.0f : 0.0f);
    anchor(next_, share, 0);
    if (behind_ != rest_) anchor(behind_, 0, 1);
    if (preview_.anchors.empty()) return;
    for (std::size_t o = 0; o < entries_.size(); ++o) {
        const bool moves = std::any_of(preview_.anchors.begin(), preview_.anchors.end(),
                                       [&](const PreviewLighting::Anchor& a) {
                                           return !(a.sceneState->objects[o] == now_->objects[o]);
                                       });
        preview_.objects.push_back({entries_[o].geometry, moves});
    }
    describeLights(node, preview_);
}

/// \param light with its anchors
void LightBlend::describeLights(const RadiosityNode& node, PreviewLighting& light) const {
    const PlacedScene& placed = node.placed();
    for (const std::string& path : lights_) {
        PreviewLighting::PreviewLight source{exitanceOf(placed, path)};
        const std::size_t l = light.lights.size();
        source.moves = std::any_of(light.anchors.begin(), light.anchors.end(),
                                   [&](const PreviewLighting::Anchor& a) {
                                       return !sameLight(a.sceneState->lights[l], now_->lights[l]);
                                   });
        light.lights.push_back(source);
    }
}

PreviewLighting LightBlend::expecting(const RadiosityNode& node, const std::string& object) const {
    PreviewLighting light;
    light.now = now_;
    for (const Entry& entry : entries_)
        light.objects.push_back({entry.geometry, entry.path == object});
    describeLights(node, light);
    const PlacedScene& placed = node.placed();
    const auto moveWith = [&](const auto& lights) {
        for (const auto& source : lights)
            for (std::size_t l = 0; l < lights_.size(); ++l)
                if (source.path == lights_[l] && placed.objects[source.object.value].path == object)
                    light.lights[l].moves = true;
    };
    moveWith(placed.lights);
    moveWith(placed.meshes);
    return light;
}

void LightBlend::advance(RadiosityNode& node, double time) {
    const bool others = followObjects(node);
    if (others) now_ = rest_ = next_ = behind_ = nullptr;
    observe(node);
    if (others || lights_.empty()) restAnew();
    followLights(node);
    if (next_ && time - since_ >= options_.seconds) rest_ = std::exchange(next_, nullptr);
    const RadiosityState& state = node.state();
    if (state.held == 0) sent_ = now_;
    if (state.dirtyMarked && sent_ != (next_ ? next_ : rest_)) comeToRest(time);
    const bool fresh = lights_.empty() || (state.dirtyMarked && sent_ == (next_ ? next_ : rest_));
    LightFade::Frame frame = frameAt(time, fresh);
    frame.indirect = indirectFadeStarts(state, time);
    advanceFades(frame);
    changing_ |= next_ != nullptr;
    waiting_ |= !fresh;
    describePreview(node, time);
}

const ShownLight* LightBlend::shown(const LitGeometry& geometry) const {
    const auto found = byGeometry_.find(&geometry);
    return found == byGeometry_.end() ? nullptr : &found->second->shown();
}

ShownLight* LightBlend::shown(const LitGeometry& geometry) {
    const auto found = byGeometry_.find(&geometry);
    return found == byGeometry_.end() ? nullptr : &found->second->shown();
}

} // namespace penumbra
