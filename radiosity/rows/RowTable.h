// The rows of one kind of sender, and how to find what an edit changes in them.
#pragma once

#include "base/BoundsTree.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/Row.h"
#include "radiosity/rows/RowBuilder.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace penumbra {

/// Receivers of one block.
struct BlockMask {
    std::uint32_t block = 0;
    std::uint64_t receivers = 0; ///< bits
};
/// One entry a block, in order; bits of the same block are united.
void unite(std::vector<BlockMask>& masks);

/// What changed for a row since it was last brought up to date.
struct PendingChange {
    std::vector<MovedObject> moved;
    std::vector<BlockMask> receivers; ///< to be evaluated anew, one entry a block, in order
    /// Blocks whose shaft meets one of these are evaluated anew [m, world].
    std::vector<Bounds> regions = {};

    bool moves(std::uint32_t object) const;
};

/// All emitters onto the vertices, or all patches onto the nodes.
///
/// What an edit changes in a row is found without reading its entries: old shadows by lists of the
/// blocks in which each object is a recorded blocker, or has a wall that hides receivers
/// altogether (Walls), new ones by the shafts between the sender and a hierarchy of the blocks.
class RowTable {
public:
    explicit RowTable(std::size_t rows = 0)
        : rows_(rows), known_(rows), blockers_(rows), occluders_(rows) {}

    std::size_t size() const { return rows_.size(); }
    /// Adds empty rows at the end.
    void grow(std::size_t rows) {
        rows_.resize(rows), known_.resize(rows), blockers_.resize(rows), occluders_.resize(rows);
    }
    Row& operator[](std::size_t row) { return rows_[row]; }
    const Row& operator[](std::size_t row) const { return rows_[row]; }
    const std::vector<Row>& rows() const { return rows_; }

    /// Boxes of the receivers, block by block [m, world].
    BoundsTree& blocks() { return blocks_; }
    const BoundsTree& blocks() const { return blocks_; }

    /// How many edits a row has taken in.
    std::uint32_t& edits(std::size_t row) { return known_[row]; }

    /// An object that blocks something in a block of a row.
    struct BlockerNote {
        std::uint32_t row, block, object;
    };
    /// Lists the objects that are blockers in a block.
    static void listBlockers(std::uint32_t row, std::uint32_t block, const RowBlock& entries,
                             std::vector<BlockerNote>& notes);
    /// Remembers them. Notes may repeat themselves.
    void note(std::span<const BlockerNote> notes) { insert(blockers_, notes); }
    /// Remembers objects with a wall that hides receivers of a block, which have no entry.
    void noteOccluders(std::span<const BlockerNote> notes) { insert(occluders_, notes); }
    /// A row has been built: its notes take no more memory than they need.
    void fit(std::uint32_t row) { blockers_[row].shrink_to_fit(), occluders_[row].shrink_to_fit(); }
    /// Of a row: by block.
    std::vector<BlockerNote> occluders(std::uint32_t row) const;
    /// Takes out all entries of a row, and all notes of it.
    void clear(std::uint32_t row) {
        rows_[row].clear(), blockers_[row].clear(), occluders_[row].clear();
    }

    /// Some blocks of a row, first ... end - 1.
    struct Blocks {
        std::uint32_t first = 0, end = 0xffffffffu;
    };
    /// Who hides all that is within a box from a sender altogether [m, world]; invalid: nobody is
    /// known to. Empty: nobody ever does.
    using Hiding = std::function<ObjectId(const Bounds& box)>;
    /// Those of them that a change concerns, in order, with the entries to be evaluated anew.
    /// \param sender box around the sender's samples [m, world]
    /// \param object the sender's
    /// \param hidden of the sender: what is hidden from it throws no shadow of its light
    std::vector<BlockMask> concerned(std::size_t row, const Bounds& sender, ObjectId object,
                                     const PendingChange& change, Blocks blocks,
                                     const Hiding& hidden = {}) const;
    /// Forgets who hid receivers of them before a change: they are evaluated anew.
    void forgetOccluders(std::size_t row, ObjectId object, const PendingChange& change,
                         Blocks blocks);

private:
    using Keys = std::vector<std::uint64_t>; ///< object << 32 | block, sorted
    static void insert(std::vector<Keys>& lists, std::span<const BlockerNote> notes);
    template <class Visit>
    static void forEachOf(const Keys& list, std::uint32_t object, Blocks blocks, Visit visit);
    void crossed(const Row& row, Blocks blocks, const Bounds& sender, const Bounds& box,
                 std::uint64_t receivers, std::vector<BlockMask>& masks) const;

    std::vector<Row> rows_;
    std::vector<std::uint32_t> known_;
    std::vector<Keys> blockers_, occluders_; ///< a row each
    BoundsTree blocks_;
};

} // namespace penumbra
