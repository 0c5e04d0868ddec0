// All that sends indirect light: patches, and clusters of them for receivers far away.
#pragma once

#include "base/BoundsTree.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/RowBuilder.h"
#include "radiosity/rows/SenderLight.h"
#include "radiosity/transport/Clusters.h"
#include "radiosity/transport/SceneChange.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Senders of indirect light, by one index: first the patches of a PatchSet, then clusters. A block
/// of receivers takes light from the largest clusters that appear small from where it is, and from
/// single patches close by: it is *linked* to them, and to no two that have a patch in common.
///
/// Which clusters there are depends on each object in a frame of its own, what is linked on where
/// they stand: never on how they came there. Clusters are of patches as the mesh has them; one that
/// is parted does not send, its parts do in its place, and clusters send the mean of these.
class IndirectSenders {
public:
    /// `set` must outlive this. \param clusters if false there are none
    IndirectSenders(const PatchSet& set, bool clusters);

    /// Takes in an object that came to the set. \pre its number follows on the others'
    void add(ObjectId object);

    std::uint32_t count() const { return std::uint32_t(boxes_.size()); }
    std::uint32_t patchCount() const { return std::uint32_t(set_.patches.size()); }
    Range clustersOf(ObjectId object) const { return clusterRanges_[object.value]; }

    /// An object was posed anew.
    void place(ObjectId object);
    /// A patch was parted otherwise, handed out or given back.
    void placePatch(std::uint32_t patch);
    /// Finds anew who is bright, once all is placed that a change names.
    /// \return who was otherwise, ascending
    std::vector<std::uint32_t> followEmitters(const SceneChange& change);

    PatchSender sender(std::uint32_t index) const;
    /// Of every sender the one among others that sends just alike to whatever receives,
    /// ObjectId::kNone if there is none.
    std::vector<std::uint32_t> matched(const IndirectSenders& others) const;
    /// Around outline and samples [m, world].
    const Bounds& box(std::uint32_t index) const { return boxes_[index]; }
    /// Whose it is.
    ObjectId object(std::uint32_t index) const { return objects_[index]; }
    bool present(std::uint32_t index) const {
        return index < patchCount() ? set_.sends(index)
                                    : set_.objects[objects_[index].value].present;
    }
    float area(std::uint32_t index) const { return areas_[index]; }
    /// A sender is bright if a thousandth of what some emitter sends may fall on it, and glaring if
    /// three tenths may. Neither what is in the way counts, nor whether the emitter is switched on:
    /// this depends on poses alone.
    enum class Brightness : std::uint8_t { usual, bright, glaring };
    Brightness brightness(std::uint32_t index) const { return brightness_[index]; }
    /// Entries have at least this form factor, see PatchSender.
    float leastFactor(std::uint32_t index) const {
        return brightness(index) == Brightness::usual ? kLeastFactor : kLeastOfBright;
    }
    /// The cluster that has this sender, Clusters::kNone if none.
    std::uint32_t parent(std::uint32_t index) const { return parents_[index]; }
    /// The cells of a sender, see SenderLight, in a list of those of all senders.
    Range cells(std::uint32_t index) const { return cells_[index]; }
    std::uint32_t cellCount() const { return cells_.empty() ? 0 : cells_.back().end(); }
    /// Whether the cells of a patch may send unlike each other.
    bool isUneven(std::uint32_t patch) const {
        return cells_[patch].count > 1 && set_.patches[patch].elementCount > 1;
    }
    /// Fills in the quarters of the clusters. \param values one a cell; those of patches are known
    void average(std::span<glm::dvec3> values) const;
    /// The same of the clusters of an object.
    void average(ObjectId object, std::span<glm::dvec3> values) const;
    /// Fills in the other cells of an object's clusters, see SenderLight.h, and their quarters.
    /// \param direct what is reflected of direct light, one a cell; of patches it is known
    void deviate(ObjectId object, std::span<glm::dvec3> direct) const;

