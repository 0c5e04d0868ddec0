// Bringing rows up to date, a bounded piece of work at a time.
#pragma once

#include "radiosity/PatchSet.h"
#include "radiosity/RowBuilder.h"
#include "radiosity/RowTable.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace penumbra {

/// One block of one row that edits concern.
struct UpdateItem {
    std::uint32_t row = 0, block = 0;
    std::uint64_t anew = 0; ///< bits: entries to be evaluated anew
    std::shared_ptr<const PendingChange> change;
};

/// The open work of a RowTable. A row is told of all edits since it was last looked at, at once: of
/// several poses of one object only the one where it stands now counts. An item is worked on in the
/// scene as it is then, so that edits may come at any time.
class RowUpdates {
public:
    /// Nothing is open at first. All must outlive this.
    /// \param visitCost what looking at a block and retesting some of it costs, about [rays]
    RowUpdates(const PatchSet& set, const RayScene& rays, RowTable& table, std::size_t visitCost);

    /// Objects were placed anew, hidden or shown; receivers lie elsewhere. Their own receivers are
    /// to be among these. What crosses one of the regions is to be evaluated anew [m, world].
    void add(std::vector<ObjectId> objects, std::vector<BlockMask> receivers,
             std::vector<Bounds> regions = {});
    /// A row that is built in the scene as it is now has nothing to catch up with.
    void setCurrent(std::size_t row) { table_.edits(row) = forgotten_ + edits_.size(); }

    /// What has to be known of a row to find what concerns it.
    struct RowFacts {
        bool known = false; ///< rows that are not known need no update
        Bounds box;         ///< of the sender's samples [m, world]
        ObjectId object;
    };
    using Facts = std::function<RowFacts(std::uint32_t row)>;
    /// Updates one block; returns the number of entries that changed.
    using Update =
        std::function<int(RowBuilder& builder, const UpdateItem& item, std::size_t index)>;
    /// Works on the next items, sender by sender, about `effort` rays' worth.
    /// \param update called for each item on several threads; `index` counts from 0
    /// \return the items, valid until the next call; empty: everything is up to date
    std::span<const UpdateItem> work(std::size_t effort, const Facts& facts, const Update& update);

    bool done() const { return next_ == items_.size() && row_ == table_.size(); }
    /// Share of the rows that have been looked at since the last edit, in [0, 1].
    double share() const { return table_.size() == 0 ? 1 : double(row_) / double(table_.size()); }

    const RayCount& rays() const { return rays_; }
    std::uint64_t blocksVisited() const { return blocksVisited_; }
    std::uint64_t entriesChanged() const { return entriesChanged_; }

private:
    struct Edit {
        std::vector<ObjectId> objects;
        std::vector<BlockMask> receivers;
        std::vector<Bounds> regions;
    };
    std::size_t effortOf(const UpdateItem& item) const;
    void find(std::size_t count, const Facts& facts);
    std::shared_ptr<const PendingChange> changeSince(std::uint64_t edits);

    const PatchSet& set_;
    const RayScene& rayScene_;
    RowTable& table_;
    std::size_t visitCost_, grain_; ///< [rays]; items a task
    std::vector<Edit> edits_;       ///< that not all rows have been told of
    std::uint64_t forgotten_ = 0;   ///< edits before those
    std::vector<UpdateItem> items_;
    std::size_t next_ = 0, row_ = 0;
    std::vector<RowBuilder> builders_;
    std::shared_ptr<const PendingChange> change_; ///< since edit changeFrom_, to the last one
    std::uint64_t changeFrom_ = 0;
    RayCount rays_;
    std::uint64_t blocksVisited_ = 0, entriesChanged_ = 0;
};

} // namespace penumbra
