#include "radiosity/surface/LimitSurface.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/tessellation.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// Every face is parameterized as a quadrilateral scheme does it, polygons too.
Bfr::Parameterization parameterization(int size) {
    return Bfr::Parameterization(Sdc::SCHEME_BILINEAR, size);
}

glm::vec3 unitOr(glm::vec3 v, glm::vec3 fallback) {
    const float length = glm::length(v);
    return length > 0 ? v / length : fallback;
}

/// A normal of the file, no more than 60 degrees off the surface's own.
glm::vec3 bent(glm::vec3 shading, glm::vec3 own) {
    constexpr float kLeast = 0.5f; // cosine
    const float length = glm::length(shading);
    if (!(length > 0)) return own;
    shading /= length;
    const float along = glm::dot(shading, own);
    if (along >= kLeast) return shading;
    const glm::vec3 aside = unitOr(shading - along * own, glm::vec3(0));
    if (aside == glm::vec3(0)) return own;
    return kLeast * own + std::sqrt(1 - kLeast * kLeast) * aside;
}

/// A polygon: bilinear over its (sub-)quadrilaterals, which for a planar one is the plane.
class PolygonSurface : public FaceSurface {
public:
    PolygonSurface(const SurfaceMesh& mesh, const SurfaceFace& face,
                   std::span<const std::uint32_t> corners)
        : FaceSurface(int(corners.size())) {
        for (std::uint32_t corner : corners) {
            points_.push_back(mesh.points[corner]);
            centre_ += mesh.points[corner] / float(corners.size());
        }
        normal_ = glm::vec3(glm::normalize(newellNormal(mesh.points, corners)));
        float reach = 0, depth = 0;
        for (glm::vec3 p : points_) {
            depth = std::max(depth, std::abs(glm::dot(p - centre_, normal_)));
            reach = std::max(reach, glm::length(p - centre_));
        }
        planar_ = depth <= 1e-4f * reach;
        if (!mesh.normals.empty()) takeNormals(mesh, face, corners);
    }

    SurfacePoint at(glm::vec2 uv) const override {
        glm::vec2 st = uv;
        const int sub = hasSubFaces() ? toSubFace(uv, st) : 0;
        const std::array<glm::vec3, 4> q = around(points_, centre_, sub);
        const glm::vec3 bottom = glm::mix(q[0], q[1], st.x), top = glm::mix(q[3], q[2], st.x);
        SurfacePoint point{glm::mix(bottom, top, st.y), normal_};
        if (!planar_) {
            const glm::vec3 du = glm::mix(q[1] - q[0], q[2] - q[3], st.y);
            point.normal = unitOr(glm::cross(du, top - bottom), normal_);
        }
        if (!normals_.empty()) {
            const std::array<glm::vec3, 4> n = around(normals_, middleNormal_, sub);
            point.normal =
                bent(glm::mix(glm::mix(n[0], n[1], st.x), glm::mix(n[3], n[2], st.x), st.y),
                     point.normal);
        }
        return point;
    }

private:
    /// What the corners of a sub-quadrilateral have. \param middle what the centre has
    std::array<glm::vec3, 4> around(const std::vector<glm::vec3>& values, glm::vec3 middle,
                                    int sub) const {
        if (!hasSubFaces()) return {values[0], values[1], values[2], values[3]};
        const int n = size();
        const auto corner = [&](int k) { return values[std::size_t((k + n) % n)]; };
        return {corner(sub), 0.5f * (corner(sub) + corner(sub + 1)), middle,
                0.5f * (corner(sub) + corner(sub - 1))};
    }
    /// Those of the file; the polygon's own where it has none.
    void takeNormals(const SurfaceMesh& mesh, const SurfaceFace& face,
                     std::span<const std::uint32_t> corners) {
        const auto points = mesh.cornersOf(face);
        const auto normals = mesh.normalsOf(face);
        bool away = true;
        for (const std::uint32_t corner : corners) {
            const auto at = std::find(points.begin(), points.end(), corner) - points.begin();
            const glm::vec3 normal = normals[std::size_t(at)];
            normals_.push_back(normal == glm::vec3(0) ? normal_ : normal);
            away = away && glm::dot(normals_.back(), normal_) < 0;
        }
        for (glm::vec3& normal : normals_) {
            if (away) normal = -normal;
            middleNormal_ += normal / float(normals_.size());
        }
    }

