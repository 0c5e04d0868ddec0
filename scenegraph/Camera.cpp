#include "scenegraph/Camera.h"

#include "scenegraph/Visitor.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

glm::dmat4 withoutScale(glm::dmat4 matrix) {
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(glm::dvec3(matrix[axis]));
        if (length > 0) matrix[axis] = matrix[axis] * (1.0 / length);
    }
    return matrix;
}

} // namespace

void Camera::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

View makeView(const Lens& lens, const glm::dmat4& cameraToWorld, int width, int height) {
    View view;
    view.eye = glm::dvec3(cameraToWorld[3]);
    const double unit = glm::length(glm::dvec3(cameraToWorld[2])); // local lengths to metres
    view.worldToCamera = glm::inverse(withoutScale(cameraToWorld));

    const double near = std::max(1e-3, double(lens.clippingRange.x) * unit);
    const double far = std::max(near * 10, double(lens.clippingRange.y) * unit);
    const double aspect = double(height) / double(width);
    // USD gives apertures in tenths of a scene unit; in perspective only their ratio to f matters.
    const double scale = lens.perspective ? near / lens.focalLength : 0.1 * unit;
    const double centreX = scale * lens.horizontalApertureOffset;
    const double centreY = scale * lens.verticalApertureOffset;
    const double halfX = scale * lens.horizontalAperture / 2;
    const double halfY = halfX * aspect;
    view.projection = lens.perspective ? glm::frustum(centreX - halfX, centreX + halfX,
                                                      centreY - halfY, centreY + halfY, near, far)
                                       : glm::ortho(centreX - halfX, centreX + halfX,
                                                    centreY - halfY, centreY + halfY, near, far);
    return view;
}

View turned(const View& view, const glm::dvec3& up, double degrees) {
    // All turns the other way about the eye.
    glm::dmat4 world = glm::translate(glm::dmat4(1.0), view.eye);
    world = glm::rotate(world, -glm::radians(degrees), up);
    world = glm::translate(world, -view.eye);
    View result = view;
    result.worldToCamera = view.worldToCamera * world;
    return result;
}

View frameBox(glm::vec3 lower, glm::vec3 upper, int up, int width, int height) {
    const glm::dvec3 centre = 0.5 * glm::dvec3(lower + upper);
    const double radius = std::max(1e-3, 0.5 * glm::length(glm::dvec3(upper - lower)));
    const double fovX = glm::radians(50.0);
    const double fovY = 2 * std::atan(std::tan(fovX / 2) * height / width);
    const double distance = radius / std::sin(std::min(fovX, fovY) / 2);
    glm::dvec3 upAxis(0), from(0);
    upAxis[up] = 1;
    from = up == 2 ? glm::dvec3(-0.5, -1.0, 0.6) : glm::dvec3(-0.5, 0.6, 1.0);
    View view;
    view.eye = centre + distance * glm::normalize(from);
    view.worldToCamera = glm::lookAt(view.eye, centre, upAxis);
    view.projection = glm::perspective(fovY, double(width) / height, distance * 1e-3, distance * 4);
    return view;
}

} // namespace penumbra
