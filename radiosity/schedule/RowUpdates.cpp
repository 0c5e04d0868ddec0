#include "radiosity/schedule/RowUpdates.h"

#include "base/Parallel.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/schedule/WorkCosts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr std::size_t kMostProbes = 64; ///< of blocks, at a time
constexpr double kTask = 256;           ///< is as much at least, for one thread [rays]

/// Bound of the form factor, F <= cos A / (pi d^2), of a sender onto any receiver in a box.
float factorBound(const RowUpdates::RowFacts& sender, const Bounds& receivers) {
    const glm::vec3 gap =
        glm::max(glm::max(sender.box.lower - receivers.upper, receivers.lower - sender.box.upper),
                 glm::vec3(0));
    const float distance2 = glm::dot(gap, gap);
    float cosine = 1;
    if (sender.normal != glm::vec3(0)) {
        const glm::vec3 n = sender.normal;
        const glm::vec3 highest(n.x > 0 ? receivers.upper.x : receivers.lower.x,
                                n.y > 0 ? receivers.upper.y : receivers.lower.y,
                                n.z > 0 ? receivers.upper.z : receivers.lower.z);
        constexpr float kRounding = 1e-5f; // of directions
        const float distance = std::sqrt(distance2);
        const float height = std::max(0.0f, glm::dot(n, highest - sender.centre));
        cosine = distance > 0 ? std::min(1.0f, height / distance + kRounding) : 1.0f;
    }
    const float area = cosine * sender.area;
    return area < std::numbers::pi_v<float> * distance2
               ? area / (std::numbers::pi_v<float> * distance2)
               : 1.0f;
}

/// Moves who hides receivers of a block to the notes.
void takeOccluders(std::vector<ObjectId>& occluders, const DirtyBlock& item,
                   std::vector<RowTable::BlockerNote>& notes) {
    for (const ObjectId object : occluders) notes.push_back({item.row, item.block, object.value});
    occluders.clear();
}

} // namespace

RowUpdates::RowUpdates(const PatchSet& set, const RayScene& rays, RowTable& table,
                       const std::vector<ObjectId>& blockObjects, const DirtySet::Costs& costs)
    : set_(set), rayScene_(rays), table_(table), blockObjects_(blockObjects), costs_(costs),
      row_(table.size()), dirty_(table.size(), costs) {}

void RowUpdates::grow() {
    const std::size_t before = dirty_.rows();
    if (row_ == before) row_ = table_.size(); // all is found as it was
    dirty_.grow(table_.size());
    for (std::size_t row = before; row < table_.size(); ++row) setCurrent(row);
}

void RowUpdates::add(std::vector<ObjectId> objects, std::vector<BlockMask> receivers,
                     std::vector<Bounds> regions) {
    ++edits_;
    for (ObjectId object : objects) {
        const auto same = std::find_if(moved_.begin(), moved_.end(), [&](const MovedObject& m) {
            return m.object == object.value;
        });
        if (same != moved_.end()) {
            movedWhen_.erase(movedWhen_.begin() + (same - moved_.begin()));
            moved_.erase(same);
        }
        moved_.push_back({object.value, set_.objects[object.value].present,
                          grown(boundsOf(set_, object), strayAt(set_.farthest))});
        movedWhen_.push_back(edits_);
    }
    unite(receivers);
    unreported_.push_back({std::move(objects), std::move(receivers), std::move(regions)});
    changes_.clear();
    row_ = 0, block_ = 0;
}

double RowUpdates::share() const {
    if (!found()) return 0;
    return toDo_ == 0 ? 1 : 1 - double(dirty_.count()) / double(toDo_);
}

/// Of the objects that moved after the first `edits`, where they are now.
std::span<const MovedObject> RowUpdates::movedSince(std::uint32_t edits) const {
    const auto first = std::upper_bound(movedWhen_.begin(), movedWhen_.end(), edits);
    return std::span(moved_).subspan(std::size_t(first - movedWhen_.begin()));
}

const PendingChange& RowUpdates::changeSince(std::uint32_t edits) {
    const auto [found, isNew] = changes_.try_emplace(edits);
    PendingChange& change = found->second;
    if (!isNew) return change;
    for (std::size_t i = edits - (edits_ - unreported_.size()); i < unreported_.size(); ++i) {
        const Edit& edit = unreported_[i];
        change.receivers.insert(change.receivers.end(), edit.receivers.begin(),
                                edit.receivers.end());
        change.regions.insert(change.regions.end(), edit.regions.begin(), edit.regions.end());
    }
    const auto moved = movedSince(edits);
    change.moved.assign(moved.begin(), moved.end());
    unite(change.receivers);
    return change;
}

/// How far entries of a block may be from what they should be. Those that stay have the form factor
/// that they have; those that are evaluated anew may come to have any.
float RowUpdates::factorBound(const DirtyBlock& item, const RowFacts& facts) const {
    constexpr float kTiny = 1e-6f;
    const RowBlock& block = table_[item.row][item.block];
    float could = penumbra::factorBound(facts, table_.blocks()[item.block]);
    if (could >= facts.none) could = std::max(could, facts.least);
    if (item.anew != 0) return std::max(could, block.largestFormFactor());
    return could < kTiny ? could : std::min(could, block.largestFormFactor());
}