    std::vector<glm::vec3> points_;
    std::vector<glm::vec3> normals_; // of the file, at the corners; empty: none
    glm::vec3 middleNormal_{0};
    glm::vec3 centre_{0}, normal_{};
    bool planar_ = true;
};

/// A face of a subdivision surface, evaluated at the limit.
class SubdivisionFace : public FaceSurface {
public:
    SubdivisionFace(const Bfr::Surface<float>& surface, const std::vector<glm::vec3>& points)
        : FaceSurface(surface.GetFaceSize()), surface_(surface),
          patchPoints_(std::size_t(surface.GetNumPatchPoints())) {
        surface_.PreparePatchPoints(reinterpret_cast<const float*>(points.data()), 3,
                                    reinterpret_cast<float*>(patchPoints_.data()), 3);
    }

    SurfacePoint at(glm::vec2 uv) const override {
        SurfacePoint point;
        glm::vec3 du, dv;
        surface_.Evaluate(&uv.x, reinterpret_cast<const float*>(patchPoints_.data()), 3,
                          &point.position.x, &du.x, &dv.x);
        point.normal = unitOr(glm::cross(du, dv), glm::vec3(0, 0, 1));
        return point;
    }

private:
    Bfr::Surface<float> surface_;
    std::vector<glm::vec3> patchPoints_;
};

/// The cage in OpenSubdiv's terms.
Far::TopologyRefiner* makeRefiner(const SurfaceMesh& mesh) {
    const MeshData& data = *mesh.data;
    std::vector<int> counts, indices, creaseVertices, cornerVertices;
    std::vector<float> creaseSharpness, cornerSharpness;
    for (const SurfaceFace& face : mesh.faces) {
        counts.push_back(int(face.cornerCount));
        for (std::uint32_t corner : mesh.cornersOf(face)) indices.push_back(int(corner));
    }
    for (const Crease& crease : data.creases)
        for (std::size_t i = 1; i < crease.vertices.size(); ++i) {
            creaseVertices.push_back(crease.vertices[i - 1]);
            creaseVertices.push_back(crease.vertices[i]);
            creaseSharpness.push_back(crease.sharpness);
        }
    for (const Corner& corner : data.corners) {
        cornerVertices.push_back(corner.vertex);
        cornerSharpness.push_back(corner.sharpness);
    }
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(mesh.points.size());
    descriptor.numFaces = int(counts.size());
    descriptor.numVertsPerFace = counts.data();
    descriptor.vertIndicesPerFace = indices.data();
    descriptor.numCreases = int(creaseSharpness.size());
    descriptor.creaseVertexIndexPairs = creaseVertices.data();
    descriptor.creaseWeights = creaseSharpness.data();
    descriptor.numCorners = int(cornerSharpness.size());
    descriptor.cornerVertexIndices = cornerVertices.data();
    descriptor.cornerWeights = cornerSharpness.data();

    const Sdc::SchemeType scheme =
        data.scheme == SubdivisionScheme::bilinear ? Sdc::SCHEME_BILINEAR : Sdc::SCHEME_CATMARK;
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    return Factory::Create(descriptor, Factory::Options(scheme, options));
}

constexpr std::uint32_t kMostValence = 100; ///< OpenSubdiv's effort grows with its cube

std::uint32_t highestValence(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> valence(mesh.points.size());
    std::uint32_t highest = 0;
    for (const SurfaceFace& face : mesh.faces) {
        highest = std::max(highest, face.cornerCount);
        for (std::uint32_t corner : mesh.cornersOf(face))
            highest = std::max(highest, ++valence[corner]);
    }
    return highest;
}

/// Keeps OpenSubdiv's complaints off standard error: the caller says it in one line of its own.
void ignoreFarMessage(Far::ErrorType, const char*) {}
void ignoreFarWarning(const char*) {}
void silenceFar() {
    static const bool once = [] { // surfaces are made on several threads
        Far::SetErrorCallback(ignoreFarMessage);
        Far::SetWarningCallback(ignoreFarWarning);
        return true;
    }();
    (void)once;
}

} // namespace

