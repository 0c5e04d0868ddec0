// What objects cover of each other.
#pragma once

#include "base/BoundsTree.h"
#include "base/Progress.h"
#include "radiosity/mesh/Contact.h"
#include "radiosity/mesh/Parting.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Follows objects: keeps up to date which corners of elements they touch, cover or part (see
/// Contact.h), and what that makes of patches and nodes (Parting.h). The result depends on the
/// poses of things and not on how they came there, apart from which private vertices replace which
/// corners.
class Coverage {
public:
    /// Brings `set` up to date. Both must outlive this; `rays` shows the objects of `set`.
    Coverage(PatchSet& set, const RayScene& rays, const Progress& progress = {});

    /// What lies elsewhere than before. Whole moved objects are not listed.
    struct Change {
        std::vector<std::uint32_t> vertices; ///< new, moved or given back
        std::vector<std::uint32_t> patches;  ///< of the mesh: elements have other vertices
        Parting::Change parted;              ///< nothing in a set without nodes
    };
    /// Objects came to `set` and `rays`, which hide them as yet. \pre their numbers, and those of
    /// all that they are made of, follow on the others'
    void add(std::span<const ObjectId> objects);
    /// Objects were posed anew, hidden or shown, in `set` and in `rays`.
    /// \param before their boxes before, empty for those that were hidden [m, world]
    Change update(std::span<const ObjectId> moved, std::span<const Bounds> before);
    /// See Parting.
    bool exhausted() const { return parting_ && parting_->exhausted(); }

private:
    static constexpr std::uint32_t kChunk = 32;

    void orderElements(ObjectId object);
    void updateChunk(std::size_t chunk);
    void collectNear(const Bounds& box, std::vector<std::uint32_t>& elements) const;
    Bounds boxOf(std::uint32_t element) const;
    void examine(const std::vector<std::uint32_t>& elements, const Progress& progress);
    bool parted(std::uint32_t vertex) const;
    void settleCorner(std::uint32_t element, std::uint32_t corner, bool parted, Change& change);
    std::uint32_t takeVertex(ObjectId object);
    void refresh(std::vector<std::uint32_t> elements, Change& change,
                 const Progress& progress = {});

    using Result = ContactResolver::Result;
    PatchSet& set_;
    const RayScene& rays_;
    ContactResolver resolver_;
    const std::vector<Element>& shared_;       ///< elements as they are when nothing else is near
    Fans fans_;                                ///< of those
    std::vector<std::uint32_t> order_;         ///< elements, object by object along a curve
    std::vector<ObjectId> chunkObject_;        ///< kChunk consecutive ones of one object
    std::vector<std::uint32_t> chunkFirst_{0}; ///< into order_; one more than chunks
    BoundsTree places_;                        ///< of the chunks
    float largest_ = 0;                        ///< diagonal of an element's box, at most [m]
    std::unordered_map<std::uint32_t, Result> results_; ///< of elements that are not all free
    std::unordered_map<std::uint32_t, std::uint32_t>
        own_; ///< private vertex of element * 4 + corner
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> unused_; ///< by object
    std::optional<Parting> parting_;
};

} // namespace penumbra
