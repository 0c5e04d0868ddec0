// The surface that a mesh describes, face by face: OpenSubdiv's limit surface, or the polygons.
#pragma once

#include "radiosity/surface/SurfaceMesh.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace penumbra {

/// A point on the limit surface, or on a polygon. There a normal of the file, interpolated between
/// the corners, is turned towards the polygon's own if it is more than 60 degrees off: receivers
/// hover over their surface along it. Normals that all point away from a polygon's front are taken
/// as the opposite ones.
struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal; ///< unit, of the front
};

/// How a face's domain is cut: points, and small faces of 3 (last index -1) or 4 of them. The first
/// points lie on the boundary, along the edges from vertex 0 on.
struct DomainPattern {
    std::vector<glm::vec2> coords;
    std::vector<std::array<int, 4>> facets;
};

/// One face of a LimitSurface over its parameter domain, that of Bfr::Parameterization: the unit
/// square for a quadrilateral; for others one square a corner ("sub-face"), side by side in tiles.
class FaceSurface {
public:
    virtual ~FaceSurface() = default;

    virtual SurfacePoint at(glm::vec2 uv) const = 0;

    int size() const { return size_; }
    bool hasSubFaces() const { return size_ != 4; }
    int subFaceCount() const { return hasSubFaces() ? size_ : 1; }

    glm::vec2 vertexCoord(int vertex) const;
    glm::vec2 edgeCoord(int edge, float t) const;
    glm::vec2 fromSubFace(int subFace, glm::vec2 st) const;
    /// \param st receives the coordinates in the sub-face, from 0 at its corner of the face to 1
    int toSubFace(glm::vec2 uv, glm::vec2& st) const;

    /// The domain without its jumps between tiles: the unit square, or a regular polygon in the
    /// unit circle, on which means can be taken.
    glm::vec2 layout(glm::vec2 uv) const;
    int subFaceOfLayout(glm::vec2 point) const;
    /// Coordinates of a layout point in a sub-face, also beyond its borders.
    glm::vec2 subFaceCoordinate(int subFace, glm::vec2 point) const;

    float edgeLength(int edge) const; ///< along the limit surface [m], by a few chords
    float edgeBend(int edge) const;   ///< by how much the normal turns along an edge [rad]
    float extent() const;             ///< largest distance between two of its corners [m]
    double area() const;              ///< [m^2], by a few flat pieces

    /// \param rates parts each edge is cut into, then inner rates (see Bfr::Tessellation)
    DomainPattern pattern(const std::vector<int>& rates) const;

    /// Texture coordinates at a point of the domain, bilinear over its (sub-)quadrilaterals.
    /// \param corners one a corner
    glm::vec2 uvAt(glm::vec2 coord, std::span<const glm::vec2> corners) const;

protected:
    explicit FaceSurface(int size) : size_(size) {}

private:
    static constexpr std::size_t kChords = 4;
    std::array<SurfacePoint, kChords + 1>
    alongEdge(int edge) const;                        ///< its ends and points between
    std::array<glm::vec2, 4> kite(int subFace) const; ///< outline of a sub-face in the layout
    int size_;
};

/// All faces of a mesh.
class LimitSurface {
public:
    explicit LimitSurface(const SurfaceMesh& mesh);
    ~LimitSurface();

    /// False if OpenSubdiv refused the cage; it is then taken as polygons.
    bool understood() const { return understood_; }
    /// \return null if the face has no limit surface
    std::unique_ptr<FaceSurface> face(std::uint32_t index) const;
    /// The polygon of some corners of a face, two of which may be the same.
    std::unique_ptr<FaceSurface> polygon(std::uint32_t index,
                                         std::span<const std::uint32_t> corners) const;

private:
    struct Refined;
    const SurfaceMesh& mesh_;
    std::unique_ptr<Refined> refined_;
    bool understood_ = true;
};

} // namespace penumbra
