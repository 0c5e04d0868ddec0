// What elements make of a patch: its size, and where its nodes lie.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <array>
#include <cstdint>
#include <span>

namespace penumbra {

/// A rectangle of a patch, in its coordinates from 0 to 1.
struct PatchRectangle {
    glm::vec2 low{1}, high{0}; ///< nothing at first

    void add(glm::vec2 st) {
        low = glm::min(low, st);
        high = glm::max(high, st);
    }
    friend bool operator==(const PatchRectangle&, const PatchRectangle&) = default;
};

/// Fills in area, centre and normal, from elements as they are drawn. \return false if there is no
/// area
bool measurePatch(const PatchSet& set, std::span<const std::uint32_t> elements, Patch& patch);

/// Where indirect light is received: at a patch's middle and, unless the patch is small, at its
/// corners, which neighbouring patches share.
struct NodePlaces {
    Receiver centre; ///< amid the element that is nearest to the middle
    std::uint32_t centreElement = Element::kNone;
    /// The vertices nearest to the corners, and as which corner of which element: element * 4 + k.
    std::array<std::uint32_t, 4> vertices{}, corners{};
    bool small = false; ///< one node is enough
};
/// \param elements of the patch, at least one \param spans the part of it that they span
NodePlaces findNodePlaces(const PatchSet& set, const Patch& patch,
                          std::span<const std::uint32_t> elements, const PatchRectangle& spans);

} // namespace penumbra
