#include "scenegraph/CreaseNormals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>

#include <glm/trigonometric.hpp>

namespace penumbra {

namespace {

constexpr std::size_t kMaxCorners = 500; // at one point: their pairs are looked at
const double kSmooth = std::cos(glm::radians(kCreaseAngle));
const double kOnePlane = std::cos(glm::radians(0.05)); // a warp that nobody sees

// What a face adds at one of its corners.
struct FaceCorner {
    glm::dvec3 normal; // of the face, unit
    double weight;     // its area [m^2] times its angle here [rad]
};

struct SamePlace {
    std::size_t operator()(glm::vec3 p) const {
        std::size_t hash = 0;
        for (const float value : {p.x, p.y, p.z})
            hash = (hash ^ std::hash<float>{}(value)) * 0x9E3779B97F4A7C15u;
        return hash ^ (hash >> 29);
    }
};

// The number of the first point at each point's place.
std::vector<std::uint32_t> pointsByPlace(const std::vector<glm::vec3>& points) {
    std::unordered_map<glm::vec3, std::uint32_t, SamePlace> first;
    first.reserve(points.size());
    std::vector<std::uint32_t> place;
    place.reserve(points.size());
    for (const glm::vec3 p : points)
        place.push_back(first.try_emplace(p, std::uint32_t(place.size())).first->second);
    return place;
}

double angleBetween(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Newell's (Sutherland, Sproull & Schumacker 1974): its length is twice the area.
glm::dvec3 areaNormal(const std::vector<glm::vec3>& points, std::span<const std::int32_t> face) {
    glm::dvec3 normal(0);
    const glm::dvec3 origin = points[std::size_t(face[0])];
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
        normal += glm::cross(glm::dvec3(points[std::size_t(face[i])]) - origin,
                             glm::dvec3(points[std::size_t(face[i + 1])]) - origin);
    return normal;
}

std::vector<FaceCorner> faceCorners(const MeshData& data) {
    std::vector<FaceCorner> corners;
    corners.reserve(data.faceVertexIndices.size());
    const std::int32_t* at = data.faceVertexIndices.data();
    for (const std::int32_t count : data.faceVertexCounts) {
        const std::span face(at, std::size_t(count));
        at += count;
        const glm::dvec3 normal = areaNormal(data.points, face);
        const double length = glm::length(normal);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const auto point = [&](std::size_t k) {
                return glm::dvec3(data.points[std::size_t(face[k % face.size()])]);
            };
            const double angle =
                angleBetween(point(i + 1) - point(i), point(i + face.size() - 1) - point(i));
            corners.push_back({length > 0 ? normal / length : glm::dvec3(0), length / 2 * angle});
        }
    }
    return corners;
}

// The mean of those around a point that are of one surface with `own`; zero if they are one plane.
glm::vec3 normalAt(const FaceCorner& own, std::span<const std::uint32_t> around,
                   const std::vector<FaceCorner>& corners) {
    glm::dvec3 sum(0);
    bool bent = false;
    for (const std::uint32_t c : around) {
        const double cosine = glm::dot(own.normal, corners[c].normal);
        if (cosine <= kSmooth) continue;
        sum += corners[c].weight * corners[c].normal;
        bent = bent || cosine < kOnePlane;
    }
    const double length = glm::length(sum);
    return bent && length > 0 ? glm::vec3(sum / length) : glm::vec3(0);
}

} // namespace

std::vector<glm::vec3> creaseNormals(const MeshData& data) {
    const std::vector<FaceCorner> corners = faceCorners(data);
    const std::vector<std::uint32_t> place = pointsByPlace(data.points);
    const auto placeOf = [&](std::uint32_t corner) {
        return place[std::size_t(data.faceVertexIndices[corner])];
    };
    std::vector<std::uint32_t> byPlace(corners.size());
    std::iota(byPlace.begin(), byPlace.end(), 0u);
    std::stable_sort(byPlace.begin(), byPlace.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return placeOf(a) < placeOf(b); });
    std::vector<glm::vec3> normals(corners.size(), glm::vec3(0));
    bool anyBent = false;
    for (std::size_t from = 0, to = 0; from < byPlace.size(); from = to) {
        while (to < byPlace.size() && placeOf(byPlace[to]) == placeOf(byPlace[from])) ++to;
        if (to - from > kMaxCorners) continue;
        const auto around = std::span(byPlace).subspan(from, to - from);
        for (const std::uint32_t c : around) {
            normals[c] = normalAt(corners[c], around, corners);
            anyBent = anyBent || normals[c] != glm::vec3(0);
        }
    }
    if (!anyBent) normals.clear();
    return normals;
}

} // namespace penumbra
