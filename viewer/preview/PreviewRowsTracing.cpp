// The rays of PreviewRows: of what is missing, in one scene state.
#include "base/Bits.h"
#include "base/Parallel.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/rows/EmitterRowBuilder.h"
#include "viewer/preview/PreviewRows.h"

#include <algorithm>
#include <bit>

namespace penumbra {

/// Whether nothing that moves is between a light and a vertex or touches the vertex: it is then
/// evaluated where it always is. Blocks are wide: of the vertices of one that something is before,
/// it is before a few.
bool PreviewRows::isClear(const Task& task, std::size_t vertex, const Receiver& receiver) const {
    const Slot& slot = *task.slot;
    const std::uint32_t object = task.at->object;
    if (!task.clear || slot.instead.contains(keyOf(object, vertex))) return false;
    if (vertex >= surfaces_[object].ownVertices()) {
        const std::optional<std::uint32_t> corner = surfaces_[object].cornerOf(vertex);
        if (!corner) return false;
        const Bounds box =
            transformed(surfaces_[object].elementBox(*corner), slot.of->objects[object].toWorld);
        const Bounds around = grown(box, box.diagonal()); // what touches the elements beside it
        for (const Bounds& thing : slot.things)
            if (thing.overlaps(around)) return false;
    }
    const Bounds place{receiver.position, receiver.position};
    return std::ranges::none_of(slot.senders[task.source], [&](const EmitterSender& sender) {
        return std::ranges::any_of(slot.things, [&](const Bounds& thing) {
            return shaftMeets(sender.box(), place, thing);
        });
    });
}

void PreviewRows::run(const Task& task, EmitterRowBuilder& builder) const {
    std::array<Receiver, kBlock> receivers{};
    std::uint64_t wanted = 0, clear = 0;
    const std::size_t begin = task.at->block * kBlock;
    for (const std::size_t i : bitsOf(task.missing)) {
        const std::uint64_t bit = std::uint64_t(1) << i;
        receivers[i] = receiver(*task.slot, task.at->object, begin + i);
        if (isPadding(receivers[i])) continue;
        if (isClear(task, begin + i, receivers[i])) clear |= bit;
        if (!(clear & bit) || !(task.clear->vertices & bit)) wanted |= bit;
    }
    for (const int i : bitsOf(wanted & clear)) task.clear->factors[i] = 0;
    for (const EmitterSender& sender : task.slot->senders[task.source]) {
        if (wanted == 0) break;
        RowBlock block;
        builder.update(sender, {receivers, wanted}, wanted, {}, block);
        block.forEach([&](int i, float factor) {
            Known& known = clear >> i & 1 ? *task.clear : *task.known;
            known.factors[std::size_t(i)] += factor;
        });
    }
    if (clear == 0) return;
    task.clear->vertices |= clear;
    for (const std::size_t i : bitsOf(clear)) {
        task.known->factors[i] = task.clear->factors[i];
    }
}

/// For all that is reached, lights that what moves may hide in this scene state.
std::vector<unsigned> PreviewRows::lightsInDoubt(const PreviewLighting& light,
                                                 const Slot& slot) const {
    std::vector<unsigned> lights(reached_.size(), ~0u);
    parallelFor(reached_.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto& [object, block, reaching, vertices] = reached_[i];
            const std::span<const Bounds> blocks = surfaces_[object].blocks();
            if (light.objects[object].moves || block >= blocks.size()) continue;
            const Bounds box = transformed(blocks[block], slot.of->objects[object].toWorld);
            lights[i] = lightsThrough(light, slot, stage_->withReceivers(box));
        }
    });
    return lights;
}

/// Things keep their present poses.
const RayScene& PreviewRows::raysOf(const Slot& slot) {
    if (&slot != &slots_.front()) return stage_->raysAt(*slot.of);
    stage_->pose(*slot.of);
    return stage_->rays();
}

void PreviewRows::trace(const PreviewLighting& light, Slot& slot) {
    std::vector<Task> tasks;
    const std::vector<unsigned> inDoubt = lightsInDoubt(light, slot);
    slot.found.assign(reached_.size() * kMostPreviewed, nullptr);
    for (std::size_t i = 0; i < reached_.size(); ++i) {
        const Reached& at = reached_[i];
        const bool moves = light.objects[at.object].moves;
        for (std::size_t l = 0; l < slot.senders.size(); ++l) {
            if (!(at.lights >> l & 1)) continue;
            const bool inTheWay = inDoubt[i] >> l & 1;
            Known& known = (inTheWay ? slot.table : clear_)[keyOf(at, l)];
            slot.found[i * kMostPreviewed + l] = &known;
            const std::uint64_t missing = at.vertices & ~known.vertices;
            known.vertices |= missing;
            for (const int v : bitsOf(missing)) known.factors[std::size_t(v)] = 0;
            if (missing == 0 || slot.senders[l].empty()) continue;
            const bool some = inTheWay && !moves && !light.lights[l].moves;
            tasks.push_back(
                {&slot, &at, l, &known, some ? &clear_[keyOf(at, l)] : nullptr, missing});
        }
    }
    if (tasks.empty()) return;
    const RayScene& rays = raysOf(slot);
    parallelFor(tasks.size(), 8, [&](std::size_t first, std::size_t last) {
        EmitterRowBuilder builder(rays);
        for (std::size_t t = first; t < last; ++t) run(tasks[t], builder);
    });
}

/// What is touched now: a few corners, evaluated anew in each frame.
void PreviewRows::traceTouched() {
    if (touched_.empty()) return;
    const Slot& now = slots_.front();
    stage_->pose(*now.of);
    std::vector<Receiver> receivers; // both lists are by object and corner
    for (std::size_t i = 0, t = 0; t < touched_.size(); ++i)
        if (now.touched[i].object == touched_[t].object &&
            now.touched[i].corner == touched_[t].corner)
            receivers.push_back(now.touched[i].at), ++t;
    const std::size_t blocks = (touched_.size() + kBlock - 1) / kBlock;
    parallelFor(blocks * now.senders.size(), 1, [&](std::size_t first, std::size_t last) {
        EmitterRowBuilder builder(stage_->rays());
        for (std::size_t job = first; job < last; ++job) {
            const std::size_t source = job % now.senders.size();
            const std::size_t begin = job / now.senders.size() * kBlock;
            const std::size_t count = std::min(kBlock, touched_.size() - begin);
            const std::uint64_t all = ~std::uint64_t(0) >> (kBlock - count);
            for (const EmitterSender& sender : now.senders[source]) {
                RowBlock block;
                builder.update(sender, {std::span(receivers).subspan(begin, count), all}, all, {},
                               block);
                block.forEach([&](int i, float factor) {
                    touched_[begin + std::size_t(i)].factors[source] += factor;
                });
            }
            for (std::size_t i = 0; i < count; ++i)
                touched_[begin + i].unoccluded[source] =
                    unoccluded(now.senders[source], receivers[begin + i]);
        }
    });
}

} // namespace penumbra
