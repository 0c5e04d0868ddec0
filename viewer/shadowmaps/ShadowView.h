// From where shadows are drawn, and how.
#pragma once

#include "base/Bounds.h"
#include "radiosity/mesh/PatchSet.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace penumbra {

/// Points of a light from which shadow maps are drawn: the first visibility samples that radiosity
/// takes (sampleEmitter()), so that both see the same obstacles. Of a sphere: on the disk in it
/// that faces `towards`.
std::vector<glm::vec3> shadowPoints(const Emitter& source, std::size_t count, glm::vec3 towards);

/// A point and its window onto a plane at distance 1: what lies at o + z (axis + x right + y up) is
/// drawn at (x, y) * scale + offset, in [0, 1]^2.
struct ShadowPoint {
    glm::vec3 origin{0.0f};
    glm::vec2 scale{0.5f}, offset{0.5f};
};

/// Views of one box from several points, with one set of axes: their planes are parallel, as
/// Heckbert & Herf have them [HeckbertHerf1997].
struct ShadowView {
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, axis{0, 0, 1}; ///< orthonormal
    std::vector<ShadowPoint> points;
    float near = 0, far = 0; ///< least and greatest z of the box, a hair more [m]
    float width = 0;         ///< of the widest window, at distance 1
};

/// Views that the box fills, but for a margin. Parts of it beside or behind a point are left out.
ShadowView fitView(std::span<const glm::vec3> points, const Bounds& box);

/// Face 0 ... 5 (+x, -x, +y, -y, +z, -z) of the cube around each point.
ShadowView cubeView(std::span<const glm::vec3> points, int face);

/// Depth d = a - b / z: 0 at near, 1 at far.
struct DepthRange {
    DepthRange(float near, float far) : a(far / (far - near)), b(far * near / (far - near)) {}
    float a, b;
};

/// To OpenGL's clip space.
glm::mat4 toClip(const ShadowView& view, const ShadowPoint& point, DepthRange depth);

} // namespace penumbra
