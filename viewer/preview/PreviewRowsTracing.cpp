// The rays of PreviewRows: of what is missing, in one scene state.
#include "base/Bits.h"
#include "base/Clock.h"
#include "base/Parallel.h"
#include "importance/Proximity.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/rows/EmitterRowBuilder.h"
#include "viewer/preview/PreviewRows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

namespace penumbra {

namespace {

const PreviewRows::Known kNothing;

constexpr std::size_t kTasksAtOnce = 64; ///< some milliseconds
constexpr float kRest = 1.0f / 16;       ///< urgency of vertices that can be guessed meanwhile

} // namespace

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

/// What is known then is noted by trace(): another task may be of the same block.
void PreviewRows::run(Task& task, EmitterRowBuilder& builder) const {
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
    for (const std::size_t i : bitsOf(task.missing)) task.known->factors[i] = 0;
    for (const std::size_t i : bitsOf(wanted & clear)) task.clear->factors[i] = 0;
    for (const EmitterSender& sender : task.slot->senders[task.source]) {
        if (wanted == 0) break;
        RowBlock block;
        builder.update(sender, {receivers, wanted}, wanted, {}, block);
        block.forEach([&](int i, float factor) {
            Known& known = clear >> i & 1 ? *task.clear : *task.known;
            known.factors[std::size_t(i)] += factor;
        });
    }
    task.cleared = clear;
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
            if (stage_->isBlended(object, block)) continue;
            const Bounds box = transformed(blocks[block], slot.of->objects[object].toWorld);
            lights[i] = lightsThrough(light, slot, stage_->withReceivers(box));
        }
    });
    return lights;
}

/// Things keep their present poses.
const RayScene& PreviewRows::raysOf(const Slot& slot) {
    if (!contacts_ || &slot != &slots_.front()) return stage_->raysAt(*slot.of);
    stage_->pose(*slot.of);
    return stage_->rays();
}

/// How near a block is to what moves: 1 beside it, a half at a distance of its size.
float PreviewRows::nearness(const PreviewLighting& light, const Slot& slot,
                            const Reached& at) const {
    const std::span<const Bounds> blocks = surfaces_[at.object].blocks();
    if (light.objects[at.object].moves || at.block >= blocks.size()) return 1;
    const Bounds box = transformed(blocks[at.block], slot.of->objects[at.object].toWorld);
    double nearest = slot.things.empty() ? 1 : 0;
    for (const Bounds& thing : slot.things) {
        const double sizes = distanceBetween(box, thing) / std::max(thing.diagonal(), 1e-6f);
        nearest = std::max(nearest, 1 / (1 + sizes * sizes));
    }
    return float(nearest);
}

/// Vertices of a block from which the others are guessed; none: they can't be.
std::uint64_t PreviewRows::chosenIn(const Reached& at) const {
    const auto coarse = surfaces_[at.object].coarse();
    return at.block < coarse.size() ? at.vertices & coarse[at.block].chosen : 0;
}

