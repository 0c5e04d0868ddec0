// A camera as UsdGeomCamera describes it.
#pragma once

#include "scenegraph/Node.h"

#include <glm/glm.hpp>

#include <string>

namespace penumbra {

/// Lens and film of a camera that looks along -Z with +Y up in its own frame. Apertures, offsets
/// and focal length share one unit, a tenth of the camera's own (local) unit; only in an
/// orthographic view does more than their ratios matter.
struct Lens {
    float focalLength = 50;
    float horizontalAperture = 20.955f;
    float verticalAperture = 15.2908f;
    float horizontalApertureOffset = 0;
    float verticalApertureOffset = 0;
    glm::vec2 clippingRange{1.0f, 1e6f}; ///< near and far, in the camera's own (local) unit
    bool perspective = true;
};

/// A camera of the scene.
class Camera : public Node {
public:
    Camera(std::string name, const Lens& lens) : Node(std::move(name)), lens_(lens) {}
    void accept(Visitor& visitor) const override;

    const Lens& lens() const { return lens_; }
    void setLens(const Lens& lens) {
        lens_ = lens;
        touch();
    }

private:
    Lens lens_;
};

/// A camera with its transform: what a renderer needs.
struct View {
    glm::dmat4 worldToCamera{1.0}; ///< column vectors; camera looks along -Z, +Y up [m]
    glm::dmat4 projection{1.0};    ///< camera to OpenGL clip space
    glm::dvec3 eye{0.0};           ///< world space [m]

    glm::dmat4 worldToClip() const { return projection * worldToCamera; }
};

/// A camera's frame with the axes made up that a singular one has lost (a scale of 0): the third
/// from the other two, more of them from the world's. Any other frame as it is.
glm::dmat4 wholeFrame(const glm::dmat4& cameraToWorld);

/// The view of `lens` placed by `cameraToWorld` for a picture of `width` x `height` pixels. The
/// horizontal field of view is the lens's own; the vertical one follows the picture's shape, as
/// USD's conformance "expand vertically / crop" does for renderers that keep the width. Scale in
/// `cameraToWorld` is taken out of the axes. A near plane of 0 or less is moved to a small
/// positive. Whatever the camera, the view's matrices can be inverted: see whatIsAmiss().
View makeView(const Lens& lens, const glm::dmat4& cameraToWorld, int width, int height);

/// What makeView() does not show as the camera asks for it, in words for people; empty: nothing.
std::string whatIsAmiss(const Lens& lens, const glm::dmat4& cameraToWorld);

/// What is seen by a head that is turned to the left about an axis through the eye, whatever the
/// view was. \param up unit vector [world]
View turned(const View& view, const glm::dvec3& up, double degrees);

/// A view that shows the whole of a box from a corner above it: for scenes without a camera.
/// \param up 1 for a Y-up scene, 2 for a Z-up scene
View frameBox(glm::vec3 lower, glm::vec3 upper, int up, int width, int height);

} // namespace penumbra
