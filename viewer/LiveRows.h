// What lamps give to vertices while things move, by rays.
#pragma once

#include "radiosity/EmitterSender.h"
#include "radiosity/RayScene.h"
#include "viewer/LiveLight.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Rows of the shadow-form-factor-list for the live lamps, of those vertices alone that a change
/// may reach: the same closed forms, samples and rays as radiosity takes (RowBuilder), at the same
/// places, so that both come to the same light. Kept arrangement by arrangement as long as that is
/// asked for: what stands still is traced once, and where what moves is not in the way of a lamp it
/// does not matter where it is.
class LiveRows {
public:
    static constexpr std::size_t kBlock = LitGeometry::kBlock;
    using Factors = std::array<float, kBlock>; ///< F V of the vertices of a block

    /// \param samples as SolverOptions::samples
    explicit LiveRows(int samples) : samples_(samples) {}

    /// Indexes the triangles of these geometries (null: none) for rays, unless it has them.
    void require(const std::vector<std::shared_ptr<const LitGeometry>>& geometries);

    /// A block that a live change may reach, and by which lamps: a bit each.
    struct Reached {
        std::uint32_t object = 0, block = 0;
        unsigned lamps = 0;
    };
    /// Traces what is missing. \param light with LiveLight::active()
    void prepare(const LiveLight& light);
    /// Drops what is known.
    void forget();
    std::span<const Reached> reached() const { return reached_; }

    /// Of a lamp that reaches the block. \param slot 0: now; 1 ...: the anchors
    const Factors& factors(std::size_t slot, const Reached& at, std::size_t lamp) const;
    /// What a lamp gives to a vertex now when nothing is in its way.
    float unoccluded(const Reached& at, std::size_t lamp, std::size_t vertex) const;

private:
    struct Surface {
        std::shared_ptr<const LitGeometry> geometry;
        std::uint64_t topology = 0;
        std::size_t inRays = 0;        ///< vertices of its mesh there; others may have been added
        std::vector<glm::vec3> points; ///< where vertices receive, but for the hair [m, local]
        std::vector<Bounds> blocks;    ///< [m, local]
    };
    using Key = std::uint64_t;
    using Table = std::unordered_map<Key, Factors>;
    struct Slot {
        ArrangementPtr of;
        std::vector<std::optional<EmitterSender>> senders; ///< by lamp; none: hidden
        std::vector<Bounds> things; ///< boxes around what moves, one a thing [m, world]
        Table table;
    };
    static Key keyOf(const Reached& at, std::size_t lamp) {
        return Key(at.object) << 32 | Key(at.block) << 2 | lamp;
    }

    void describe(Surface& surface) const;
    void startAnew(const LiveLight& light);
    void chooseSlots(const LiveLight& light);
    Slot makeSlot(const LiveLight& light, const ArrangementPtr& of) const;
    bool inTheWay(const LiveLight& light, const Slot& slot, const Bounds& block,
                  std::size_t lamp) const;
    void findReached(const LiveLight& light);
    void place(const Arrangement& arrangement);
    void trace(const LiveLight& light, Slot& slot);
    Receiver receiver(const Surface& surface, const glm::dmat4& toWorld, std::size_t v) const;

    int samples_;
    std::vector<Surface> surfaces_; ///< by object
    std::unique_ptr<RayScene> rays_;
    std::vector<Arrangement::Place> standsAs_; ///< in rays_
    float skin_ = 0;                           ///< how far receivers hover [m]
    std::vector<Slot> slots_;
    Table clear_; ///< where nothing that moves is in the way
    std::vector<bool> moves_, lampMoves_;
    std::vector<std::optional<Emitter>> lamps_; ///< that clear_ is of
    std::vector<Reached> reached_;
};

} // namespace penumbra