glm::vec2 FaceSurface::vertexCoord(int vertex) const {
    glm::vec2 uv;
    parameterization(size_).GetVertexCoord(vertex, &uv.x);
    return uv;
}

glm::vec2 FaceSurface::edgeCoord(int edge, float t) const {
    glm::vec2 uv;
    parameterization(size_).GetEdgeCoord(edge, t, &uv.x);
    return uv;
}

glm::vec2 FaceSurface::fromSubFace(int subFace, glm::vec2 st) const {
    if (!hasSubFaces()) return st;
    glm::vec2 uv;
    parameterization(size_).ConvertNormalizedSubFaceToCoord(subFace, &st.x, &uv.x);
    return uv;
}

int FaceSurface::toSubFace(glm::vec2 uv, glm::vec2& st) const {
    st = uv;
    if (!hasSubFaces()) return 0;
    return parameterization(size_).ConvertCoordToNormalizedSubFace(&uv.x, &st.x);
}

glm::vec2 FaceSurface::uvAt(glm::vec2 coord, std::span<const glm::vec2> corners) const {
    std::array<glm::vec2, 4> q{};
    glm::vec2 st = coord;
    if (hasSubFaces()) {
        const int n = size(), i = toSubFace(coord, st);
        const auto corner = [&](int k) { return corners[std::size_t((k + n) % n)]; };
        glm::vec2 centre(0);
        for (const glm::vec2 uv : corners) centre += uv / float(n);
        q = {corner(i), 0.5f * (corner(i) + corner(i + 1)), centre,
             0.5f * (corner(i) + corner(i - 1))};
    } else {
        std::copy(corners.begin(), corners.end(), q.begin());
    }
    return glm::mix(glm::mix(q[0], q[1], st.x), glm::mix(q[3], q[2], st.x), st.y);
}

std::array<glm::vec2, 4> FaceSurface::kite(int subFace) const {
    const float step = 2 * std::numbers::pi_v<float> / float(size_);
    const auto corner = [&](int k) {
        return glm::vec2(std::cos(float(k) * step), std::sin(float(k) * step));
    };
    return {corner(subFace), 0.5f * (corner(subFace) + corner(subFace + 1)), glm::vec2(0),
            0.5f * (corner(subFace) + corner(subFace - 1))};
}

glm::vec2 FaceSurface::layout(glm::vec2 uv) const {
    if (!hasSubFaces()) return uv;
    glm::vec2 st;
    const auto q = kite(toSubFace(uv, st));
    return glm::mix(glm::mix(q[0], q[1], st.x), glm::mix(q[3], q[2], st.x), st.y);
}

int FaceSurface::subFaceOfLayout(glm::vec2 point) const {
    if (!hasSubFaces()) return 0;
    const float step = 2 * std::numbers::pi_v<float> / float(size_);
    const int nearest = int(std::lround(std::atan2(point.y, point.x) / step));
    return (nearest % size_ + size_) % size_;
}

glm::vec2 FaceSurface::subFaceCoordinate(int subFace, glm::vec2 point) const {
    if (!hasSubFaces()) return point;
    const auto q = kite(subFace);
    glm::vec2 st(0.5f);
    for (int i = 0; i < 8; ++i) { // Newton on the bilinear map, which is mild on a kite
        const glm::vec2 du = glm::mix(q[1] - q[0], q[2] - q[3], st.y);
        const glm::vec2 dv = glm::mix(q[3] - q[0], q[2] - q[1], st.x);
        const glm::vec2 p = glm::mix(glm::mix(q[0], q[1], st.x), glm::mix(q[3], q[2], st.x), st.y);
        const float det = du.x * dv.y - du.y * dv.x;
        if (std::abs(det) < 1e-12f) break;
        const glm::vec2 r = point - p;
        st += glm::vec2((r.x * dv.y - r.y * dv.x) / det, (du.x * r.y - du.y * r.x) / det);
    }
    return st;
}

