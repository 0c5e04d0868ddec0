// Published light: blocks that the worker writes and the node reads.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/process/memory/Region.h"
#include "radiosity/process/memory/Seqlock.h"
#include "radiosity/process/store/DirtyStatus.h"
#include "radiosity/process/store/LitMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace penumbra {

constexpr std::size_t kMostPreviewLights = 8;

/// The light of one block of receivers, as it lies in shared memory. As exact as it is worked out:
/// what a viewer takes away of it again, because a shadow falls there, leaves nothing.
struct alignas(8) LightBlock {
    static constexpr std::size_t kSize = PatchSet::kBlock;

    std::uint32_t object = 0;     ///< whose block it is
    std::uint32_t previewSet = 0; ///< serial of the previewed lights of the factors; 0: none
    std::array<Rgb, kSize> direct{}, indirect{}; ///< of each vertex [lux]
    /// Of private blocks only, see PatchSet: which corner each vertex represents, see kNoCorner.
    std::array<std::uint32_t, kSize> corners{};
    /// If there are previewed lights only.
    std::uint32_t lights = 0;
    std::uint32_t stale = 0; ///< bit l: dirty for light l, or for one that is not previewed
    std::array<Rgb, kMostPreviewLights> exitance{}; ///< that `direct` was summed with [lm/m^2]
    std::array<std::array<float, kSize>, kMostPreviewLights> factor{}; ///< see LightShare
};

/// How large things are in a store.
struct StoreShape {
    std::uint64_t meshBytes = 0;
    std::uint32_t blocks = 0;       ///< there is room for
    std::uint32_t firstPrivate = 0; ///< blocks before it belong to the mesh from the start
    std::size_t bytes() const;      ///< of the whole store
};

/// Begins a store. What follows: mesh, sequence numbers, blocks, dirty status, each aligned to 64.
/// What comes to the mesh later lies in a store of its own, one without blocks.
struct StoreHeader {
    std::uint64_t magic;
    std::uint64_t number; ///< of the request
    StoreShape shape;
    std::atomic<std::uint32_t> ready;     ///< 1: the mesh is there
    std::atomic<std::uint32_t> used;      ///< blocks in use
    std::atomic<std::uint64_t> published; ///< rises with every block that is written
    /// Which question for the dirty set its table answers: a number of the node's; 0: none.
    std::atomic<std::uint32_t> dirtyFor;
    std::atomic<std::uint32_t> additions; ///< to the mesh, that are ready to be read
};

/// The worker's end.
class StoreWriter {
public:
    /// \param region zeroed, of shape.bytes()
    StoreWriter(RegionPtr region, std::uint64_t number, const StoreShape& shape,
                std::span<const std::byte> mesh);

    const StoreShape& shape() const { return shape_; }
    /// More of the mesh. \param region zeroed, of additionShape(mesh).bytes()
    void add(RegionPtr region, std::uint64_t number, std::span<const std::byte> mesh);
    void setUsed(std::uint32_t blocks);
    /// Writes a block; one that says the same as before is not written again.
    void write(std::uint32_t block, const LightBlock& light);
    /// Writes the dirty status of the first blocks, as many as there is room for; each by itself
    /// is read whole. \param question see StoreHeader::dirtyFor
    void writeDirty(std::uint32_t question, std::span<const DirtyStatus> work);

private:
    RegionPtr region_;
    StoreShape shape_;
    StoreHeader& header_;
    SharedCount* sequences_;
    SharedWord* blocks_;
    SharedWord* work_; ///< one a block, see DirtyStatus::packed()
};

/// The node's end. Nothing that is read can make it read or write elsewhere, and light that can't
/// be is none.
class StoreReader {
public:
    /// \throws Error if this is not a store of this number and of a size that fits the region
    StoreReader(RegionPtr region, std::uint64_t number);

    const StoreShape& shape() const { return shape_; }
    /// The mesh, and what has come to it since, in order.
    const std::vector<std::span<const std::byte>>& meshes() const { return meshes_; }
    /// More of the mesh: a store of its own.
    void add(std::shared_ptr<StoreReader> addition);
    /// How many meshes() there are to be, as the worker says.
    std::size_t meshesReady() const;

    /// Blocks that were written since they were read, at most so many; goes on where it stopped.
    /// Those that are being written come another time.
    struct Got {
        std::uint32_t block;
        LightBlock light;
    };
    void read(std::size_t most, std::vector<Got>& got);
    /// A block that was read is to be read again.
    void again(std::uint32_t block);
    /// The dirty status of all blocks; empty: it is not about this question.
    void readDirty(std::uint32_t question, std::vector<DirtyStatus>& work) const;
    /// Whether the last read() has brought all that was published before it.
    bool current() const { return current_; }

private:
    bool readBlock(std::uint32_t block, LightBlock& light, std::uint32_t& sequence) const;

    RegionPtr region_;
    StoreShape shape_;
    std::vector<std::span<const std::byte>> meshes_;
    std::vector<std::shared_ptr<StoreReader>> additions_; ///< hold the meshes behind the first
    const StoreHeader& header_;
    const SharedCount* sequences_;
    const SharedWord* blocks_;
    const SharedWord* work_;
    std::vector<std::uint32_t> known_; ///< sequence numbers of what was read
    std::uint64_t publishedKnown_ = ~std::uint64_t(0);
    bool current_ = false;
    std::uint32_t next_ = 0;
};

/// The shape of a store of nothing but a mesh.
StoreShape additionShape(std::span<const std::byte> mesh);

/// Whether a region holds a store of this number that is ready to be read.
bool storeReady(Region& region, std::uint64_t number);

} // namespace penumbra
