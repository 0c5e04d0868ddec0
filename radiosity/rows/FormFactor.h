// Closed-form form factors from a differential receiver to a polygon, a disk or a sphere.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace penumbra {

/// Fraction of the light leaving a small diffuse area at `p` that reaches `polygon` when nothing
/// stands between them; by reciprocity also the cosine-weighted fraction of the hemisphere at `p`
/// that the polygon covers.
///
///     F = 1/(2 pi) * sum_e beta_e (n . gamma_e)
///
/// Edge e of the polygon is seen from p under the angle beta_e [rad]; gamma_e is the unit normal of
/// the plane through p and e. Exact, so it holds at any distance, unlike the 1/r^2 estimates, and
/// it closes: over a closed surface of polygons, planar or not, the factors add up to 1.
///
/// \param p        point on the receiving area, world space [m]
/// \param n        unit normal there
/// \param polygon  at least 3 vertices [m], counter-clockwise as seen from p, all in front of the
///                 plane (p, n): clip first, see clipToHorizon()
/// \return         form factor in [0, 1], no unit; negative if the polygon shows its back
///
/// Lambert 1760; for radiosity Baum, Rushmeier & Winget, SIGGRAPH 1989.  [docs/references.md]
double pointToPolygonFormFactor(glm::vec3 p, glm::vec3 n, std::span<const glm::vec3> polygon);

/// The part of `polygon` above the plane (p, n), by Sutherland & Hodgman (CACM 17(1), 1974). A
/// concave polygon may come back with coinciding edges, which cancel in pointToPolygonFormFactor().
/// \param clipped  receives the vertices; empty if nothing is above
void clipToHorizon(glm::vec3 p, glm::vec3 n, std::span<const glm::vec3> polygon,
                   std::vector<glm::vec3>& clipped);

/// The two in one, without allocation for polygons of up to 60 vertices: 0 if the polygon is below
/// the horizon or shows its back.
float polygonFormFactor(glm::vec3 p, glm::vec3 n, std::span<const glm::vec3> polygon);

/// The same for a disk, in closed form as long as it is wholly above the horizon: its boundary
/// integral is elementary in the disk's own frame (Howell's configurations B-12 to B-15 are cases
/// of it). A disk that the horizon cuts is taken as a regular polygon of the same area. \param axis
/// unit normal of the emitting side; 0 is returned behind it
float diskFormFactor(glm::vec3 p, glm::vec3 n, glm::vec3 centre, glm::vec3 axis, float radius);

/// The same for a sphere: seen from p it is the disk that touches the tangent cone.
/// It emits outwards: inside of it nothing arrives.
float sphereFormFactor(glm::vec3 p, glm::vec3 n, glm::vec3 centre, float radius);

/// The disk as which a point outside sees a sphere: the circle in which the cone from `p` touches
/// it.
struct TangentDisk {
    glm::vec3 centre;
    glm::vec3 axis; ///< towards p
    float radius;
};
TangentDisk tangentDisk(glm::vec3 p, glm::vec3 centre, float radius);

} // namespace penumbra
