// Light that patches send to each other.
#pragma once

#include "base/BoundsTree.h"
#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/RowTable.h"
#include "radiosity/schedule/RowUpdates.h"
#include "radiosity/transport/IndirectSenders.h"
#include "radiosity/transport/PatchMatch.h"
#include "radiosity/transport/Reach.h"
#include "radiosity/transport/SceneChange.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

class DirectLight;
class RowCarrying;

/// Southwell relaxation over the rows of the patches and of their clusters. R = E + rho F S - S
/// always holds for the rows as they are, where E is what patches reflect of the direct light; a
/// cluster reflects the area-weighted mean of what its patches do.
class IndirectLight {
public:
    /// \param memory   that the process may take [bytes], see RowRoom.h. All must outlive this.
    /// \param clusters see SolverOptions
    IndirectLight(const PatchSet& set, const RayScene& rays, const DirectLight& direct,
                  const NodeHits& nodeHits, std::size_t memory, bool clusters);

    /// Takes what still holds from the rows of another meshing, which are used up, and what has
    /// been sent through them. \pre nothing was done here as yet
    void takeOver(IndirectLight& before, const PatchMatch& match);

    void add(std::span<const ObjectId> objects); ///< see Solver
    void apply(const SceneChange& change);
    void invalidate(const Bounds& region); ///< see LitScene
    /// The direct light of patches is not what it was. \param litChanged see takeLitChanged()
    void directChanged(bool litChanged);

    /// Brings rows up to date: a piece of work of about `effort` rays; false: there is none left.
    /// \param enough what may stay dirty [lm/m^2], see DirtySet::next()
    /// \pre what nodes see is up to date
    bool update(std::size_t effort, double enough);
    /// Relaxes: serves about `effort` rays' worth of receivers. \pre update() has nothing to do
    /// \param target certificate that is wanted [lm/m^2]
    /// \return false: nobody owes enough to matter for it
    bool relax(std::size_t effort, double target);
    /// Builds rows of patches that light reaches but that have nothing to send: row sums are to be
    /// those of the scene and not of its history. \return false: there is none left
    bool complete(std::size_t effort);
    bool relaxing() const { return shot_ || listing_; } ///< a batch of shots is on its way
    bool residualsStale() const { return residualsStale_; }

    /// Indirect illuminance at the nodes, the ambient term included [lux].
    std::vector<glm::dvec3> nodes() const;
    /// What a patch sends in the mean if nothing is owed any more: rho * H [lm/m^2].
    glm::dvec3 reflected(std::uint32_t index) const;

    /// See DirtySet.
    void setPolicy(std::shared_ptr<SchedulingPolicy> policy) {
        updates_.dirty().setPolicy(std::move(policy));
    }

    double residual() const { return most_; } ///< max |R| [lm/m^2]
    /// Bound of |B_exact - B|, with what dirty blocks may change [lm/m^2].
    double certificate() const { return certificate_; }
    /// Bound of what dirty blocks may change in what any patch receives and reflects [lm/m^2].
    double dirtyBound() const { return dirtyBound_; }
    /// What a residual of this size leaves is larger by light that goes round: 1 / (1 - max rho).
    double gain() const { return gain_; }
    double meanRadiosity() const { return meanRadiosity_; }
    std::uint64_t shots() const { return shots_; }
    std::uint64_t blocksServed() const { return served_; } ///< by shots
    /// Of all rows, that have entries; goes through them.
    std::uint64_t blocksKept() const;

