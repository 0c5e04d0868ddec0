// Which blocks of nodes take light from which senders, and which of these a wall hides from them.
#include "radiosity/transport/IndirectLight.h"

#include "base/Bits.h"
#include "radiosity/transport/DirectLight.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

} // namespace

ReceiverBlock IndirectLight::receiversOf(std::uint32_t sender, std::uint32_t block) const {
    const ObjectPart& part = set_.objects[set_.nodeBlockObject[block].value];
    const bool lit =
        part.present && senders_.present(sender) && senders_.linked(sender, linkBoxes_[block]);
    return {std::span(set_.nodes).subspan(block * kBlock, kBlock), lit ? reach_.nodes[block] : 0,
            std::span(nodeKeys_).subspan(block * kBlock, kBlock)};
}

/// An object is elsewhere: so is what its nodes stand on.
void IndirectLight::placeStands(ObjectId object) {
    const ObjectPart& part = set_.objects[object.value];
    stands_.resize(std::max(stands_.size(), blockCount()));
    for (std::uint32_t b = part.nodes.first / kBlock; b * kBlock < part.nodes.end(); ++b)
        stands_[b] = {};
    const auto stand = [&](std::uint32_t node, const Patch& patch) {
        Bounds& box = stands_[node / kBlock];
        box.add(set_.uncoveredNodes[node].position);
        set_.forEachCorner(patch, [&](glm::vec3 corner) { box.add(corner); });
    };
    for (std::uint32_t p = part.patches.first; p < part.patches.end(); ++p) {
        const Patch& patch = set_.patches[p];
        if (patch.elementCount == 0) continue;
        stand(patch.centreNode, patch);
        if (!patch.hasCornerNodes) continue;
        // Where a patch is split at its corners now, the mesh has them together.
        for (const std::uint32_t n :
             set_.parts.used.empty() ? patch.cornerNodes : set_.parts.cornerNodes[p])
            stand(n, patch);
    }
}

ObjectId IndirectLight::hiddenBy(std::uint32_t sender, std::uint32_t block) const {
    return direct_.walls().between(senders_.box(sender), stands_[block]);
}

/// Likewise, of walls that moved.
ObjectId IndirectLight::hiddenBy(std::uint32_t sender, std::uint32_t block,
                                 std::span<const MovedObject> moved) const {
    const Walls& walls = direct_.walls();
    if (!walls.areAmong(moved)) return {};
    for (const std::uint32_t wall : walls.beside(senders_.box(sender), stands_[block], moved))
        if (walls.isHidden(wall, senders_.box(sender), stands_[block])) return walls.objectOf(wall);
    return {};
}

void IndirectLight::placeNodes(std::span<const BlockMask> masks) {
    stands_.resize(blockCount());
    while (table_.blocks().size() < blockCount()) table_.blocks().append({});
    while (linkBoxes_.size() < blockCount()) linkBoxes_.append({});
    const auto boxOf = [](const Receiver* nodes) {
        Bounds box;
        for (std::size_t n = 0; n < kBlock; ++n)
            if (!isPadding(nodes[n])) box.add(nodes[n].position);
        return box;
    };
    const std::uint32_t firstSpare =
        set_.parts.used.empty() ? std::uint32_t(blockCount()) : set_.parts.firstNode / kBlock;
    for (const auto& [block, bits] : masks) { // ascending: those that are handed out come last
        table_.blocks().set(block, boxOf(&set_.nodes[block * kBlock]));
        if (block < firstSpare) {
            linkBoxes_.set(block, boxOf(&set_.uncoveredNodes[block * kBlock]));
            continue;
        }
        const std::uint32_t source = set_.parts.sourceBlock[block - firstSpare];
        linkBoxes_.set(block, source != Element::kNone ? linkBoxes_[source] : Bounds());
        stands_[block] = source != Element::kNone ? stands_[source] : Bounds();
        for (const std::uint32_t r : bitsOf(bits))
            nodeKeys_[block * kBlock + r] = addressOfNode(set_, block * kBlock + r);
    }
}

/// Gives the row of a sender, if there is one, the blocks that are linked to it now.
void IndirectLight::linkSender(std::uint32_t sender) {
    if (!kept_[sender]) return;
    for (std::uint32_t b : senders_.linkedBlocks(sender, linkBoxes_)) table_[sender].open(b);
}

/// Gives rows of senders that are linked to a block now this block.
void IndirectLight::linkBlock(std::uint32_t block) {
    if (linkBoxes_[block].empty()) return;
    senders_.forEachLinked(linkBoxes_[block], [&](std::uint32_t s) {
        if (kept_[s]) table_[s].open(block);
    });
}

/// An object was posed anew: links all of what it sends, and of all that it receives.
void IndirectLight::link(ObjectId object) {
    const ObjectPart& part = set_.objects[object.value];
    for (const Range own : {part.patches, senders_.clustersOf(object)})
        for (std::uint32_t s = own.first; s < own.end(); ++s) linkSender(s);
    for (std::uint32_t b = part.nodes.first / kBlock; b * kBlock < part.nodes.end(); ++b)
        linkBlock(b);
}

} // namespace penumbra
