// Patches that other things cut through, and nodes at which they stand.
#pragma once

#include "radiosity/mesh/Contact.h"
#include "radiosity/mesh/NodePatches.h"
#include "radiosity/mesh/PatchGeometry.h"
#include "radiosity/mesh/PatchSet.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace penumbra {

/// Follows what contacts make of patches. Elements of a patch that do not hang together any more,
/// for a partition stands across it, become patches of their own, its parts. A node at a vertex
/// that the elements around do not share is split: each patch has its own there. So no light is
/// interpolated through a partition, nor sent by its dark side.
///
/// The result depends on the contacts as they stand and not on how they came about, apart from
/// which of the patches and nodes that are handed out stand for which parts.
class Parting {
public:
    /// Hands out as many patches and nodes as there are needed now, and makes room for more.
    /// \param fans of the mesh without contacts \param wholes patches that contacts concern
    Parting(PatchSet& set, const Fans& fans, std::span<const std::uint32_t> wholes);

    /// An object came to the set and to the fans.
    void add(ObjectId object);

    struct Change {
        std::vector<std::uint32_t> patches; ///< that send from elsewhere, or not, or begin to
        std::vector<std::uint32_t> nodes;   ///< that lie elsewhere, or are new or given back
        std::vector<std::uint32_t> wholes;  ///< of which vertices are interpolated otherwise
    };
    /// Contacts of elements of these patches of the mesh are not what they were, or their object
    /// was posed anew.
    Change update(std::span<const std::uint32_t> wholes);

    /// Whether there were not enough patches or nodes: what they would have been for is as if
    /// nothing parted it. The scene is to be meshed anew.
    bool exhausted() const { return exhausted_; }

private:
    /// Elements that hang together, ascending, and the part of the patch that they span.
    struct Group {
        std::vector<std::uint32_t> elements;
        PatchRectangle spans;
    };
    /// Nodes of a whole patch that were handed out, each by what it stands for: element * 4 +
    /// corner, or kMiddle + the first element of a part.
    using OwnNodes = std::unordered_map<std::uint64_t, std::uint32_t>;

    bool follow(std::uint32_t whole);
    bool touched(std::uint32_t whole) const;
    std::vector<Group> groupsOf(std::uint32_t whole) const;
    std::vector<std::uint32_t> takeParts(std::uint32_t whole, std::size_t count);
    void giveBackParts(std::uint32_t whole, std::size_t left);
    void makePart(std::uint32_t slot, std::uint32_t whole, const Group& group, std::uint32_t first);
    void placeVertices(std::uint32_t whole);
    PatchCoordinate placeIn(std::uint32_t whole, std::uint32_t element, std::size_t corner) const;
    PatchCoordinate placeOf(std::uint32_t shared) const;
    void placeNodes(std::uint32_t whole, std::uint32_t patch, const Group& group);
    std::uint32_t sharedNode(std::uint32_t whole, std::uint32_t vertex) const;
    Receiver middleOf(std::uint32_t whole, const NodePlaces& places) const;
    std::uint32_t ownNode(std::uint32_t whole, std::uint64_t key, const Receiver& place);
    void giveBackNodes(std::uint32_t whole);
    void setNode(std::uint32_t node, const Receiver& place);
    bool usesNode(std::uint32_t whole, std::uint32_t node) const;
    void findUnusedNodes(std::uint32_t whole);
    void addPatch();
    void addBlock();
    std::uint32_t takeNode(std::uint32_t whole);

    PatchSet& set_;
    const Fans& fans_;
    NodePatches nodePatches_;
    std::vector<PatchRectangle> spans_; ///< of each patch that is handed out
    std::vector<std::uint32_t> freePatches_, freeBlocks_;
    /// Free nodes of the blocks that are in use, by the block that the middles of their patches
    /// are in.
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> freeNodes_;
    std::unordered_map<std::uint32_t, OwnNodes> own_; ///< by whole patch
    OwnNodes before_;                                 ///< of the one that is followed now
    std::unordered_set<std::uint32_t> touched_;       ///< whole patches that anything touches
    bool growing_ = true, exhausted_ = false;
    Change change_;
};

} // namespace penumbra
