#include "viewer/preview/PreviewRows.h"

#include "base/Clock.h"
#include "base/Parallel.h"
#include "radiosity/rays/Shaft.h"
#include "scenegraph/Frustum.h"
#include "viewer/preview/SceneStates.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>
#include <utility>

namespace penumbra {

namespace {

bool before(const PreviewRows::Reached& a, const PreviewRows::Reached& b) {
    return std::tie(a.object, a.block) < std::tie(b.object, b.block);
}

} // namespace

void PreviewRows::require(const PreviewLighting& light) {
    using namespace std::chrono_literals;
    if (making_.valid()) { // one after the other
        if (making_.wait_for(0s) != std::future_status::ready) return;
        takeStage();
    }
    std::vector<std::shared_ptr<const LitGeometry>> geometries;
    for (const auto& object : light.objects) geometries.push_back(object.geometry);
    if (geometries == geometries_) {
        if (behind_ && light.anchors.empty()) catchUp(light.now);
        return;
    }
    forget();
    behind_ = false;
    geometries_ = std::move(geometries);
    surfaces_.clear();
    stage_.reset();
    std::optional<PatchSet> patches = patches_();
    if (!patches || patches->objects.size() != geometries_.size()) return;
    const auto make = [](PatchSet set, const SceneStatePtr& now) {
        auto stage = std::make_unique<PreviewScene>(std::move(set));
        stage->pose(*now); // what touches what is found, of all things
        return stage;
    };
    making_ = std::async(std::launch::async, make, std::move(*patches), light.now);
    if (indexing_ == Indexing::atOnce) takeStage();
}

/// Poses all things as they are, contacts and all: which may take longer than a frame.
void PreviewRows::catchUp(const SceneStatePtr& now) {
    forget();
    behind_ = false;
    const auto pose = [](std::unique_ptr<PreviewScene> stage, const SceneStatePtr& as) {
        stage->pose(*as);
        return stage;
    };
    making_ = std::async(std::launch::async, pose, std::move(stage_), now);
    if (indexing_ == Indexing::atOnce) takeStage();
}

/// Waits for what is being indexed.
void PreviewRows::takeStage() {
    std::unique_ptr<PreviewScene> stage = making_.get();
    surfaces_.clear();
    for (std::uint32_t o = 0; o < geometries_.size(); ++o)
        if (geometries_[o] && !PreviewSurface::fits(*geometries_[o], *stage, o)) return;
    stage_ = std::move(stage);
    for (std::uint32_t o = 0; o < geometries_.size(); ++o)
        surfaces_.push_back(geometries_[o] ? PreviewSurface(geometries_[o], *stage_, o)
                                           : PreviewSurface());
}

bool PreviewRows::knows(const PreviewLighting& light) const {
    const auto alike = [](const PreviewLighting::Object& object, bool moves) {
        return object.moves == moves;
    };
    return light.anchors.empty() && !unfinished_ && slots_.size() == 1 &&
           slots_.front().of == light.now &&
           std::equal(light.objects.begin(), light.objects.end(), moves_.begin(), moves_.end(),
                      alike);
}

/// Whether what is known still holds: the same things move, the same lights are previewed.
bool PreviewRows::sameMoves(const PreviewLighting& light) {
    std::vector<bool> moves, lightMoves;
    for (const auto& object : light.objects) moves.push_back(object.moves);
    for (const auto& source : light.lights) lightMoves.push_back(source.moves);
    const std::vector<std::vector<Emitter>>& lights = light.now->lights;
    bool same = moves == moves_ && lightMoves == lightMoves_ && lights.size() == lights_.size();
    for (std::size_t l = 0; same && l < lights.size(); ++l)
        same = lightMoves[l] || sameLight(lights[l], lights_[l]);
    moves_ = std::move(moves);
    lightMoves_ = std::move(lightMoves);
    lights_ = lights;
    return same;
}

/// Triangles may be made of other vertices than in the last frame.
void PreviewRows::followTriangles(const ShownOf& shown) {
    for (std::uint32_t o = 0; o < surfaces_.size(); ++o) {
        PreviewSurface& surface = surfaces_[o];
        if (!surface || surface.isCurrent()) continue;
        if (const ShownLight* const light = shown(*surface.geometry()))
            carryOver(o, light->adopted);
        surface.follow();
        dropStandIns(o);
    }
}

/// A vertex that took over the light of another one also takes over the points at which that light
/// was evaluated.
void PreviewRows::carryOver(std::uint32_t object, const std::vector<AdoptedVertex>& adopted) {
    for (std::size_t s = 1; s < slots_.size(); ++s) {
        std::vector<std::pair<Key, Receiver>> places;
        for (const auto& [vertex, from] : adopted)
            places.emplace_back(keyOf(object, vertex), receiver(slots_[s], object, from));
        for (const auto& [vertex, place] : places) {
            slots_[s].instead[vertex] = place;
            const std::uint64_t bit = std::uint32_t(vertex) % kBlock;
            for (std::size_t l = 0; l < kMostPreviewed; ++l) {
                const Reached at{object, std::uint32_t(std::uint32_t(vertex) / kBlock)};
                const auto known = slots_[s].table.find(keyOf(at, l));
                if (known != slots_[s].table.end())
                    known->second.vertices &= ~(std::uint64_t(1) << bit);
            }
        }
    }
}

void PreviewRows::dropStandIns(std::uint32_t object) {
    const std::size_t first = surfaces_[object].blocks().size();
    const auto isStandIn = [&](const auto& entry) {
        return entry.first >> 32 == object && std::uint32_t(entry.first) / kMostPreviewed >= first;
    };
    std::erase_if(clear_, isStandIn);
    std::erase_if(last_, isStandIn);
    for (Slot& slot : slots_) std::erase_if(slot.table, isStandIn);
    if (awaited_) std::erase_if(awaited_->table, isStandIn);
}

PreviewRows::Slot PreviewRows::makeSlot(const PreviewLighting& light, const SceneStatePtr& of,
                                        double seconds) {
    Slot slot;
    slot.of = of;
    const int base = std::min(samples_, int(kBlock));
    for (const std::vector<Emitter>& source : of->lights) {
        std::vector<EmitterSender>& senders = slot.senders.emplace_back();
        for (const Emitter& emitter : source)
            senders.emplace_back(emitter, base, std::min(4 * base, int(kBlock)));
    }
    for (std::uint32_t o = 0; o < surfaces_.size(); ++o) {
        if (!light.objects[o].moves || !surfaces_[o]) continue;
        const SceneState::ObjectState& place = of->objects[o];
        slot.poses[o] = placementOf(place.toWorld).pose;
        if (place.visible)
            slot.things.push_back(transformed(surfaces_[o].geometry()->bounds(), place.toWorld));
    }
    if (contacts_ || stage_->isPosedAs(*of))
        findContacts(slot, seconds);
    else
        behind_ = true;
    slot.aside = stage_->receiversAside();
    return slot;
}

/// What is touched in a scene state. If that takes longer than rays may, it is not asked again.
void PreviewRows::findContacts(Slot& slot, double seconds) {
    const double begun = steadySeconds();
    stage_->pose(*slot.of);
    slot.touched = stage_->touched();
    slot.contacts = true;
    slow_ = steadySeconds() - begun > seconds ? slow_ + 1 : 0;
    if (slow_ > 1) contacts_ = false; // once may be chance
}

/// Slot 0 is now, 1 ... are the anchors; keeps those that are there already.
void PreviewRows::chooseSlots(const PreviewLighting& light, double seconds) {
    constexpr double kSurely = 5; // the other way round it is tried
    if (contacts_ && !light.anchors.empty() && stage_->secondsToPose(moves_) > kSurely * seconds)
        contacts_ = false;
    std::vector<SceneStatePtr> wanted{light.now};
    for (const auto& anchor : light.anchors) wanted.push_back(anchor.sceneState);
    std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(wanted.size()));
    if (awaited_) before.push_back(std::move(*awaited_));
    const auto take = [&](const SceneStatePtr& state) {
        const auto known = std::ranges::find(before, state, &Slot::of);
        if (!state || known == before.end()) return std::optional<Slot>();
        std::optional<Slot> slot = std::move(*known);
        known->of = nullptr;
        return slot;
    };
    for (std::size_t s = wanted.size(); s-- > 0;) { // now last: things keep their poses of now
        std::optional<Slot> slot = take(wanted[s]);
        slots_[s] = slot ? std::move(*slot) : makeSlot(light, wanted[s], seconds);
    }
    awaited_ = take(light.awaited);
}