/// The next run of blocks to be searched; false: all rows know of all edits. \param run blocks
bool RowUpdates::nextSearch(Search& search, std::size_t run, const Facts& facts) {
    for (; row_ < table_.size(); ++row_) {
        search = {};
        search.row = std::uint32_t(row_);
        std::uint32_t& known = table_.edits(row_);
        if (known == edits_) continue;
        search.facts = facts(search.row);
        if (search.facts.known) break;
        known = edits_;
    }
    if (row_ == table_.size()) return false;
    search.change = &changeSince(table_.edits(row_));
    search.most = std::min(table_[row_].size(), run);
    if (search.most == run) {
        const std::size_t blocks = table_.blocks().size();
        search.blocks = {block_, std::uint32_t(std::min(block_ + run, blocks))};
        block_ = search.blocks.end;
        search.last = block_ == blocks;
    }
    if (search.last) ++row_, block_ = 0;
    return true;
}

/// Who hides a block that has no entries from its sender, so that it will have none.
/// \param objects that moved, once it is known who hides all of them
ObjectId RowUpdates::hidden(const Search& search, const BlockMask& mask,
                            std::map<std::uint32_t, ObjectId>& objects) const {
    const std::uint32_t object = blockObjects_[mask.block].value;
    const auto moved = std::find_if(search.change->moved.begin(), search.change->moved.end(),
                                    [&](const MovedObject& m) { return m.object == object; });
    if (moved != search.change->moved.end()) {
        const auto [known, isNew] = objects.try_emplace(object);
        const float hover = hoverAt(set_.skin, magnitude(moved->box)); // receivers are off surfaces
        if (isNew) known->second = search.facts.hidden(grown(moved->box, 2 * hover));
        if (known->second.valid()) return known->second;
    }
    return search.facts.hidden(search.facts.boxes.empty() ? table_.blocks()[mask.block]
                                                          : search.facts.boxes[mask.block]);
}

void RowUpdates::find(Search& search) const {
    std::map<std::uint32_t, ObjectId> objects;
    for (const BlockMask& mask :
         table_.concerned(search.row, search.facts.box, search.facts.object, *search.change,
                          search.blocks, search.facts.hidden)) {
        const bool empty = table_[search.row][mask.block].entryCount() == 0;
        if (empty && mask.receivers == 0) continue;
        if (empty && search.facts.hidden) {
            const ObjectId by = hidden(search, mask, objects);
            if (by.valid()) search.hidden.push_back({search.row, mask.block, by.value});
            if (by.valid()) continue;
        }
        search.found.push_back(
            {search.row, mask.block, mask.receivers, table_.edits(search.row), 0});
        search.found.back().factor = factorBound(search.found.back(), search.facts);
    }
}

void RowUpdates::find(std::size_t effort, const Facts& facts) {
    const std::size_t run = std::max<std::size_t>(512, effort / (16 * cost::kRowFind)); // blocks
    bool more = true;
    for (std::size_t cost = 0; more && cost < effort;) {
        // What is found can't be known before: no more probes at a time than may be paid for.
        std::vector<Search> searches;
        Search search;
        for (std::size_t most = 0; most < effort && (more = nextSearch(search, run, facts));) {
            most += cost::kRowSearch + cost::kRowFind * search.most;
            searches.push_back(std::move(search));
        }
        parallelFor(searches.size(), 4, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) find(searches[i]);
        });
        for (const Search& one : searches) {
            dirty_.mark(one.row, one.found);
            table_.forgetOccluders(one.row, one.facts.object, *one.change, one.blocks);
            table_.noteOccluders(one.hidden);
            for (const auto& note : one.hidden) hidden_.push_back(note.block);
            if (one.last) table_.edits(one.row) = edits_;
            cost += cost::kRowSearch + cost::kRowFind * (one.found.size() + one.hidden.size());
        }
    }
    if (found()) allFound();
}

void RowUpdates::mark(std::uint32_t row, const Facts& facts, std::span<const BlockMask> masks) {
    if (masks.empty()) return;
    const RowFacts known = facts(row);
    std::vector<DirtyBlock> blocks;
    for (const BlockMask& mask : masks) {
        blocks.push_back({row, mask.block, mask.receivers, table_.edits(row), 0});
        blocks.back().factor = factorBound(blocks.back(), known);
    }
    dirty_.mark(row, blocks);
}

void RowUpdates::allFound() {
    unreported_.clear();
    changes_.clear();
    toDo_ = dirty_.count();
}

