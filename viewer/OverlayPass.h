// What is otherwise not seen of the lit surfaces: their elements, the age of their light.
#pragma once

#include "scenegraph/LitGeometry.h"
#include "viewer/GlObject.h"
#include "viewer/LitItem.h"
#include "viewer/ShaderProgram.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra {

enum class Overlay { none, elements, age };
inline constexpr const char* kOverlayNames[] = {"none", "element mesh", "age of the light"};

/// The edges of the elements: those of all triangles, but not the diagonals that cut quadrilaterals
/// into two consecutive triangles; each once. Pairs of vertices.
std::vector<std::uint32_t> elementEdges(const LitMeshData& mesh);

/// Draws an overlay over surfaces that have just been drawn, into the same framebuffer, with its
/// depth test.
class OverlayPass {
public:
    OverlayPass();

    /// \param middleGrey luminance that is shown as 18 % grey [nit]: overlays look alike in all
    ///                   light
    /// \param now        the time by which GpuGeometry::blockTimes() counts [s]
    void draw(Overlay overlay, const std::vector<LitItem>& items, float middleGrey, double now,
              bool reversedDepth);
    /// Drops what belongs to geometries that are gone.
    void dropDead();

private:
    struct Edges {
        std::weak_ptr<const Node> alive;
        std::uint64_t topology = 0;
        GlObject vertexArray, positions, indices;
        std::size_t count = 0;
    };

    const Edges& edgesOf(const LitItem& item);
    void drawElements(const std::vector<LitItem>& items, float middleGrey);
    void drawAge(const std::vector<LitItem>& items, float middleGrey, double now);

    ShaderProgram lineProgram_, ageProgram_;
    GlObject ageBuffer_, ageTexture_;
    std::unordered_map<const LitGeometry*, Edges> edges_;
};

} // namespace penumbra
