// Lit surfaces in view, ready for a pass over them.
#pragma once

#include "scenegraph/Camera.h"
#include "viewer/gl/GeometryCache.h"
#include "viewer/gl/ShaderProgram.h"
#include "viewer/preview/DrawList.h"

#include <glm/glm.hpp>

#include <memory>
#include <vector>

namespace penumbra {

/// Where something is drawn. Matrices are multiplied in double, so that a camera and an object that
/// are both far from the origin keep their digits.
struct DrawPose {
    DrawPose(const glm::dmat4& toWorld, const View& view, bool reversedDepth);

    glm::mat4 localToClip{1.0f};
    glm::mat4 localToEye{1.0f};   ///< the camera's frame: looks along -Z [m]
    glm::vec4 localToDepth{0.0f}; ///< depth = dot(localToDepth, (p, 1)) [m]
    glm::mat3 normalToWorld{1.0f};
    bool mirrored = false;
};

/// Hands a pose to the program in use, as far as its shaders ask for it, and sets which way round
/// fronts are.
void setPose(const ShaderProgram& program, const DrawPose& place);

/// An instance of a geometry with what the shaders need of it.
struct LitItem {
    const LitGeometry* geometry = nullptr;
    const GpuGeometry* gpu = nullptr; ///< in the cache
    std::weak_ptr<const Node> owner;  ///< of the geometry
    DrawPose place;
    glm::dmat4 toWorld{1.0};
};

/// Readies the lit surfaces of a list; what is not in the cache yet is uploaded.
std::vector<LitItem> prepareLit(const DrawList& list, const View& view, bool reversedDepth,
                                GeometryCache& cache);

/// Draws a run of the triangles of the vertex array that is bound.
void drawRange(const MaterialRange& range);

} // namespace penumbra