/// Lights between which and a box something that moves may be.
unsigned PreviewRows::lightsThrough(const PreviewLighting& light, const Slot& slot,
                                    const Bounds& box) const {
    unsigned lights = 0;
    for (std::size_t l = 0; l < light.lights.size(); ++l) {
        const auto crossed = [&](const EmitterSender& sender) {
            return std::any_of(slot.things.begin(), slot.things.end(), [&](const Bounds& thing) {
                return shaftMeets(sender.box(), box, thing);
            });
        };
        if (light.lights[l].moves || std::ranges::any_of(slot.senders[l], crossed))
            lights |= 1u << l;
    }
    return lights;
}

/// Lights that a change may hide from what lies in a box of an object [m, local], or uncover.
unsigned PreviewRows::lightsReaching(const PreviewLighting& light, std::uint32_t object,
                                     const Bounds& box) const {
    unsigned lights = light.objects[object].moves ? (1u << light.lights.size()) - 1 : 0;
    const Bounds place =
        stage_->withReceivers(transformed(box, light.now->objects[object].toWorld));
    for (const Slot& slot : slots_) lights |= lightsThrough(light, slot, place);
    return lights;
}

/// Blocks with vertices that a change may reach and that can be seen, of one object. Of what moves,
/// half is turned away.
std::vector<PreviewRows::Reached> PreviewRows::reachedOf(const PreviewLighting& light,
                                                         std::uint32_t object, const View* view,
                                                         const Frustum* frustum) const {
    const PreviewSurface& surface = surfaces_[object];
    std::vector<Reached> reached;
    if (!surface) return reached;
    const std::span<const Bounds> blocks = surface.blocks();
    const glm::dmat4& toWorld = light.now->objects[object].toWorld;
    std::vector<std::uint64_t> seen;
    if (view && light.objects[object].moves)
        seen = surface.turnedTo(glm::inverse(toWorld) * glm::dvec4(view->eye, 1));
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        const std::uint64_t vertices = seen.empty() ? ~std::uint64_t(0) : seen[b];
        if (blocks[b].empty() || vertices == 0) continue;
        const Bounds drawn = grown(blocks[b], surface.largestElement());
        if (frustum && !frustum->mayContain(transformed(drawn, toWorld))) continue;
        if (const unsigned lights = lightsReaching(light, object, blocks[b]))
            reached.push_back({object, b, lights, vertices | surface.coarse()[b].chosen});
    }
    addReachedStandIns(light, object, reached);
    return reached;
}