    const IndirectSenders& senders() const { return senders_; }
    const RowTable& rows() const { return table_; } ///< one a sender
    std::size_t rowBytes() const { return rowBytes_; }
    std::size_t rowRoom() const { return rowRoom_.value_or(0); } ///< what they may take [bytes]
    bool rowsMissing() const { return rowsMissing_; }            ///< some rows were not kept
    std::size_t rowsNotKept() const;
    /// Share of the senders that light reaches whose rows row sums know of, a batch on its way in
    /// part; in [0, 1].
    double knownShare() const;
    const RowUpdates& updates() const { return updates_; }
    bool reached(std::uint32_t node) const { return reach_.node(node); } ///< see Reach
    /// Whose wall hides a block of nodes from a sender altogether, if any does: a function of poses
    /// alone. There are no entries then.
    ObjectId hiddenBy(std::uint32_t sender, std::uint32_t block) const;
    const RayCount& buildRays() const { return buildRays_; } ///< of rows that were built whole

private:
    /// Of a block with a sender of a batch.
    struct Link {
        std::uint32_t sender; ///< index into those of the batch
        std::uint32_t slot;   ///< of the block in the row, if none was opened since
    };
    /// A batch of senders on its way: receivers are served block by block.
    struct Shot {
        std::vector<std::uint32_t> senders;
        std::vector<std::vector<glm::dvec3>> light; ///< what cells of each send [lm/m^2]
        std::vector<SentLight> sent;                ///< the same, as entries read it
        std::vector<std::uint8_t> fresh, build;     ///< first time; row is not there
        bool dark = false;                          ///< nothing is sent, only rows are built
        std::vector<std::vector<Link>> receivers;   ///< a block each
        std::size_t next = 0;                       ///< block: those before it are served
        std::size_t bytes = 0;
    };
    /// A batch of senders of which it is being found out, a piece at a time, whom they serve.
    struct Listing {
        std::vector<std::uint32_t> senders;
        bool dark = false;
        std::size_t next = 0;                           ///< index into `senders`
        std::vector<std::vector<std::uint32_t>> linked; ///< to senders without a row, one each
        std::vector<std::vector<Link>> receivers;       ///< as of Shot
    };
    /// What serving some blocks has built of rows: who blocks what of them, and whose walls hide
    /// blocks.
    struct Served {
        std::size_t bytes = 0;
        std::vector<RowTable::BlockerNote> blockers, occluders;
        RayCount rays;
    };
    /// What a block has received from a sender [lm/m^2], and whether its row sums know of it.
    struct Arrived {
        std::vector<glm::dvec3> light; ///< by the sender's cells
        bool known = false;
    };
    /// What an update changes at a node, and at the nodes of a block.
    struct NodeDelta {
        std::uint32_t node = 0;
        double factor = 0;
        glm::dvec3 light{}; ///< [lux]
    };
    struct BlockDelta {
        std::vector<NodeDelta> nodes;
        bool known = false; ///< row sums know of the sender
    };
    int updateBlock(RowBuilder& builder, const DirtyBlock& item, std::span<const MovedObject> moved,
                    BlockDelta& delta);
    Arrived arrivedAt(std::uint32_t row, std::uint32_t block) const;
    RowUpdates::RowFacts factsOf(std::uint32_t sender) const;
    std::size_t blockCount() const { return set_.nodes.size() / PatchSet::kBlock; }
    void placeNodes(std::span<const BlockMask> masks);
    void growSenders();
    bool isPlanar(std::uint32_t index) const;
    void linkSender(std::uint32_t sender);
    void linkBlock(std::uint32_t block);
    void link(ObjectId object);
    std::vector<BlockMask> nodesOf(const SceneChange& change) const;
    void markRows(std::span<const std::uint32_t> senders);
    ReceiverBlock receiversOf(std::uint32_t sender, std::uint32_t block) const;
    void placeStands(ObjectId object);
    ObjectId hiddenBy(std::uint32_t sender, std::uint32_t block,
                      std::span<const MovedObject> moved) const;
    std::vector<std::uint32_t> keptFor(const IndirectSenders& senders,
                                       const PatchMatch& match) const;
    void carryOccluders(std::uint32_t sender, std::span<const RowTable::BlockerNote> were,
                        const RowCarrying& carrying, std::vector<BlockMask>& anew);
    void takeReached(const IndirectLight& before, const PatchMatch& match);
    void receiveAgain();
    void updateReach();
    void updateSendersReached();
    void listForgotten();
    bool isOnItsWay(std::uint32_t sender) const;
    void forgetSome(std::size_t effort);
    void forget(std::uint32_t sender);
    void restart();
    void describeReceivers();

    std::vector<std::uint32_t> chooseSenders(double enough) const;
    std::size_t batch() const; ///< senders shot at a time
    void choose(std::vector<std::uint32_t> senders, bool dark);
    void list(std::size_t effort);
    void load(Listing& listing);
    void serve(std::size_t effort);
    void serveBlock(std::uint32_t block, std::optional<PatchRowBuilder>& builder, Served& served);
    void buildBlock(std::uint32_t s, std::uint32_t b, PatchRowBuilder& builder, RowBlock& block,
                    Served& served);
    void serveLink(std::uint32_t i, std::uint32_t b, const RowBlock& block);
    void finishShot();
    void residualsChanged();
    void allChanged();
    void noteBatch(const Shot& shot);
    void noteSenders(const SceneChange& change);
    void noteReached(const Reach& now);
    std::vector<std::uint8_t> staleSenders(bool all, std::span<const double> dirtyDirect);
    void updateResiduals();
    void updatePatch(std::uint32_t index);
    void sumPatch(std::uint32_t index);
    void bound(std::span<const std::uint8_t> stale);
    void coloursChanged();
    glm::dvec3 node(std::uint32_t index) const;
    bool isWhole(std::uint32_t index) const;
    SenderLight cellsOf(const std::vector<glm::dvec3>& cells, std::uint32_t sender) const {
        const Range own = senders_.cells(sender);
        return std::span(cells).subspan(own.first, own.count);
    }
    std::span<glm::dvec3> cellsOf(std::vector<glm::dvec3>& cells, std::uint32_t sender) const {
        const Range own = senders_.cells(sender);
        return std::span(cells).subspan(own.first, own.count);
    }
    void reflect(std::uint32_t index, std::span<glm::dvec3> cells) const;
    void reflectDirect(std::span<std::uint8_t> stale);
    void reflectDirect(std::uint32_t index, std::span<glm::dvec3> cells) const;
    void averageClusters(ObjectId object);
    bool sends(std::uint32_t index) const;
    double dirtyOver(std::uint32_t index) const;
    double dirtyAt(std::uint32_t index) const;
    glm::dvec3 ambient() const;

