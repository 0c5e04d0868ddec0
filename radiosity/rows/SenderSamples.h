// Where on a sender visibility is sampled.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <numbers>
#include <vector>

namespace penumbra {

/// Point `index` of the Sobol (0,2)-sequence (Sobol 1967): every first 4, 16, 64 ... points are
/// stratified in both coordinates and in the square. In (0, 1)^2: half a cell of the grid of
/// `count` points inwards (of 64 points, if those are more), so that of that many points each lies
/// in the middle of its strata and none on the very edge. \pre index < max(count, 64)
glm::vec2 sobol02(std::uint32_t index, std::size_t count = 64);

/// Square to unit disk, keeping areas and neighbourhoods (Shirley & Chiu, JGT 2(3), 1997).
glm::vec2 squareToDisk(glm::vec2 u);

/// Points on an emitter, each of the same share of its area, and every prefix of 4, 16, ... well
/// spread. For a sphere points of the unit disk: seen from a receiver it is a disk.
struct EmitterSamples {
    struct Point {
        glm::vec3 position; ///< [m, world], on the surface; (x, y, 0) in the unit disk for a sphere
        glm::vec3 normal;
    };
    std::vector<Point> points;
};
EmitterSamples sampleEmitter(const Emitter& emitter, std::size_t count);

/// kPatchSamples points on the elements of a patch, roundingAt() over them, in 4 x 4 strata: 4 * i
/// ... 4 * i + 3 lie in the same quarter i of the patch. Of a cluster those of its parts.
inline constexpr std::size_t kPatchSamples = 16;
void samplePatch(const PatchSet& set, const Patch& patch, glm::vec3* points);
/// The middle of the cell that sample `index` of a patch is near, in the patch's coordinates:
/// bilinear between its corners. Cells are the 4 x 4 strata.
glm::vec2 cellMiddle(std::size_t index);

/// The factor cos cos of a segment d [m] to a sample of a sender: `here` and `there` are the
/// heights [m] of its ends over the other's plane. 0 below either plane, and where the receiver
/// lies in the sender's plane up to rounding: nothing to speak of is sent there, and along faces in
/// that plane it would be rounding that decides whether they are in the way.
inline float facing(float here, float there, float d2) {
    constexpr float kInPlane = 1e-5f; // cosine
    const bool counts = (here > 0) & (there > 0) & (there * there > kInPlane * kInPlane * d2);
    return counts ? here * there : 0.0f;
}
/// Form factor of a small piece of a sender, per area [1/m^2]. \param cosines see facing()
inline float pointKernel(float cosines, float d2) {
    return cosines / (std::numbers::pi_v<float> * d2 * d2);
}

} // namespace penumbra
