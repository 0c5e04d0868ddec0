// Ray-triangle test after T. Moeller & B. Trumbore, "Fast, minimum storage ray/triangle
// intersection", JGT 2(1), 1997.
#include "scenegraph/Picking.h"

#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace penumbra {

namespace {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction; // not unit: keeps the parameter t the same in every frame
};

constexpr double kMiss = std::numeric_limits<double>::infinity();

double meetTriangle(const Ray& ray, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 ab = b - a, ac = c - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double det = glm::dot(ab, p);
    if (det == 0) return kMiss;
    const glm::dvec3 s = ray.origin - a;
    const double u = glm::dot(s, p) / det;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(ray.direction, q) / det;
    if (u < 0 || v < 0 || u + v > 1) return kMiss;
    const double t = glm::dot(ac, q) / det;
    return t > 0 ? t : kMiss;
}

bool meetsBox(const Ray& ray, const Bounds& box) {
    double t0 = 0, t1 = kMiss;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) {
            if (ray.origin[axis] < box.lower[axis] || ray.origin[axis] > box.upper[axis])
                return false;
            continue;
        }
        double a = (box.lower[axis] - ray.origin[axis]) / ray.direction[axis];
        double b = (box.upper[axis] - ray.origin[axis]) / ray.direction[axis];
        if (a > b) std::swap(a, b);
        t0 = std::max(t0, a);
        t1 = std::min(t1, b);
    }
    return t0 <= t1;
}

/// Meets a face as a fan of triangles around its first corner. Where the face is concave the fan
/// folds back over itself and triangles turned against the face take away what they cover: the ray
/// meets the face if its triangles do not cancel out.
double meetFace(const Ray& ray, const MeshData& data, std::span<const std::int32_t> corners) {
    const auto point = [&](std::size_t i) {
        return glm::dvec3(data.points[std::size_t(corners[i])]);
    };
    if (corners.size() == 3) return meetTriangle(ray, point(0), point(1), point(2));
    const auto fanNormal = [&](std::size_t i) {
        return glm::cross(point(i - 1) - point(0), point(i) - point(0));
    };
    glm::dvec3 normal(0);
    for (std::size_t i = 2; i < corners.size(); ++i) normal += fanNormal(i);

    double nearest = kMiss;
    int layers = 0;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const double t = meetTriangle(ray, point(0), point(i - 1), point(i));
        if (t == kMiss) continue;
        nearest = std::min(nearest, t);
        layers += glm::dot(fanNormal(i), normal) > 0 ? 1 : -1;
    }
    return layers != 0 ? nearest : kMiss;
}

bool isHole(const MeshData& data, std::size_t face) {
    if (data.scheme == SubdivisionScheme::none) return false;
    return std::find(data.holes.begin(), data.holes.end(), std::int32_t(face)) != data.holes.end();
}

double meetMesh(const Ray& ray, const Mesh& mesh) {
    if (!meetsBox(ray, mesh.bounds())) return kMiss;
    const MeshData& data = mesh.data();
    double nearest = kMiss;
    std::size_t first = 0;
    for (std::size_t face = 0; face < mesh.faceCount(); ++face) {
        const auto count = std::size_t(data.faceVertexCounts[face]);
        const double t =
            meetFace(ray, data, std::span(data.faceVertexIndices).subspan(first, count));
        if (t < nearest && !isHole(data, face)) nearest = t;
        first += count;
    }
    return nearest;
}

double meetShape(const Ray& ray, const RectShape& rect) {
    const double t = -ray.origin.z / ray.direction.z;
    const glm::dvec3 p = ray.origin + t * ray.direction;
    const bool inside = std::abs(p.x) <= rect.width / 2 && std::abs(p.y) <= rect.height / 2;
    return t > 0 && inside ? t : kMiss;
}

double meetShape(const Ray& ray, const DiskShape& disk) {
    const double t = -ray.origin.z / ray.direction.z;
    const glm::dvec3 p = ray.origin + t * ray.direction;
    return t > 0 && std::hypot(p.x, p.y) <= disk.radius ? t : kMiss;
}

double meetShape(const Ray& ray, const SphereShape& sphere) {
    const double a = glm::dot(ray.direction, ray.direction);
    const double b = glm::dot(ray.origin, ray.direction);
    const double c = glm::dot(ray.origin, ray.origin) - double(sphere.radius) * sphere.radius;
    const double root = b * b - a * c;
    if (root < 0) return kMiss;
    const double t = (-b - std::sqrt(root)) / a;
    return t > 0 ? t : kMiss;
}

} // namespace

std::optional<Pick> pick(const PlacedScene& scene, glm::vec3 origin, glm::vec3 direction) {
    double nearest = kMiss;
    Pick best;
    const auto consider = [&](const auto& placed, auto meet) {
        const glm::dmat4 toLocal = glm::inverse(placed.toWorld);
        const Ray local{glm::dvec3(toLocal * glm::dvec4(origin, 1)),
                        glm::dvec3(toLocal * glm::dvec4(direction, 0))};
        const double t = meet(local, *placed.node);
        if (!(t < nearest)) return;
        nearest = t;
        best.object = placed.object;
        best.path = placed.path;
    };
    for (const auto& mesh : scene.meshes) consider(mesh, meetMesh);
    for (const auto& light : scene.lights)
        consider(light, [](const Ray& ray, const Light& node) {
            return std::visit([&](const auto& shape) { return meetShape(ray, shape); },
                              node.shape());
        });
    if (nearest == kMiss) return std::nullopt;
    best.distance = float(nearest * glm::length(glm::dvec3(direction)));
    best.position = origin + float(nearest) * direction;
    return best;
}

} // namespace penumbra