    const PatchSet& set_;
    const RayScene& rays_;
    const DirectLight& direct_;
    const NodeHits& nodeHits_;
    std::size_t memory_;
    IndirectSenders senders_;
    /// Boxes of the nodes where nothing covers them, block by block: what is linked. Blocks that
    /// are handed out have that of the block they are handed out for (PatchParts::sourceBlock).
    BoundsTree linkBoxes_;
    /// Around the patches at the nodes of each block, as the mesh has them: nodes stand on these,
    /// whatever covers or parts them. Where a wall hides all of it from a sender there are no
    /// entries, so that other rooms cost nothing; who hides it is noted in the table.
    std::vector<Bounds> stands_;
    RowTable table_;
    RowUpdates updates_;
    std::vector<std::uint32_t> nodeKeys_; ///< addresses
    Reach reach_;
    std::uint64_t reachRevision_ = 0;          ///< of the node hits that it is made of
    std::vector<std::uint8_t> sendersReached_; ///< 1: light gets to any of a sender
    std::vector<std::uint32_t> forgotten_;     ///< senders that are to be, see forget()
    bool reachStale_ = true, residualsStale_ = true, directStale_ = true;
    std::vector<std::uint8_t> planar_; ///< of patches: samples lie in one plane
    std::vector<float> reflectances_;  ///< largest, a block of nodes each
    bool described_ = false;           ///< whether updates_ knows the receivers as they are

    std::vector<glm::dvec3> nodes_; ///< [lux]
    std::vector<double> rowSums_;   ///< of F V over the senders whose rows are known, a node each
    std::vector<glm::dvec3> sent_;  ///< S of every cell of every sender [lm/m^2]
    std::vector<glm::dvec3> now_;   ///< E + rho F S, likewise [lm/m^2]
    std::vector<glm::dvec3> residuals_; ///< R, likewise [lm/m^2]
    /// Of each sender: bound of what it owes to any receiver, and the most that a cell owes
    /// [lm/m^2].
    struct Owed {
        double toAny = 0, most = 0;
    };
    std::vector<Owed> owed_;
    /// Of patches: bounds of what they owe, and what they send in the mean [lm/m^2].
    struct PatchBound {
        /// Over those that are not far, and those that are (see Patch).
        struct Sums {
            double area = 0, reflectingArea = 0, radiosity = 0;
            glm::dvec3 owed{0}, reflected{0};
            void add(const Sums& other);
        };
        double dirtyDirect = 0, dirty = 0, both = 0;
        std::array<Sums, 2> sums;
        void add(const PatchBound& other);
    };
    std::vector<PatchBound> patchBounds_;
    std::vector<PatchBound> groupBounds_; ///< of some patches each, added up
    PatchBound bounds_;                   ///< of all
    /// Since the residuals were known: blocks whose nodes changed (1), and senders; or anything.
    std::vector<std::uint8_t> changedBlocks_;
    std::vector<std::uint32_t> changedSenders_;
    bool allStale_ = true;
    /// What the residuals know of dirty blocks: light and factor of a block of nodes, and what may
    /// change in the direct light of a patch.
    std::vector<std::pair<double, double>> dirtyBlocks_;
    std::vector<double> dirtyDirect_;
    std::vector<glm::dvec3> colours_;         ///< reflectances, likewise
    std::vector<glm::dvec3> reflectedDirect_; ///< of direct light, unless directStale_ [lm/m^2]
    std::vector<std::uint8_t> known_;         ///< rows that are part of rowSums_
    std::vector<std::uint8_t> expects_;       ///< 1: has not shot since an edit, see load()
    std::vector<std::uint8_t> kept_;          ///< rows that are in the table
    bool rowsMissing_ = false;                ///< some of those were not kept
    bool completed_ = false; ///< all rows were known at one time; few are not since
    std::size_t rowBytes_ = 0;
    std::optional<std::size_t> rowRoom_; ///< what they may take, once the first is built
    std::unique_ptr<Listing> listing_;   ///< never at the same time as shot_
    std::unique_ptr<Shot> shot_;
    std::vector<std::vector<Link>> lists_; ///< empty: a shot's, kept for their memory
    RayCount buildRays_;
    std::uint64_t shots_ = 0, served_ = 0;
    double most_ = 0, dirtyBound_ = 0, gain_ = 1, certificate_ = 0, meanRadiosity_ = 0;
};

} // namespace penumbra
