// What may be drawn over the picture, to show what is otherwise not seen of the lit surfaces.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace penumbra {

class LitGeometry;

enum class Overlay : std::uint8_t { none, mesh, age, dirtyBlocks, importance, blockers };
inline constexpr const char* kOverlayNames[] = {
    "nothing",       "mesh", "age of the light", "light still to compute", "what is computed first",
    "why it is dark"};

/// Whether it shows what RadiosityNode::watchDirty() asks for.
constexpr bool watchesDirty(Overlay overlay) {
    return overlay == Overlay::dirtyBlocks || overlay == Overlay::importance;
}

/// So many further in the list, which begins again after the last.
Overlay after(Overlay overlay, int steps);

/// Colours of the blocks of geometries (LitGeometry::kBlock), one a block: sRGB, not premultiplied;
/// where alpha is 0 the picture stays as it is.
using BlockColours = std::unordered_map<const LitGeometry*, std::vector<glm::u8vec4>>;

/// What is drawn over the lit surfaces, when the picture has been tone mapped: colours are those of
/// the display, whatever the exposure.
struct OverlayPicture {
    bool mesh = false; ///< outlines of patches, and fainter of elements
    BlockColours blocks;

    bool empty() const { return !mesh && blocks.empty(); }
};

/// A colour for a block, through which a little of the picture is seen.
glm::u8vec4 blockColour(glm::vec3 colour);

} // namespace penumbra