    /// Whether receivers in a box take light from a sender itself, and not from a part of it, nor
    /// from a larger one.
    bool linked(std::uint32_t index, const Bounds& receivers) const {
        const std::uint32_t up = parents_[index];
        return isEnough(index, receivers) && (up == Clusters::kNone || !isFar(up, receivers));
    }
    /// Blocks that are linked to a sender, ascending.
    std::vector<std::uint32_t> linkedBlocks(std::uint32_t index, const BoundsTree& blocks) const;
    /// Calls visit(sender) for all that are linked to receivers in a box.
    template <class Visit>
    void forEachLinked(const Bounds& receivers, const Visit& visit) const;

private:
    struct Family {
        Clusters clusters;
        std::uint32_t first = 0; ///< sender index of its first cluster
    };
    void listFaceClusters(Range patches);
    bool placeEmitters();
    Brightness brightnessOf(std::uint32_t index) const;
    void findBright();
    void findBright(std::uint32_t first, std::uint32_t end);
    void findBrightClusters(ObjectId object);
    void addObject(ObjectId object);
    void addFamily(std::span<const ClusterPatch> patches);
    void listChildren();
    void listQuarters(const Family& family);
    bool sendsLike(std::uint32_t index, const IndirectSenders& others, std::uint32_t other) const;
    void placePatches(Range patches);
    glm::dvec3 meanOfPatch(std::uint32_t patch, std::span<const glm::dvec3> values) const;
    void deviateCluster(std::uint32_t cluster, std::span<glm::dvec3> direct) const;
    void placeClusters(const Family& family);
    bool isFar(std::uint32_t index, const Bounds& receivers) const;
    bool isEnough(std::uint32_t index, const Bounds& receivers) const {
        return index < patchCount() || isFar(index, receivers);
    }

    const PatchSet& set_;
    bool clusters_;                    ///< whether there are any
    std::vector<Family> families_;     ///< one an object
    std::vector<Range> clusterRanges_; ///< one an object
    std::vector<Bounds> boxes_;
    std::vector<std::uint32_t> keys_, parents_;
    std::vector<float> areas_;
    std::vector<ObjectId> objects_;
    std::vector<Brightness> brightness_;
    std::vector<double> emitterAreas_; ///< [m^2]
    BoundsTree emitters_;              ///< boxes; empty: one that is hidden
    std::vector<Range> cells_;         ///< one a sender
    std::vector<glm::vec3> samples_;   ///< kPatchSamples a sender
    /// Of each cluster's parts: which patch its sample is on, and which of that one's it is.
    struct Place {
        std::uint32_t patch = 0;
        std::uint8_t sample = 0;
    };
    std::vector<Place> places_;        ///< kPatchSamples a cluster
    std::vector<SenderPart> parts_;    ///< kPatchSamples a cluster
    std::vector<std::uint32_t> faces_; ///< of a patch that is a cluster of faces: of faceParts_
    std::vector<std::array<SenderPart, kPatchSamples>> faceParts_;
    /// A patch, or a quarter of it, in a quarter of a cluster.
    struct Term {
        std::uint32_t patch = 0;
        float share = 0; ///< of the patch's area
        std::uint8_t quarter = Clusters::kWhole;
    };
    std::vector<Term> terms_;
    std::vector<std::uint32_t> firstTerm_{0};          ///< of each quarter of each cluster
    std::vector<std::uint32_t> roots_;                 ///< senders without a parent
    std::vector<std::uint32_t> firstChild_, children_; ///< of clusters: senders
};

template <class Visit>
void IndirectSenders::forEachLinked(const Bounds& receivers, const Visit& visit) const {
    if (receivers.empty()) return;
    std::vector<std::uint32_t> open = roots_;
    while (!open.empty()) {
        const std::uint32_t s = open.back();
        open.pop_back();
        if (s < patchCount()) {
            set_.forEachPart(s, visit);
            continue;
        }
        if (isFar(s, receivers)) {
            visit(s);
            continue;
        }
        const std::uint32_t c = s - patchCount();
        open.insert(open.end(), children_.begin() + firstChild_[c],
                    children_.begin() + firstChild_[c + 1]);
    }
}

} // namespace penumbra
