// What the emitters give to the vertices.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/RowTable.h"
#include "radiosity/rows/SenderSamples.h"
#include "radiosity/rows/Walls.h"
#include "radiosity/schedule/RowUpdates.h"
#include "radiosity/transport/PatchMatch.h"
#include "radiosity/transport/SceneChange.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace penumbra {

class RowCarrying;

/// The rows of the emitters, and the illuminance of vertices and patches that they make. Sums run
/// over the emitters in the order of their objects' paths: they depend on the scene and not on how
/// it came about.
class DirectLight {
public:
    /// Everything is dirty at first. \param samples see SolverOptions. All must outlive this.
    DirectLight(const PatchSet& set, const RayScene& rays, int samples);

    /// Takes what still holds from the rows of another meshing, which are used up. What that one
    /// had not yet worked off, what is new and what may have changed is left dirty.
    /// \pre nothing was done here as yet
    void takeOver(DirectLight& before, const PatchMatch& match);

    void add(std::span<const ObjectId> objects); ///< see Solver
    void apply(const SceneChange& change);
    void invalidate(const Bounds& region); ///< see LitScene
    /// Brings rows up to date: a piece of work of about `effort` rays; false: there is none left.
    /// \param enough what may stay dirty [lm/m^2], see DirtySet::next()
    bool update(std::size_t effort, double enough);
    /// Sums what rows give that were brought up to date, likewise.
    bool sum(std::size_t effort) { return sumBlocks(effort) || averagePatches(effort); }
    /// Bound of what is still dirty in the mean light of patches [lux].
    std::vector<double> dirtyLight() const;
    /// See DirtySet.
    void setPolicy(std::shared_ptr<SchedulingPolicy> policy) {
        updates_.dirty().setPolicy(std::move(policy));
    }
    void rekey() { updates_.dirty().rekey(); }
    void setAging(double rays) { updates_.dirty().setAging(rays); } ///< see DirtySet
    void setWhole(bool whole) { updates_.dirty().setWhole(whole); }
    /// See Solver::narrowDirect().
    void narrow(const std::function<std::uint64_t(std::uint32_t, std::uint32_t)>& which);
    /// Sums what the rows, as they are now, give to the vertices: all of it, or about `effort`
    /// rays' worth.
    void sumUp(std::size_t effort = ~std::size_t(0));
    /// Whether the rows give to a block what its vertices have.
    bool summed(std::uint32_t block) const { return blockTouched_[block] == 0; }

    std::span<const Rgb> vertices() const { return vertices_; } ///< [lux]
    /// Form factors of an emitter at the vertices of a block, times what they see of it: as the row
    /// has them or, of a blended block, with visibility from the receivers around.
    std::array<float, PatchSet::kBlock> factors(std::uint32_t emitter, std::uint32_t block) const;
    std::span<const glm::dvec3> patches() const { return patches_; } ///< means [lux]
    /// Around each sample of a patch (see samplePatch()), if that has several elements [lux]: of
    /// the nearest element that is lit, all shifted to the patch's mean. \pre the set has nodes
    std::span<const Rgb, kPatchSamples> cells(std::uint32_t patch) const { return cells_[patch]; }
    /// Blocks of vertices that were summed anew since this was called last, each once.
    std::vector<std::uint32_t> takeSummedBlocks();
    /// Whether all that edits concern is in the dirty set.
    bool dirtyKnown() const { return updates_.found(); }
    /// Blocks, in order, of which an emitter's row is not known to be what it should be. Work that
    /// may be deferred does not count, see work().
    std::vector<std::uint32_t> dirtyBlocks(std::uint32_t emitter, double enough) const;
    std::span<const std::uint8_t> patchLit() const {
        return patchLit_;
    } ///< sees any emitter at all
    /// Whether patchLit() is not what it was when this was called last.
    bool takeLitChanged() { return std::exchange(litChanged_, false); }

    const Walls& walls() const { return walls_; } ///< where they stand now
    /// A wall that hides an emitter from a vertex altogether, see Walls; the row has no entry then.
    ObjectId wallBefore(std::uint32_t emitter, std::uint32_t vertex) const;

    /// The emitters with their visibility samples, one a row.
    std::span<const EmitterSender> senders() const { return emitters_; }
    const RowTable& rows() const { return table_; }
    const RowUpdates& updates() const { return updates_; }
    double brightest() const; ///< largest exitance [lm/m^2]

private:
    RowUpdates::RowFacts factsOf(std::uint32_t row) const;
    void carryOccluders(std::uint32_t row, const DirectLight& before, const RowCarrying& carrying,
                        const PatchMatch& match);
    std::span<const Receiver> receiversOf(std::size_t block) const;
    void placeEmitters();
    void noteBlocks(Range elements);
    void noteBlends(Range vertices);
    void placeReceivers(std::vector<BlockMask>& masks);
    void touchBlock(std::uint32_t block);
    void touchPatch(std::uint32_t patch);
    void touchBlended(std::uint32_t patch);
    template <class Visit>
    void forEachPatch(std::uint32_t block, Visit visit) const;
    void describeReceivers();
    std::uint64_t hidden(const DirtyBlock& item, std::span<const MovedObject> moved,
                         std::vector<ObjectId>& occluders) const;
    bool sumBlocks(std::size_t effort);
    bool averagePatches(std::size_t effort);
    void sumBlock(std::uint32_t block);
    template <class Visit>
    void forEachLit(std::uint32_t patch, Visit visit) const;
    void average(std::uint32_t index);
    void averageCells(std::uint32_t index);

    const PatchSet& set_;
    int samples_;
    Walls walls_;
    std::vector<EmitterSender> emitters_;
    std::vector<std::uint32_t> order_; ///< of the emitters in sums
    std::vector<Receiver> receivers_;
    std::vector<std::vector<std::uint32_t>> blockPatches_; ///< lit by the vertices of each block
    /// Of each block of receivers the blended ones whose vertices take light from these.
    std::vector<std::vector<std::uint32_t>> blockBlends_;
    RowTable table_;
    RowUpdates updates_;

    std::vector<std::uint8_t> blockTouched_, patchTouched_;
    std::vector<std::uint32_t> touchedBlocks_, touchedPatches_; ///< to be summed again
    std::vector<std::uint8_t> blockSummed_;
    std::vector<std::uint32_t> summedBlocks_;
    std::vector<Rgb> vertices_;
    std::vector<float> vertexSeen_; ///< sum of F V over all emitters
    std::vector<glm::dvec3> patches_;
    std::vector<std::array<Rgb, kPatchSamples>>
        cells_; ///< one a patch; none in a set without nodes
    std::vector<std::uint8_t> patchLit_;
    bool litChanged_ = false;
    bool described_ = false; ///< whether updates_ knows the receivers as they are
};

} // namespace penumbra