/// Probes all that is to be probed. \return what it cost, about [rays]
std::size_t RowUpdates::probe(const Expect& expect) {
    constexpr std::size_t kGrain = 8;
    while (probes_.size() < kMostProbes / kGrain) probes_.emplace_back(rayScene_);
    std::vector<ExpectedFactors> expected(unseen_.size());
    std::vector<std::vector<RowTable::BlockerNote>> occluders(probes_.size());
    parallelFor(unseen_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        ChangeProbe& probe = probes_[first / kGrain];
        for (std::size_t i = first; i < last; ++i) {
            expected[i] = expect(probe, unseen_[i], movedSince(unseen_[i].since));
            takeOccluders(probe.occluders, unseen_[i], occluders[first / kGrain]);
        }
    });
    for (const auto& some : occluders)
        table_.noteOccluders(some); // there may be nothing to be done
    for (std::size_t i = 0; i < unseen_.size(); ++i)
        dirty_.expect(unseen_[i].row, unseen_[i].block, expected[i]);
    for (ChangeProbe& probe : probes_) rays_ += probe.takeRayCount();
    const std::size_t spent = unseen_.size() * cost::kProbe;
    unseen_.clear();
    return spent;
}

/// Parts of the same block are worked on as one.
void RowUpdates::uniteParts() {
    const auto isPart = [](const DirtyBlock& item) { return ~item.receivers != 0; };
    if (std::none_of(items_.begin(), items_.end(), isPart)) return;
    std::sort(items_.begin(), items_.end(), [](const DirtyBlock& a, const DirtyBlock& b) {
        return a.row != b.row ? a.row < b.row : a.block < b.block;
    });
    std::size_t count = 0;
    for (const DirtyBlock& item : items_) {
        DirtyBlock* const last = count > 0 ? &items_[count - 1] : nullptr;
        if (last && last->row == item.row && last->block == item.block) {
            last->receivers |= item.receivers;
            last->anew |= item.anew;
            last->cost += item.cost;
        } else {
            items_[count++] = item;
        }
    }
    items_.resize(count);
}

/// Takes what is to be worked on next. Blocks that might come first are probed before that: only
/// when no other could have a higher priority, by what is known of it, is one of them taken.
void RowUpdates::choose(std::size_t effort, double enough, const Expect& expect) {
    items_.clear();
    std::size_t steps = effort / cost::kTake + 1;
    for (std::size_t sum = 0; sum < effort;) {
        const std::optional<DirtyBlock> item = dirty_.next(enough, steps);
        if (item && item->probe && expect) {
            unseen_.push_back(*item);
            if (unseen_.size() == kMostProbes) sum += probe(expect);
        } else if (!unseen_.empty()) {
            if (item) dirty_.putBack(*item);
            sum += probe(expect);
        } else if (item) {
            dirty_.clean(*item);
            items_.push_back(*item);
            sum += std::size_t(item->cost);
        } else {
            break;
        }
    }
    if (!unseen_.empty()) probe(expect);
    uniteParts();
}

/// Items one after the other, for one thread each.
std::vector<Range> RowUpdates::tasks() const {
    std::vector<Range> tasks;
    double cost = kTask;
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
        if (cost >= kTask) tasks.push_back({i, 0}), cost = 0;
        ++tasks.back().count;
        cost += items_[i].cost;
    }
    return tasks;
}

std::span<const DirtyBlock> RowUpdates::work(std::size_t effort, double enough, const Facts& facts,
                                             const Update& update, const Expect& expect) {
    if (!found()) {
        items_.clear();
        find(effort, facts);
        return {};
    }
    choose(effort, enough, expect);
    const auto items = std::span<const DirtyBlock>(items_);
    const std::vector<Range> tasks = this->tasks();
    while (builders_.size() < std::min<std::size_t>(tasks.size(), 64))
        builders_.emplace_back(rayScene_);
    // A builder a task of a round: results do not depend on which thread does what.
    for (std::size_t round = 0; round < tasks.size(); round += builders_.size()) {
        const std::size_t count = std::min(tasks.size() - round, builders_.size());
        std::vector<std::uint64_t> changed(builders_.size());
        std::vector<std::vector<RowTable::BlockerNote>> notes(builders_.size()),
            occluders(builders_.size());
        parallelFor(count, 1, [&](std::size_t task, std::size_t) {
            RowBuilder& builder = builders_[task];
            for (std::size_t i = tasks[round + task].first; i < tasks[round + task].end(); ++i) {
                const DirtyBlock& item = items[i];
                const int entries = update(builder, item, movedSince(item.since), i);
                takeOccluders(builder.occluders, item, occluders[task]);
                if (entries == 0) continue;
                changed[task] += std::uint64_t(entries);
                RowTable::listBlockers(item.row, item.block, table_[item.row][item.block],
                                       notes[task]);
            }
        });
        for (std::uint64_t n : changed) entriesChanged_ += n;
        for (const auto& some : notes) table_.note(some);
        for (const auto& some : occluders) table_.noteOccluders(some);
    }
    for (RowBuilder& builder : builders_) rays_ += builder.takeRayCount();
    blocksVisited_ += items.size();
    if (dirty_.count() == 0) moved_.clear(), movedWhen_.clear();
    return items;
}

} // namespace penumbra