/// Vertices that represent corners lie all over the object: each is tested by itself. What
/// touches one of the elements around a corner concerns it as well.
void PreviewRows::addReachedStandIns(const PreviewLighting& light, std::uint32_t object,
                                     std::vector<Reached>& reached) const {
    for (const auto& [vertex, corner] : surfaces_[object].standIns()) {
        const Bounds box = surfaces_[object].elementBox(corner);
        const unsigned lights = lightsReaching(light, object, grown(box, box.diagonal()));
        if (lights == 0) continue;
        const auto block = std::uint32_t(vertex / kBlock);
        if (reached.empty() || reached.back().block != block)
            reached.push_back({object, block, 0, 0});
        reached.back().lights |= lights;
        reached.back().vertices |= std::uint64_t(1) << vertex % kBlock;
    }
}

void PreviewRows::findReached(const PreviewLighting& light, const View* view) {
    std::optional<Frustum> frustum;
    if (view) frustum.emplace(view->worldToClip());
    std::vector<std::vector<Reached>> of(surfaces_.size());
    parallelFor(surfaces_.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t o = first; o < last; ++o)
            of[o] = reachedOf(light, std::uint32_t(o), view, frustum ? &*frustum : nullptr);
    });
    reached_.clear();
    for (const std::vector<Reached>& reached : of)
        reached_.insert(reached_.end(), reached.begin(), reached.end());
}

/// Corners that are touched now and drawn with vertices that they share with others; what these are
/// lit by must be known.
void PreviewRows::findTouched(const PreviewLighting& light) {
    touched_.clear();
    std::vector<Reached> more;
    for (const TouchedCorner& corner : slots_.front().touched) {
        const PreviewSurface& surface = surfaces_[corner.object];
        if (!surface) continue;
        const std::uint32_t vertex = surface.drawnAt(corner.corner);
        if (vertex >= surface.ownVertices()) continue;
        touched_.push_back({corner.object, corner.corner, vertex});
        more.push_back({corner.object, std::uint32_t(vertex / kBlock),
                        (1u << light.lights.size()) - 1, std::uint64_t(1) << vertex % kBlock});
    }
    addReached(std::move(more));
}

