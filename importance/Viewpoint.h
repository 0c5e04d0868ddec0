// From where, and how large, the viewer sees a piece of the scene.
#pragma once

#include "base/Bounds.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Frustum.h"

#include <glm/glm.hpp>

#include <optional>

namespace penumbra {

/// The viewing conditions of a camera: the viewer's eye is where the camera's is, so the picture
/// fills as many degrees of the eye's field as of the camera's. An orthographic picture has no
/// eye point and counts as one that is 30 degrees wide.
class Viewpoint {
public:
    /// \param width, height of the picture [pixels]
    Viewpoint(const View& view, int width, int height);

    /// Where the eye is [m, world]; an orthographic picture has no eye point.
    const std::optional<glm::dvec3>& eye() const { return inScene_; }
    /// Whether both see the same picture.
    bool operator==(const Viewpoint& other) const;
    /// In the middle of the picture.
    double pixelsPerDegree() const;
    double pixels() const { return pixels_; } ///< of the whole picture

    /// Where a box lies: maybe in the picture, maybe within 15 degrees of its edges (where a turn
    /// of the head finds it soon), or elsewhere. Errs towards the picture.
    enum class Region { picture, margin, elsewhere };
    Region regionOf(const Bounds& box) const;

    /// Unit vector from the eye to a point of the picture.
    /// \param point [-1, 1], from left to right and from bottom to top
    glm::dvec3 through(glm::dvec2 point) const;
    /// Unit vector from the eye towards a point of the world.
    glm::dvec3 towards(glm::dvec3 point) const;

    /// About how many pixels a surface covers if nothing stands in front of it; 0 if it is turned
    /// away.
    ///
    ///     pixels = area * cos(angle to the normal) / distance^2 * (pixels per radian)^2 / cos(a)^3
    ///
    /// where a is the angle between the camera's axis and the way there: a flat picture stretches
    /// what is far from its middle. What is farther from it than all corners is not stretched.
    ///
    /// \param box    around it [m, world]; it does not get closer than half its own radius
    /// \param normal mean of its unit normals; the shorter, the more it is curved
    /// \param area   [m^2]
    double pixelsOf(const Bounds& box, glm::vec3 normal, float area) const;

private:
    std::optional<glm::dvec3> inScene_;
    glm::dvec3 eye_, axis_; ///< [m, world]; where the camera looks, unit
    glm::dmat4 clipToWorld_;
    Frustum picture_, margin_;
    double pixelsPerRadian_, pixels_;
    double cornerCosine_ = 1; ///< of the angle between the axis and the farthest corner
};

} // namespace penumbra
