// Light on its way from the solver to a store.
#pragma once

#include "radiosity/process/store/LightStore.h"
#include "radiosity/process/store/RoughLight.h"
#include "radiosity/transport/LitScene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

/// Keeps a store true to a LitScene: remembers which blocks are not as they were published, and
/// writes these, a bounded number at a time.
class LightPublisher {
public:
    /// \param scene must outlive this, and not be meshed anew: objects that are added are told by
    /// grow()
    explicit LightPublisher(LitScene& scene);

    /// Where to publish from now on: everything.
    void setStore(std::unique_ptr<StoreWriter> store);
    bool hasStore() const { return store_ != nullptr; }
    /// Whether there are more blocks than the store has room for: it needs another one.
    bool outgrown() const;
    std::uint32_t blockCount() const;
    /// More of the mesh. \pre hasStore()
    void addMesh(RegionPtr region, std::uint64_t number, std::span<const std::byte> mesh) {
        store_->add(std::move(region), number, mesh);
    }

    /// Lights of which each one's own part is published as well, see RadiosityNode.
    /// \param serial of this set, not 0
    void setPreviewLights(std::uint32_t serial, const std::vector<std::string>& paths);
    /// Finds what of their rows, and of those of other lights, is dirty. \return false: there may
    /// be more. Work that the solver defers does not count: what it may change is within the
    /// tolerance of the whole picture, and may take long to come.
    bool findStale();
    /// Whether all that was found to be stale has been published as such.
    bool staleShown() const { return staleToShow_ == 0; }

    /// Objects were added to the patches.
    void grow();
    /// Until the direct light is known this is published, of the objects that there are now.
    void showRough(RoughLight light);
    bool isRough() const { return !rough_.empty(); }
    /// Whether there is anything that may be published.
    bool hasLight() const { return objectsLit_ > 0; }
    /// All direct light is known, that of objects which were added included: they are published
    /// from now on.
    void directIsDone();
    /// An edit was taken in.
    void follow(const SceneChange& change);
    /// The solver has worked: compares the blocks of direct light that it reported as changed.
    void directWorked();
    /// Compares all light. \param settled all light is as it will stay
    void solverWorked(bool settled);
    /// Publishes at most so many blocks, the last touched first. Those whose direct light is being
    /// summed come later, for it has to fit the factors of lights. \return false: there was none
    bool publish(std::size_t most);
    std::size_t left() const { return left_.size(); }
    /// Publishes the dirty set, in time that goes with its size; nobody need call it.
    /// \param question see StoreHeader::dirtyFor
    void publishDirty(std::uint32_t question);

private:
    void noteBlock(std::uint32_t patch, std::uint32_t block);
    void markPatches(std::vector<DirtyStatus>& work) const;
    void take(const ObjectPart& object);
    void take(std::uint32_t vertex);
    void touch(std::uint32_t block);
    void touchAll();
    void touchStale(std::uint32_t block);
    bool canPublish(std::uint32_t block) const;
    void nodesChanged(bool exact);
    LightBlock blockOf(std::uint32_t block) const;
    Rgb interpolatedAt(std::uint32_t vertex) const;
    Rgb indirectAt(std::uint32_t vertex) const;
    void writeCorners(std::uint32_t block, LightBlock& light) const;
    void writeLights(std::uint32_t block, LightBlock& light) const;

    struct LightRows {
        std::vector<std::uint32_t> emitters;
        std::vector<std::uint32_t> stale; ///< dirty blocks, in order
    };
    void findStale(LightRows& rows);

    LitScene& scene_;
    std::unique_ptr<StoreWriter> store_;
    std::vector<std::uint32_t> elementNumber_;            ///< see numberElements()
    std::vector<std::vector<std::uint32_t>> patchBlocks_; ///< by patches of the mesh
    std::size_t objects_ = 0, objectsLit_ = 0;            ///< that are known; that may be published
    std::vector<glm::dvec3> nodes_;                       ///< illuminance that is published [lux]
    RoughLight rough_;                                    ///< its parts, until others are known
    std::vector<Rgb> detail_; ///< what fine shadows added when it was settled last [lux]
    std::uint32_t previewSet_ = 0;
    std::vector<std::string> previewed_; ///< paths of that set
    std::size_t emitters_ = 0;           ///< that were there then
    std::vector<LightRows> lights_;      ///< previewed ones,
    LightRows others_;                   ///< and all that are not
    enum class Touched : std::uint8_t { no, yes, stale };
    std::vector<std::uint32_t> left_;
    std::vector<Touched> touched_;
    std::size_t staleToShow_ = 0; ///< blocks that are Touched::stale
};

} // namespace penumbra
