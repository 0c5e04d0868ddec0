#include "viewer/LiveRows.h"

#include "radiosity/Parallel.h"
#include "radiosity/RowBuilder.h"
#include "radiosity/Shaft.h"
#include "viewer/Arrangements.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <utility>

namespace penumbra {

namespace {

constexpr float kPullIn = 0.02f; // as radiosity/Contact.cpp pulls receivers into their elements
constexpr float kSkin = 1e-5f;   // of the scene's diagonal, as radiosity/BuildPatches.cpp has it

} // namespace

/// Receivers lie a little towards the middle of what is around them: inside of a surface that is
/// where they are, at its border it keeps them clear of what begins there.
void LiveRows::describe(Surface& surface) const {
    const LitMeshData& data = surface.geometry->data();
    surface.topology = surface.geometry->topologyRevision();
    surface.points.assign(data.positions.size(), glm::vec3(0));
    std::vector<float> around(data.positions.size(), 0);
    for (std::size_t t = 0; t < data.indices.size(); t += 3) {
        glm::vec3 middle(0);
        for (std::size_t k = 0; k < 3; ++k) middle += data.positions[data.indices[t + k]] / 3.0f;
        for (std::size_t k = 0; k < 3; ++k) {
            surface.points[data.indices[t + k]] += middle;
            around[data.indices[t + k]] += 1;
        }
    }
    surface.blocks.assign((data.positions.size() + kBlock - 1) / kBlock, {});
    for (std::size_t v = 0; v < data.positions.size(); ++v) {
        const glm::vec3 at = data.positions[v];
        if (around[v] == 0) {
            surface.points[v] = at;
            continue;
        }
        surface.points[v] = glm::mix(at, surface.points[v] / around[v], kPullIn);
        surface.blocks[v / kBlock].add(at);
    }
}

void LiveRows::require(const std::vector<std::shared_ptr<const LitGeometry>>& geometries) {
    const auto same = [](const Surface& s, const auto& g) { return s.geometry == g; };
    if (rays_ &&
        std::equal(surfaces_.begin(), surfaces_.end(), geometries.begin(), geometries.end(), same))
        return;
    surfaces_.assign(geometries.size(), {});
    slots_.clear();
    clear_.clear();
    moves_.clear();
    std::vector<RayMesh> meshes(geometries.size());
    Bounds all;
    for (std::size_t o = 0; o < geometries.size(); ++o) {
        if (!geometries[o]) continue;
        surfaces_[o].geometry = geometries[o];
        const LitMeshData& data = geometries[o]->data();
        meshes[o].vertices = data.positions;
        surfaces_[o].inRays = data.positions.size();
        for (std::size_t t = 0; t < data.indices.size(); t += 3)
            meshes[o].triangles.push_back(
                {data.indices[t], data.indices[t + 1], data.indices[t + 2]});
        all.add(geometries[o]->bounds());
    }
    skin_ = kSkin * all.diagonal();
    rays_ = std::make_unique<RayScene>(meshes, all.diagonal());
    standsAs_.assign(geometries.size(), {});
    for (std::uint32_t o = 0; o < geometries.size(); ++o)
        rays_->show({o}, geometries[o] != nullptr);
    rays_->commit();
}

/// What is known holds no more if other things move, or other lamps are live.
void LiveRows::startAnew(const LiveLight& light) {
    std::vector<bool> moves, lampMoves;
    for (const auto& object : light.objects) moves.push_back(object.moves);
    for (const auto& lamp : light.lamps) lampMoves.push_back(lamp.moves);
    const std::vector<std::optional<Emitter>>& lamps = light.now->lamps;
    bool same = moves == moves_ && lampMoves == lampMoves_ && lamps.size() == lamps_.size();
    for (std::size_t l = 0; same && l < lamps.size(); ++l)
        same = lampMoves[l] || sameLamp(lamps[l], lamps_[l]);
    if (!same) {
        clear_.clear();
        slots_.clear();
    }
    moves_ = std::move(moves);
    lampMoves_ = std::move(lampMoves);
    lamps_ = lamps;
    for (std::uint32_t o = 0; o < surfaces_.size(); ++o) {
        Surface& surface = surfaces_[o];
        if (!surface.geometry || surface.topology == surface.geometry->topologyRevision()) continue;
        describe(surface);
        const auto ofIt = [&](const auto& entry) { return entry.first >> 32 == o; };
        std::erase_if(clear_, ofIt);
        for (Slot& slot : slots_) std::erase_if(slot.table, ofIt);
    }
}

LiveRows::Slot LiveRows::makeSlot(const LiveLight& light, const ArrangementPtr& of) const {
    Slot slot;
    slot.of = of;
    for (const std::optional<Emitter>& lamp : of->lamps) {
        const int base = std::min(samples_, int(kBlock));
        slot.senders.emplace_back();
        if (lamp) slot.senders.back().emplace(*lamp, base, std::min(4 * base, int(kBlock)));
    }
    for (std::size_t o = 0; o < surfaces_.size(); ++o)
        if (light.objects[o].moves && surfaces_[o].geometry && of->objects[o].visible)
            slot.things.push_back(
                transformed(surfaces_[o].geometry->bounds(), of->objects[o].toWorld));
    return slot;
}

/// Slot 0 is now, 1 ... are the anchors; keeps those that are there already.
void LiveRows::chooseSlots(const LiveLight& light) {
    std::vector<ArrangementPtr> wanted{light.now};
    for (const auto& anchor : light.anchors) wanted.push_back(anchor.arrangement);
    std::vector<Slot> slots;
    for (const ArrangementPtr& of : wanted) {
        const auto known = std::find_if(slots_.begin(), slots_.end(),
                                        [&](const Slot& slot) { return slot.of == of; });
        slots.push_back(known != slots_.end() ? std::move(*known) : makeSlot(light, of));
        if (known != slots_.end()) known->of = nullptr;
    }
    slots_ = std::move(slots);
}

/// Whether something that moves may stand between a lamp and a block.
bool LiveRows::inTheWay(const LiveLight& light, const Slot& slot, const Bounds& block,
                        std::size_t lamp) const {
    if (light.lamps[lamp].moves) return true;
    return slot.senders[lamp] &&
           std::any_of(slot.things.begin(), slot.things.end(), [&](const Bounds& thing) {
               return shaftMeets(slot.senders[lamp]->box(), block, thing);
           });
}

void LiveRows::findReached(const LiveLight& light) {
    reached_.clear();
    const unsigned all = (1u << light.lamps.size()) - 1;
    for (std::uint32_t o = 0; o < surfaces_.size(); ++o) {
        if (!surfaces_[o].geometry) continue;
        const glm::dmat4& place = light.now->objects[o].toWorld;
        for (std::uint32_t b = 0; b < surfaces_[o].blocks.size(); ++b) {
            if (surfaces_[o].blocks[b].empty()) continue;
            unsigned lamps = light.objects[o].moves ? all : 0;
            const Bounds box = grown(transformed(surfaces_[o].blocks[b], place), skin_);
            for (std::size_t l = 0; lamps != all && l < light.lamps.size(); ++l)
                for (const Slot& slot : slots_)
                    if (inTheWay(light, slot, box, l)) lamps |= 1u << l;
            if (lamps != 0) reached_.push_back({o, b, lamps});
        }
    }
}

/// Moves what does not stand that way.
void LiveRows::place(const Arrangement& arrangement) {
    bool any = false;
    std::vector<glm::vec3> world;
    for (std::uint32_t o = 0; o < surfaces_.size(); ++o) {
        const Arrangement::Place& wanted = arrangement.objects[o];
        if (!surfaces_[o].geometry || wanted == standsAs_[o]) continue;
        world.clear();
        const std::vector<glm::vec3>& points = surfaces_[o].geometry->data().positions;
        for (const glm::vec3 p : std::span(points).first(surfaces_[o].inRays))
            world.push_back(glm::vec3(wanted.toWorld * glm::dvec4(p, 1)));
        rays_->move({o}, world);
        rays_->show({o}, wanted.visible);
        standsAs_[o] = wanted;
        any = true;
    }
    if (any) rays_->commit();
}

Receiver LiveRows::receiver(const Surface& surface, const glm::dmat4& toWorld,
                            std::size_t v) const {
    const glm::vec3 normal = surface.geometry->data().normals[v];
    if (normal == glm::vec3(0)) return {};
    const glm::dmat3 turn = glm::inverseTranspose(glm::dmat3(toWorld));
    const glm::vec3 up(glm::normalize(turn * glm::dvec3(normal)));
    return {glm::vec3(toWorld * glm::dvec4(surface.points[v], 1)) + skin_ * up, up};
}

void LiveRows::trace(const LiveLight& light, Slot& slot) {
    struct Task {
        const Reached* at;
        std::size_t lamp;
        Factors* factors;
    };
    std::vector<Task> tasks;
    for (const Reached& at : reached_) {
        const Bounds box = grown(
            transformed(surfaces_[at.object].blocks[at.block], slot.of->objects[at.object].toWorld),
            skin_);
        for (std::size_t l = 0; l < slot.senders.size(); ++l) {
            if (!(at.lamps >> l & 1)) continue;
            const bool own = light.objects[at.object].moves;
            Table& table = own || inTheWay(light, slot, box, l) ? slot.table : clear_;
            const auto [entry, fresh] = table.try_emplace(keyOf(at, l), Factors{});
            if (fresh && slot.senders[l]) tasks.push_back({&at, l, &entry->second});
        }
    }
    if (tasks.empty()) return;
    place(*slot.of);
    parallelFor(tasks.size(), 8, [&](std::size_t first, std::size_t last) {
        RowBuilder builder(*rays_);
        std::array<Receiver, kBlock> receivers;
        for (std::size_t t = first; t < last; ++t) {
            const Surface& surface = surfaces_[tasks[t].at->object];
            const std::size_t begin = tasks[t].at->block * kBlock;
            const std::size_t count = std::min(kBlock, surface.points.size() - begin);
            std::uint64_t wanted = 0;
            for (std::size_t i = 0; i < count; ++i) {
                receivers[i] =
                    receiver(surface, slot.of->objects[tasks[t].at->object].toWorld, begin + i);
                if (!isPadding(receivers[i])) wanted |= std::uint64_t(1) << i;
            }
            RowBlock block;
            builder.updateEmitterBlock(*slot.senders[tasks[t].lamp],
                                       {std::span(receivers).first(count), wanted, 0}, wanted, {},
                                       block);
            block.forEach(
                [&](int i, float factor) { (*tasks[t].factors)[std::size_t(i)] = factor; });
        }
    });
}

void LiveRows::prepare(const LiveLight& light) {
    std::vector<std::shared_ptr<const LitGeometry>> geometries;
    for (const auto& object : light.objects) geometries.push_back(object.geometry);
    require(geometries);
    startAnew(light);
    chooseSlots(light);
    findReached(light);
    for (std::size_t s = slots_.size(); s-- > 0;) trace(light, slots_[s]); // now last: it stays
}

void LiveRows::forget() {
    slots_.clear();
    clear_.clear();
    reached_.clear();
}

const LiveRows::Factors& LiveRows::factors(std::size_t slot, const Reached& at,
                                           std::size_t lamp) const {
    const auto own = slots_[slot].table.find(keyOf(at, lamp));
    return own != slots_[slot].table.end() ? own->second : clear_.at(keyOf(at, lamp));
}

float LiveRows::unoccluded(const Reached& at, std::size_t lamp, std::size_t vertex) const {
    const Slot& now = slots_.front();
    if (!now.senders[lamp]) return 0;
    const Receiver at1 = receiver(surfaces_[at.object], now.of->objects[at.object].toWorld, vertex);
    return isPadding(at1) ? 0 : now.senders[lamp]->formFactor(at1);
}

} // namespace penumbra