std::array<SurfacePoint, FaceSurface::kChords + 1> FaceSurface::alongEdge(int edge) const {
    std::array<SurfacePoint, kChords + 1> points;
    for (std::size_t i = 0; i < kChords; ++i)
        points[i] = at(edgeCoord(edge, float(i) / float(kChords)));
    // The end of an edge is the start of the next: the domain may jump in between.
    points[kChords] = at(vertexCoord((edge + 1) % size_));
    return points;
}

float FaceSurface::edgeLength(int edge) const {
    const auto points = alongEdge(edge);
    float length = 0;
    for (std::size_t i = 0; i < kChords; ++i)
        length += glm::distance(points[i].position, points[i + 1].position);
    return length;
}

float FaceSurface::edgeBend(int edge) const {
    const auto points = alongEdge(edge);
    float bend = 0;
    for (std::size_t i = 0; i < kChords; ++i)
        bend +=
            std::acos(std::clamp(glm::dot(points[i].normal, points[i + 1].normal), -1.0f, 1.0f));
    return bend;
}

float FaceSurface::extent() const {
    float extent = 0;
    const glm::vec3 first = at(vertexCoord(0)).position;
    const glm::vec3 third = at(vertexCoord(size_ / 2)).position;
    for (int i = 0; i < size_; ++i) {
        const glm::vec3 p = at(vertexCoord(i)).position;
        extent = std::max({extent, glm::distance(first, p), glm::distance(third, p)});
    }
    return extent;
}

double FaceSurface::area() const {
    constexpr int kPieces = 4; // a side of a sub-face
    double area = 0;
    for (int sub = 0; sub < subFaceCount(); ++sub)
        for (int j = 0; j < kPieces; ++j)
            for (int i = 0; i < kPieces; ++i) {
                const auto corner = [&](int a, int b) {
                    const glm::vec2 st(float(i + a) / kPieces, float(j + b) / kPieces);
                    return glm::dvec3(at(fromSubFace(sub, st)).position);
                };
                area += 0.5 * glm::length(glm::cross(corner(1, 1) - corner(0, 0),
                                                     corner(0, 1) - corner(1, 0)));
            }
    return area;
}

DomainPattern FaceSurface::pattern(const std::vector<int>& rates) const {
    Bfr::Tessellation::Options options;
    options.SetFacetSize(4).PreserveQuads(true);
    const Bfr::Tessellation bfr(parameterization(size_), int(rates.size()), rates.data(), options);
    DomainPattern pattern;
    pattern.coords.resize(std::size_t(bfr.GetNumCoords()));
    bfr.GetCoords(reinterpret_cast<float*>(pattern.coords.data()));
    pattern.facets.resize(std::size_t(bfr.GetNumFacets()));
    bfr.GetFacets(reinterpret_cast<int*>(pattern.facets.data()));
    return pattern;
}

struct LimitSurface::Refined {
    explicit Refined(Far::TopologyRefiner* owned) : refiner(owned), factory(*owned) {}
    std::unique_ptr<Far::TopologyRefiner> refiner;
    Bfr::RefinerSurfaceFactory<> factory;
};

LimitSurface::LimitSurface(const SurfaceMesh& mesh) : mesh_(mesh) {
    if (!mesh.subdivided() || mesh.faces.empty()) return;
    if (highestValence(mesh) > kMostValence) {
        understood_ = false;
        return;
    }
    silenceFar();
    if (Far::TopologyRefiner* refiner = makeRefiner(mesh))
        refined_ = std::make_unique<Refined>(refiner);
    else
        understood_ = false;
}

LimitSurface::~LimitSurface() = default;

std::unique_ptr<FaceSurface> LimitSurface::face(std::uint32_t index) const {
    if (!refined_) return polygon(index, mesh_.cornersOf(mesh_.faces[index]));
    Bfr::Surface<float> surface;
    if (!refined_->factory.InitVertexSurface(int(index), &surface)) return nullptr;
    return std::make_unique<SubdivisionFace>(surface, mesh_.points);
}

std::unique_ptr<FaceSurface> LimitSurface::polygon(std::uint32_t index,
                                                   std::span<const std::uint32_t> corners) const {
    return std::make_unique<PolygonSurface>(mesh_, mesh_.faces[index], corners);
}

} // namespace penumbra
