// Lit geometry made from a store, and kept as it says.
#pragma once

#include "radiosity/process/store/LightStore.h"
#include "radiosity/process/store/LitMesh.h"
#include "radiosity/process/store/PublishedGeometry.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// The objects of one store: read one after the other, then lit block by block. An object is there
/// when all blocks that it had from the start have light. One that comes later takes the place of
/// another of its path once it is there.
class LitObjects {
public:
    using Colour = std::function<LitMaterial(const LitMeshMaterial&)>;

    /// Which previewed lights the light of blocks is to be about: a serial number, how many.
    struct Lights {
        std::uint32_t set = 0;
        std::size_t count = 0;
    };
    LitObjects(std::shared_ptr<StoreReader> store, const Lights& lights);
    void setLights(const Lights& lights);

    /// Takes in what is new, for some milliseconds at most. \throws Error if it makes no sense
    void take(const Colour& colour);
    /// Colours are to be asked for again.
    void recolour(const Colour& colour);
    /// Reads the dirty status of all blocks. \param question that was asked
    void takeDirty(std::uint32_t question);
    /// By object, one a block of its geometry; empty: it is not known.
    const std::vector<std::vector<DirtyStatus>>& work() const { return work_; }
    bool complete() const {
        return mesh_.done() && meshes_ == store_->meshes().size() && missing_ == 0;
    }
    /// Whether there is nothing to take in.
    bool current() const { return complete() && store_->current(); }

    struct Entry {
        std::string path;
        glm::dmat4 toObject{1.0};
        std::shared_ptr<PublishedGeometry> geometry; ///< null: not all of it has light
        std::vector<EmissiveMesh> emissive;
    };
    const std::vector<Entry>& entries() const { return entries_; }
    const MeshingOptions& sizes() const { return mesh_.head().sizes; }
    std::uint64_t blocksTaken() const { return blocksTaken_; }
    /// What rays meet of all that, see readPatches(); none: it does not make sense any more.
    std::optional<PatchSet> patches() const;
    /// Rises when a geometry comes into being.
    std::uint64_t revision() const { return revision_; }

private:
    using Corners = std::array<std::uint32_t, 4>;
    /// What is needed to follow changes of the topology.
    struct Part {
        LitMeshData data;               ///< until there is a geometry
        LightShares shares;             ///< the same
        std::vector<Corners> base, now; ///< of the elements
        std::vector<std::uint32_t> firstIndex;
        std::vector<std::uint32_t> standsFor; ///< of private vertices, kNoCorner for others
        std::uint32_t missing = 0;            ///< blocks without light
        bool replaces = false;                ///< others, once it is there
        bool replaced = false;                ///< gets light no more
        std::vector<std::uint32_t> changed;   ///< elements whose indices are to be written
    };
    struct Slot {
        std::uint32_t object = kNone, block = 0; ///< block within the object
        bool lit = false;
        static constexpr std::uint32_t kNone = 0xffffffffu;
    };
    bool readMesh();
    void takeObject(const Colour& colour);
    bool replace(const std::string& path);
    void dropReplaced(const std::string& path);
    void takeBlock(const StoreReader::Got& got);
    void takePrivate(const StoreReader::Got& got, Slot& slot);
    void follow(Part& part, std::uint32_t firstVertex, const LightBlock& light);
    void standFor(Part& part, std::uint32_t vertex, std::uint32_t corner);
    void writeTriangles();
    void finish(std::uint32_t object);
    void takeShares(const LightBlock& light, std::size_t block, LightShares& shares) const;
    void edit(std::uint32_t object, const std::function<void(LitMeshData&)>& change);

    std::shared_ptr<StoreReader> store_;
    LitMeshReader mesh_;
    std::size_t meshes_ = 1; ///< of the store's, that were begun
    Lights lights_;
    std::vector<Entry> entries_;
    std::vector<Part> parts_;
    std::vector<Slot> slots_; ///< of the store's blocks
    std::vector<std::uint32_t> changedParts_;
    std::vector<StoreReader::Got> got_;
    std::vector<DirtyStatus> words_;
    std::vector<std::vector<DirtyStatus>> work_;
    std::uint64_t missing_ = 0, blocksTaken_ = 0, revision_ = 0;
};

} // namespace penumbra