/// What is missing, the most urgent first.
std::vector<PreviewRows::Task> PreviewRows::tasksOf(const PreviewLighting& light, Slot& slot) {
    std::vector<Task> tasks;
    const std::vector<unsigned> inDoubt = lightsInDoubt(light, slot);
    slot.found.assign(reached_.size() * kMostPreviewed, nullptr);
    for (std::size_t i = 0; i < reached_.size(); ++i) {
        const Reached& at = reached_[i];
        if (stage_->isBlended(at.object, at.block)) continue;
        const bool moves = light.objects[at.object].moves;
        const bool isStandIn = at.block >= surfaces_[at.object].blocks().size();
        const bool nowhere = isStandIn && !slot.contacts && &slot != &slots_.front();
        for (std::size_t l = 0; l < slot.senders.size(); ++l) {
            if (!(at.lights >> l & 1)) continue;
            if (nowhere) {
                slot.found[i * kMostPreviewed + l] = &kNothing;
                continue;
            }
            const Key key = keyOf(at, l);
            const bool inTheWay = inDoubt[i] >> l & 1;
            Known& known = (inTheWay ? slot.table : clear_)[key];
            slot.found[i * kMostPreviewed + l] = &known;
            const std::uint64_t missing = at.vertices & ~known.vertices;
            if (missing == 0) continue;
            const bool some = inTheWay && !moves && !light.lights[l].moves;
            const auto before = last_.find(key);
            const auto waited = float(frame_ - (before == last_.end() ? 0 : before->second.frame));
            Task task{&slot,
                      &at,
                      l,
                      &known,
                      some ? &clear_[key] : nullptr,
                      missing,
                      waited * nearness(light, slot, at)};
            const std::uint64_t first = missing & chosenIn(at);
            if (first != missing && first != 0) {
                task.missing = first;
                tasks.push_back(task);
                task.missing = missing & ~first;
                task.urgency *= kRest;
            }
            tasks.push_back(task);
        }
    }
    std::ranges::stable_sort(tasks, std::ranges::greater(), &Task::urgency);
    return tasks;
}

/// \param until when the last rays may be begun, but for the most urgent ones [s]
void PreviewRows::trace(const PreviewLighting& light, Slot& slot, double until) {
    std::vector<Task> tasks = tasksOf(light, slot);
    if (tasks.empty()) return;
    const RayScene& rays = raysOf(slot);
    const std::size_t atOnce = std::isfinite(until) ? kTasksAtOnce : tasks.size();
    std::size_t done = 0;
    while (done < tasks.size() && (done == 0 || steadySeconds() < until)) {
        const std::size_t count = std::min(atOnce, tasks.size() - done);
        parallelFor(count, 4, [&](std::size_t first, std::size_t last) {
            EmitterRowBuilder builder(rays);
            for (std::size_t t = first; t < last; ++t) run(tasks[done + t], builder);
        });
        for (const Task& task : std::span(tasks).subspan(done, count)) {
            task.known->vertices |= task.missing;
            if (task.cleared != 0) task.clear->vertices |= task.cleared;
        }
        done += count;
    }
    unfinished_ |= done < tasks.size();
}

/// Vertices of which the chosen ones are known, but not they.
void PreviewRows::guess(Slot& now) {
    guessed_.clear();
    for (std::size_t i = 0; i < now.found.size(); ++i) {
        const Known*& found = now.found[i];
        if (!found) continue;
        const Reached& at = reached_[i / kMostPreviewed];
        const std::uint64_t missing = at.vertices & ~found->vertices, chosen = chosenIn(at);
        if (missing == 0 || chosen == 0 || (missing & chosen) != 0) continue;
        const CoarseBlock& from = surfaces_[at.object].coarse()[at.block];
        Known& known = guessed_[keyOf(at, i % kMostPreviewed)] = *found;
        for (const std::size_t v : bitsOf(missing)) {
            if (!found->of(from.nearest[v]) || !found->of(from.secondNear[v])) continue;
            known.factors[v] = from.guess(found->factors, v);
            known.vertices |= std::uint64_t(1) << v;
        }
        found = &known;
    }
}

/// What is not known of now is as it was known last.
void PreviewRows::remember(Slot& now) {
    for (std::size_t i = 0; i < now.found.size(); ++i) {
        const Known*& found = now.found[i];
        if (!found) continue;
        const Reached& at = reached_[i / kMostPreviewed];
        const Key key = keyOf(at, i % kMostPreviewed);
        if ((at.vertices & ~found->vertices) == 0) {
            Known& last = last_[key] = *found;
            last.frame = last.shown = frame_;
        } else if (const auto last = last_.find(key); last != last_.end()) {
            last->second.shown = frame_;
            found = &last->second;
        }
    }
    std::erase_if(last_, [&](const auto& entry) { return entry.second.shown != frame_; });
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
