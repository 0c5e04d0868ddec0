// Bringing rows up to date, a bounded piece of work at a time.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/RowBuilder.h"
#include "radiosity/rows/RowTable.h"
#include "radiosity/schedule/ChangeProbe.h"
#include "radiosity/schedule/DirtySet.h"

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// The dirty blocks of a RowTable. A row takes in all edits since its last update at once: of
/// several poses of one object only the last counts. What an edit concerns is found for all rows
/// before any of it is worked on, the most promising first; what matters too little is deferred
/// (DirtySet). A block is updated in the scene as it is then, so edits may come at any time.
class RowUpdates {
public:
    /// Nothing is dirty at first. All must outlive this.
    /// \param blockObjects whose receivers are in each block of the table
    /// \param costs a visit's is that of probing a block and retesting some of it
    RowUpdates(const PatchSet& set, const RayScene& rays, RowTable& table,
               const std::vector<ObjectId>& blockObjects, const DirtySet::Costs& costs);
    RowUpdates(const RowUpdates&) = delete;
    RowUpdates& operator=(const RowUpdates&) = delete;

    /// The table has more rows than before. They have nothing to catch up with.
    void grow();
    /// Objects were posed anew, hidden or shown; receivers lie elsewhere. Their own receivers are
    /// to be among these. What crosses one of the regions is to be evaluated anew [m, world].
    void add(std::vector<ObjectId> objects, std::vector<BlockMask> receivers,
             std::vector<Bounds> regions = {});
    /// A row that is built in the scene as it is now has nothing to catch up with.
    void setCurrent(std::size_t row) { table_.edits(row) = edits_; }
    /// A row is not kept: its dirty blocks are forgotten.
    void drop(std::uint32_t row) { dirty_.drop(row); }

    /// What has to be known of a row to find what concerns it.
    struct RowFacts {
        bool known = false; ///< rows that are not known need no update
        Bounds box;         ///< of the sender's samples [m, world]
        ObjectId object;
        float area = 0;               ///< of the sender [m^2]
        glm::vec3 centre{}, normal{}; ///< of a planar sender; else the normal is zero
        /// Entries have at least this form factor: pairs of less but `none` may have one of it.
        float least = 0, none = 0;
        RowTable::Hiding hidden = {};
        /// What is asked for of each block; empty: the boxes of the table [m, world].
        std::span<const Bounds> boxes = {};
    };
    using Facts = std::function<RowFacts(std::uint32_t row)>;
    /// Updates one block; returns the number of entries that changed. `moved`: all that may have
    /// changed for it.
    using Update = std::function<int(RowBuilder& builder, const DirtyBlock& item,
                                     std::span<const MovedObject> moved, std::size_t index)>;
    /// Says what to expect of a block, if the policy probes; called on several threads.
    using Expect = std::function<ExpectedFactors(ChangeProbe& probe, const DirtyBlock& item,
                                                 std::span<const MovedObject> moved)>;
    /// Does a piece of about `effort` rays' worth: finds what edits concern, or works on it.
    /// \param enough what may stay dirty, see DirtySet::next()
    /// \param update called for each item on several threads; `index` counts from 0
    /// \return the items that were worked on, valid until the next call
    std::span<const DirtyBlock> work(std::size_t effort, double enough, const Facts& facts,
                                     const Update& update, const Expect& expect = {});
    /// Blocks that some row has found to be hidden from it since this was called last: where they
    /// had no entries there is nothing to be done.
    std::vector<std::uint32_t> takeHidden() { return std::exchange(hidden_, {}); }
    /// Most items that work() returns for an effort.
    std::size_t mostItems(std::size_t effort) const { return effort / costs_.visit + 1; }

    /// Finds all that edits concern.
    void findAll(const Facts& facts) {
        while (!found()) find(kAll, facts);
    }
    /// Entries of a row that are to be evaluated anew, whatever edits concern.
    void mark(std::uint32_t row, const Facts& facts, std::span<const BlockMask> masks);

    /// Whether all that edits concern is known, and so in the dirty set.
    bool found() const { return row_ == table_.size(); }
    /// Whether there is nothing to do but what may stay dirty.
    bool done(double enough) const { return found() && !dirty_.pending(enough); }
    /// Share of the work found since the last edit that is done, in [0, 1].
    double share() const;

    DirtySet& dirty() { return dirty_; }
    const DirtySet& dirty() const { return dirty_; }
    const RayCount& rays() const { return rays_; }
    std::uint64_t blocksVisited() const { return blocksVisited_; }
    std::uint64_t entriesChanged() const { return entriesChanged_; }

private:
    static constexpr std::size_t kAll = std::size_t(1) << 40; ///< [rays]
    struct Edit {
        std::vector<ObjectId> objects;
        std::vector<BlockMask> receivers;
        std::vector<Bounds> regions;
    };
    void find(std::size_t effort, const Facts& facts);
    void allFound();
    void choose(std::size_t effort, double enough, const Expect& expect);
    std::size_t probe(const Expect& expect);
    void uniteParts();
    std::vector<Range> tasks() const;
    /// What is searched at a time: all of a row, or some blocks of one with very many.
    struct Search {
        std::uint32_t row = 0;
        bool last = true; ///< of its row
        RowFacts facts;
        const PendingChange* change = nullptr;
        RowTable::Blocks blocks;
        std::size_t most = 0; ///< that may be found
        std::vector<DirtyBlock> found;
        std::vector<RowTable::BlockerNote> hidden; ///< blocks, and who hides them
    };
    ObjectId hidden(const Search& search, const BlockMask& mask,
                    std::map<std::uint32_t, ObjectId>& objects) const;
    bool nextSearch(Search& search, std::size_t run, const Facts& facts);
    void find(Search& search) const;
    float factorBound(const DirtyBlock& item, const RowFacts& facts) const;
    const PendingChange& changeSince(std::uint32_t edits);
    std::span<const MovedObject> movedSince(std::uint32_t edits) const;

    const PatchSet& set_;
    const RayScene& rayScene_;
    RowTable& table_;
    const std::vector<ObjectId>& blockObjects_;
    DirtySet::Costs costs_;
    std::uint32_t edits_ = 0;      ///< so far
    std::vector<Edit> unreported_; ///< the last of them: not all rows know of them
    std::size_t row_ = 0;          ///< rows before it know of all edits
    std::uint32_t block_ = 0;      ///< of row_, if it is searched run by run
    std::map<std::uint32_t, PendingChange> changes_; ///< for rows that know of so many edits
    std::vector<MovedObject> moved_;       ///< since the dirty set was empty; the last moved last
    std::vector<std::uint32_t> movedWhen_; ///< the last edit that moved each of them
    DirtySet dirty_;
    std::vector<DirtyBlock> items_, unseen_; ///< to be worked on; to be probed
    std::vector<RowBuilder> builders_;
    std::vector<ChangeProbe> probes_;
    std::vector<std::uint32_t> hidden_;
    RayCount rays_;
    std::uint64_t blocksVisited_ = 0, entriesChanged_ = 0;
    std::size_t toDo_ = 0; ///< blocks that were dirty when the last edit had been found
};

} // namespace penumbra
