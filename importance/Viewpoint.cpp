#include "importance/Viewpoint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kMargin = 15 * std::numbers::pi / 180;            ///< [rad]
constexpr double kOrthographicWidth = 30 * std::numbers::pi / 180; ///< [rad]

bool isPerspective(const View& view) {
    return view.projection[3][3] == 0;
}

/// The eye, or where a viewer of an orthographic picture would have it.
glm::dvec3 eyeOf(const View& view) {
    if (isPerspective(view)) return view.eye;
    const double distance = 1 / (view.projection[0][0] * std::tan(kOrthographicWidth / 2)); // [m]
    const glm::dvec3 backwards = glm::transpose(glm::dmat3(view.worldToCamera))[2];
    return view.eye + distance * backwards;
}

/// The clip matrix of a picture that reaches farther on all sides.
glm::dmat4 widened(const View& view) {
    glm::dmat4 projection = view.projection;
    for (int axis = 0; axis < 2; ++axis) {
        double& scale = projection[axis][axis]; // 1 / tan of half the angle of view
        const double half = std::atan(1 / scale);
        const double wide = isPerspective(view)
                                ? 1 / std::tan(std::min(half + kMargin, 0.49 * std::numbers::pi))
                                : scale / 2;
        projection[2][axis] *= wide / scale; // what is off the axis stays in its direction
        projection[3][axis] *= wide / scale;
        scale = wide;
    }
    return projection * view.worldToCamera;
}

} // namespace

Viewpoint::Viewpoint(const View& view, int width, int height)
    : inScene_(isPerspective(view) ? std::optional(view.eye) : std::nullopt), eye_(eyeOf(view)),
      axis_(-glm::transpose(glm::dmat3(view.worldToCamera))[2]),
      clipToWorld_(glm::inverse(view.worldToClip())), picture_(view.worldToClip()),
      margin_(widened(view)),
      pixelsPerRadian_(isPerspective(view) ? 0.5 * width * view.projection[0][0]
                                           : 0.5 * width / std::tan(kOrthographicWidth / 2)),
      pixels_(double(width) * height) {
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}})
        cornerCosine_ = std::min(cornerCosine_, glm::dot(axis_, through(corner)));
}

bool Viewpoint::operator==(const Viewpoint& other) const {
    return eye_ == other.eye_ && clipToWorld_ == other.clipToWorld_ &&
           pixelsPerRadian_ == other.pixelsPerRadian_ && pixels_ == other.pixels_;
}

double Viewpoint::pixelsPerDegree() const {
    return pixelsPerRadian_ * std::numbers::pi / 180;
}

Viewpoint::Region Viewpoint::regionOf(const Bounds& box) const {
    if (picture_.mayContain(box)) return Region::picture;
    return margin_.mayContain(box) ? Region::margin : Region::elsewhere;
}

glm::dvec3 Viewpoint::through(glm::dvec2 point) const {
    const glm::dvec4 far = clipToWorld_ * glm::dvec4(point, 1, 1);
    return towards(glm::dvec3(far) / far.w);
}

glm::dvec3 Viewpoint::towards(glm::dvec3 point) const {
    return glm::normalize(point - eye_);
}

double Viewpoint::pixelsOf(const Bounds& box, glm::vec3 normal, float area) const {
    const glm::dvec3 centre(box.centre());
    const glm::dvec3 way = eye_ - centre;
    const double nearest = 0.25 * box.diagonal();
    const double distance2 = std::max(glm::dot(way, way), std::max(nearest * nearest, 1e-12));
    // A mean normal of length l represents a part l that is flat, and a rest that faces any way.
    const double flat = glm::length(normal);
    const double facing = glm::dot(glm::dvec3(normal), way) / std::sqrt(distance2);
    const double cosine = std::clamp(facing + 0.25 * std::max(0.0, 1 - flat), 0.0, 1.0);
    const double radians2 = double(area) * cosine / distance2; // solid angle
    const double off = -glm::dot(axis_, way) / std::sqrt(distance2);
    const double stretch = off >= cornerCosine_ ? 1 / (off * off * off) : 1;
    return std::min(pixels_, radians2 * pixelsPerRadian_ * pixelsPerRadian_ * stretch);
}

} // namespace penumbra
