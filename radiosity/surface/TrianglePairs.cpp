#include "radiosity/surface/TrianglePairs.h"

#include "radiosity/rays/Margins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

/// The longest edge of a triangle.
struct LongestEdge {
    std::uint32_t low = 0, high = 0; ///< points
    std::uint32_t face = 0;
    std::uint32_t start = 0; ///< corner of the face, 0 ... 2: the edge goes on to the next

    auto points() const { return std::tie(low, high); }
    bool operator<(const LongestEdge& other) const {
        return std::tie(low, high, face) < std::tie(other.low, other.high, other.face);
    }
};

/// Longer edges first; of two that are as long, which is first is a matter of where they are.
auto orderOf(glm::vec3 a, glm::vec3 b) {
    const auto place = [](glm::vec3 p) { return std::array<float, 3>{p.x, p.y, p.z}; };
    const glm::vec3 d = b - a;
    return std::tuple(-glm::dot(d, d), std::min(place(a), place(b)), std::max(place(a), place(b)));
}

LongestEdge longestEdge(const SurfaceMesh& mesh, std::uint32_t face) {
    const auto corners = mesh.cornersOf(mesh.faces[face]);
    const auto order = [&](std::uint32_t k) {
        return orderOf(mesh.points[corners[k]], mesh.points[corners[(k + 1) % 3]]);
    };
    std::uint32_t first = 0;
    for (std::uint32_t k = 1; k < 3; ++k)
        if (order(k) < order(first)) first = k;
    const auto [low, high] = std::minmax(corners[first], corners[(first + 1) % 3]);
    return {low, high, face, first};
}

/// Two triangles on either side of their longest edge: corners a, b, c, d of a quadrilateral, of
/// which the first has a, b and c and the second c, d and a.
class Pair {
public:
    Pair(const SurfaceMesh& mesh, const LongestEdge& first, const LongestEdge& second)
        : mesh_(mesh), faces_{mesh.faces[first.face], mesh.faces[second.face]} {
        const auto at = [&](std::size_t f, std::uint32_t k) {
            return faces_[f].firstCorner + k % 3;
        };
        ownedByFirst_ = {at(0, first.start + 1), at(0, first.start + 2), at(0, first.start)};
        ownedBySecond_ = {at(1, second.start + 1), at(1, second.start + 2), at(1, second.start)};
    }

    /// Where the corners of the quadrilateral are in the mesh's lists.
    std::array<std::uint32_t, 4> corners() const {
        return {ownedByFirst_[0], ownedByFirst_[1], ownedByFirst_[2], ownedBySecond_[1]};
    }

    bool isQuadrilateral() const {
        return point(ownedByFirst_[0]) == point(ownedBySecond_[2]) &&
               point(ownedByFirst_[2]) == point(ownedBySecond_[0]) &&
               &mesh_.materialOf(faces_[0]) == &mesh_.materialOf(faces_[1]) && isRegular() &&
               isFlat() && runsOn();
    }

private:
    std::uint32_t point(std::uint32_t corner) const { return mesh_.corners[corner]; }
    glm::dvec3 place(std::uint32_t corner) const { return mesh_.points[point(corner)]; }

    /// Whether edges on opposite sides are about as long: a grid is as fine as the longer ones ask.
    bool isRegular() const {
        const auto at = corners();
        const auto length = [&](std::size_t k) {
            return glm::distance(place(at[k]), place(at[(k + 1) % 4]));
        };
        const auto alike = [](double a, double b) { return std::max(a, b) <= 2 * std::min(a, b); };
        return alike(length(0), length(2)) && alike(length(1), length(3));
    }

