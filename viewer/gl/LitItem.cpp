#include "viewer/gl/LitItem.h"

#include "scenegraph/LitGeometry.h"
#include "viewer/gl/DrawState.h"

#include <epoxy/gl.h>

#include <glm/gtc/matrix_inverse.hpp>

namespace penumbra {

DrawPose::DrawPose(const glm::dmat4& toWorld, const View& view, bool reversed) {
    const glm::dmat4 toEye = view.worldToCamera * toWorld;
    const glm::dmat4 toClip = view.projection * toEye;
    localToClip = glm::mat4(reversed ? reversedDepth() * toClip : toClip);
    localToEye = glm::mat4(toEye);
    localToDepth = -glm::vec4(glm::transpose(toEye)[2]); // the camera looks along -Z
    const glm::dmat3 linear(toWorld);
    normalToWorld = glm::mat3(glm::inverseTranspose(linear));
    mirrored = glm::determinant(linear) < 0;
}

void setPose(const ShaderProgram& program, const DrawPose& place) {
    glFrontFace(place.mirrored ? GL_CW : GL_CCW);
    program.set("localToClip", place.localToClip);
    program.set("localToEye", place.localToEye);
    program.set("localToDepth", place.localToDepth);
    program.set("normalToWorld", place.normalToWorld);
}

std::vector<LitItem> prepareLit(const DrawList& list, const View& view, bool reversed,
                                GeometryCache& cache) {
    std::vector<LitItem> items;
    items.reserve(list.items.size());
    for (const DrawItem& item : list.items) // an unordered_map never moves its elements
        items.push_back({item.geometry, &cache.get(item), ownerOf(*item.parent, *item.geometry),
                         DrawPose(item.toWorld, view, reversed), item.toWorld});
    return items;
}

void drawRange(const MaterialRange& range) {
    glDrawElements(GL_TRIANGLES, GLsizei(range.indexCount), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(range.firstIndex * sizeof(std::uint32_t)));
}

} // namespace penumbra
