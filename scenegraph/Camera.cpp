#include "scenegraph/Camera.h"

#include "scenegraph/Visitor.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

/// Axes shorter than this have no direction, and three that span less lie in a plane.
constexpr double kLeastAxis = 1e-12;

glm::dmat4 withoutScale(glm::dmat4 matrix) {
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(glm::dvec3(matrix[axis]));
        if (length > 0) matrix[axis] = matrix[axis] * (1.0 / length);
    }
    return matrix;
}

bool isSingular(const glm::dmat4& frame) {
    return !(std::abs(glm::determinant(glm::dmat3(withoutScale(frame)))) > kLeastAxis);
}

/// Of what a film shows, in units of the focal length, and of where its middle is: as much as
/// double precision can resolve when it is taken back from the picture to the scene.
constexpr double kNarrowest = 1e-6, kWidest = 1e4;
constexpr double kDeepest = 1e12; ///< far over near, for the same reason
constexpr double kFarthest = 1e9; ///< near, and half of a film without perspective [m]

/// \return `least` for what is no number
double within(double value, double least, double most) {
    return std::min(std::max(least, value), most);
}

} // namespace

void Camera::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

glm::dmat4 wholeFrame(const glm::dmat4& cameraToWorld) {
    if (!isSingular(cameraToWorld)) return cameraToWorld;
    double unit = 0;
    for (int axis = 0; axis < 3; ++axis)
        unit = std::max(unit, glm::length(glm::dvec3(cameraToWorld[axis])));
    if (!(unit > kLeastAxis)) unit = 1;
    const glm::dmat4 axes = withoutScale(cameraToWorld);
    glm::dvec3 x(axes[0]), y(axes[1]), z(axes[2]);
    const auto span = [](glm::dvec3 a, glm::dvec3 b) {
        return glm::length(glm::cross(a, b)) > kLeastAxis;
    };
    if (!span(y, z)) {
        if (span(z, x)) {
            y = glm::cross(z, x);
        } else if (span(x, y)) {
            z = glm::cross(x, y);
        } else {
            if (!(glm::length(z) > 0.5)) z = glm::dvec3(0, 0, 1);
            y = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        }
    }
    x = glm::normalize(glm::cross(y, z));
    z = glm::normalize(z);
    return {glm::dvec4(unit * x, 0), glm::dvec4(unit * glm::cross(z, x), 0),
            glm::dvec4(unit * z, 0), cameraToWorld[3]};
}

View makeView(const Lens& lens, const glm::dmat4& cameraToWorld, int width, int height) {
    View view;
    const glm::dmat4 frame = wholeFrame(cameraToWorld);
    view.eye = glm::dvec3(frame[3]);
    const double unit = glm::length(glm::dvec3(frame[2])); // local lengths to metres
    view.worldToCamera = glm::inverse(withoutScale(frame));

    const double near = within(double(lens.clippingRange.x) * unit, 1e-3, kFarthest);
    const double far = within(double(lens.clippingRange.y) * unit, near * 10, near * kDeepest);
    const double aspect = double(height) / double(width);
    // USD gives apertures in tenths of a scene unit; in perspective only their ratio to f matters.
    const double scale = lens.perspective ? near / lens.focalLength : 0.1 * unit;
    const double least = lens.perspective ? near * kNarrowest : kNarrowest;
    const double most = lens.perspective ? near * kWidest : kFarthest;
    const double centreX = within(scale * lens.horizontalApertureOffset, -most, most);
    const double centreY = within(scale * lens.verticalApertureOffset, -most, most);
    const double halfX = within(scale * lens.horizontalAperture / 2, least, most);
    const double halfY = halfX * aspect;
    view.projection = lens.perspective ? glm::frustum(centreX - halfX, centreX + halfX,
                                                      centreY - halfY, centreY + halfY, near, far)
                                       : glm::ortho(centreX - halfX, centreX + halfX,
                                                    centreY - halfY, centreY + halfY, near, far);
    return view;
}

std::string whatIsAmiss(const Lens& lens, const glm::dmat4& cameraToWorld) {
    if (isSingular(cameraToWorld))
        return "its transform is singular; the axes that it has lost are made up";
    const double unit = glm::length(glm::dvec3(cameraToWorld[2]));
    const double scale = lens.perspective ? 1 / double(lens.focalLength) : 0.1 * unit;
    const double most = lens.perspective ? kWidest : kFarthest;
    const double half = scale * lens.horizontalAperture / 2;
    if (!(half >= kNarrowest && half <= most &&
          std::abs(scale * lens.horizontalApertureOffset) <= most &&
          std::abs(scale * lens.verticalApertureOffset) <= most))
        return "its film is too wide, too narrow or too far aside for its lens; the nearest that "
               "can be drawn is shown";
    return {};
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