    bool isFlat() const {
        constexpr double kFlat = 1e-5; // in units of the edge
        const auto [a, b, c, d] = corners();
        const glm::dvec3 edge = place(c) - place(a);
        const glm::dvec3 normal = glm::cross(place(b) - place(a), edge);
        const glm::dvec3 other = glm::cross(edge, place(d) - place(a));
        if (!(glm::dot(normal, other) > 0)) return false; // folded over
        const double off = std::abs(glm::dot(glm::normalize(normal), place(d) - place(a)));
        return off <= kFlat * glm::length(edge) +
                          2 * double(roundingAt(magnitude(mesh_.points[point(d)])));
    }

    /// Whether what the corners have is the same on both sides of the edge and, of texture
    /// coordinates, goes on beyond it as it is before it: or a quadrilateral would bend them.
    bool runsOn() const {
        const auto same = [&](const auto& values) {
            return values.empty() || (values[ownedByFirst_[0]] == values[ownedBySecond_[2]] &&
                                      values[ownedByFirst_[2]] == values[ownedBySecond_[0]]);
        };
        if (!same(mesh_.uvs) || !same(mesh_.normals)) return false;
        if (mesh_.uvs.empty()) return true;
        const auto [a, b, c, d] = corners();
        constexpr double kBend = 1e-3; // in units of what they span
        const glm::dvec3 u = place(b) - place(a), v = place(c) - place(a), w = place(d) - place(a);
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
        const double det = uu * vv - uv * uv, wu = glm::dot(w, u), wv = glm::dot(w, v);
        const glm::dvec2 s((vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det);
        const glm::dvec2 ua = mesh_.uvs[a], along = glm::dvec2(mesh_.uvs[b]) - ua,
                         across = glm::dvec2(mesh_.uvs[c]) - ua;
        const glm::dvec2 off = ua + s.x * along + s.y * across - glm::dvec2(mesh_.uvs[d]);
        return glm::length(off) <= kBend * (glm::length(along) + glm::length(across));
    }

    const SurfaceMesh& mesh_;
    std::array<SurfaceFace, 2> faces_;
    std::array<std::uint32_t, 3> ownedByFirst_{}, ownedBySecond_{};
};

} // namespace

void joinTriangles(SurfaceMesh& mesh) {
    std::vector<LongestEdge> edges;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        if (mesh.faces[f].cornerCount == 3) edges.push_back(longestEdge(mesh, f));
    std::sort(edges.begin(), edges.end());
    std::vector<std::array<std::uint32_t, 4>> quads; // of `joined`
    constexpr std::uint32_t kAlone = 0xffffffffu, kGone = 0xfffffffeu;
    std::vector<std::uint32_t> joined(mesh.faces.size(), kAlone);
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last = std::find_if(first, edges.end(), [&](const LongestEdge& e) {
            return e.points() != first->points();
        });
        if (last - first == 2) { // of more than two, which belong together is anyone's guess
            const Pair pair(mesh, first[0], first[1]);
            if (pair.isQuadrilateral()) {
                joined[first[0].face] = std::uint32_t(quads.size());
                joined[first[1].face] = kGone;
                quads.push_back(pair.corners());
            }
        }
        first = last;
    }
    if (quads.empty()) return;

    SurfaceMesh out = mesh;
    out.faces.clear(), out.corners.clear(), out.uvs.clear(), out.normals.clear();
    const auto take = [&](std::uint32_t corner) {
        out.corners.push_back(mesh.corners[corner]);
        if (!mesh.uvs.empty()) out.uvs.push_back(mesh.uvs[corner]);
        if (!mesh.normals.empty()) out.normals.push_back(mesh.normals[corner]);
    };
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        if (joined[f] == kGone) continue;
        SurfaceFace face = mesh.faces[f];
        const std::uint32_t from =
            std::exchange(face.firstCorner, std::uint32_t(out.corners.size()));
        if (joined[f] == kAlone) {
            for (std::uint32_t k = 0; k < face.cornerCount; ++k) take(from + k);
        } else {
            for (const std::uint32_t corner : quads[joined[f]]) take(corner);
            face.cornerCount = 4;
        }
        out.faces.push_back(face);
    }
    mesh = std::move(out);
}

} // namespace penumbra