/// Blocks that are reached already are so by more lights, or with more vertices.
void PreviewRows::addReached(std::vector<Reached> more) {
    reached_.insert(reached_.end(), more.begin(), more.end());
    std::ranges::sort(reached_, before);
    std::size_t kept = 0;
    for (const Reached& at : reached_) {
        if (kept == 0 || before(reached_[kept - 1], at))
            reached_[kept++] = at;
        else
            reached_[kept - 1].lights |= at.lights, reached_[kept - 1].vertices |= at.vertices;
    }
    reached_.resize(kept);
}

/// Of a vertex's block in reached().
std::size_t PreviewRows::indexOf(std::uint32_t object, std::size_t vertex) const {
    const Reached at{object, std::uint32_t(vertex / kBlock)};
    return std::size_t(std::ranges::lower_bound(reached_, at, before) - reached_.begin());
}

/// The point at which a vertex is evaluated in a scene state, whatever light it carries.
Receiver PreviewRows::ownReceiver(const Slot& slot, std::uint32_t object,
                                  std::size_t vertex) const {
    const PreviewSurface& surface = surfaces_[object];
    if (vertex >= surface.ownVertices()) {
        const std::optional<std::uint32_t> corner = surface.cornerOf(vertex);
        if (!corner) return {};
        const auto at =
            std::lower_bound(slot.touched.begin(), slot.touched.end(), std::pair(object, *corner),
                             [](const TouchedCorner& t, const auto& key) {
                                 return std::pair(t.object, t.corner) < key;
                             });
        if (at != slot.touched.end() && at->object == object && at->corner == *corner)
            return at->at;
        vertex = surface.ownVertexAt(*corner);
    }
    const auto pose = slot.poses.find(object);
    return pose != slot.poses.end() ? stage_->receiver(object, vertex, pose->second)
                                    : stage_->receiver(object, vertex);
}

/// The point at which the light that it carries of a scene state was evaluated.
Receiver PreviewRows::receiver(const Slot& slot, std::uint32_t object, std::size_t vertex) const {
    if (!slot.instead.empty()) {
        const auto at = slot.instead.find(keyOf(object, vertex));
        if (at != slot.instead.end()) return at->second;
    }
    return ownReceiver(slot, object, vertex);
}

void PreviewRows::prepare(const PreviewLighting& light, const ShownOf& shown, const View* view,
                          double seconds) {
    constexpr double kAtRest = 3; // times as long, once the hand rests
    const double begun = steadySeconds();
    if (!light.anchors.empty() && !slots_.empty() && slots_.front().of == light.now)
        seconds *= kAtRest;
    unfinished_ = false;
    require(light);
    if (!stage_) return;
    if (!sameMoves(light)) {
        forget();
        if (behind_) catchUp(light.now);
        if (!stage_) return;
    }
    followTriangles(shown);
    chooseSlots(light, seconds);
    findReached(light, view);
    findTouched(light);
    addSources();
    for (Touched& touched : touched_) touched.reached = indexOf(touched.object, touched.vertex);
    ++frame_;
    // Now comes last: what all states have in common is traced as it was when it was lit.
    const double soon = std::isfinite(seconds) ? begun : seconds; // vertices carry it as well
    for (std::size_t s = slots_.size(); s-- > 1;) trace(light, slots_[s], soon);
    const bool anchors = std::exchange(unfinished_, false);
    trace(light, slots_.front(), begun + seconds);
    for (std::size_t s = slots_.size(); anchors && !unfinished_ && s-- > 1;)
        trace(light, slots_[s], begun + seconds);
    unfinished_ |= anchors;
    guess(slots_.front());
    remember(slots_.front());
    for (Slot& slot : slots_) blend(slot);
    traceTouched();
}

void PreviewRows::forget() {
    slots_.clear();
    awaited_.reset();
    clear_.clear();
    last_.clear();
    guessed_.clear();
    frame_ = 0;
    contacts_ = true;
    slow_ = 0;
    reached_.clear();
    touched_.clear();
}

float PreviewRows::unoccluded(const Reached& at, std::size_t source, std::size_t vertex) const {
    const Slot& now = slots_.front();
    const Receiver receiver = ownReceiver(now, at.object, vertex);
    return isPadding(receiver) ? 0 : unoccluded(now.senders[source], receiver);
}

float PreviewRows::unoccluded(std::span<const EmitterSender> source, const Receiver& receiver) {
    float sum = 0;
    for (const EmitterSender& sender : source) sum += sender.formFactor(receiver);
    return sum;
}

} // namespace penumbra
