#include "radiosity/mesh/LightShapes.h"

#include "scenegraph/Light.h"

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kDiskCorners = 64;
constexpr int kSphereSegments = 24, kSphereRings = 12;

void addFace(MeshData& mesh, std::initializer_list<int> corners) {
    mesh.faceVertexCounts.push_back(std::int32_t(corners.size()));
    mesh.faceVertexIndices.insert(mesh.faceVertexIndices.end(), corners.begin(), corners.end());
}

/// All shapes of lights that lie in the XY plane emit towards -Z: counter-clockwise seen from
/// there.
void addShape(MeshData& mesh, const RectShape& rect) {
    const float x = rect.width / 2, y = rect.height / 2;
    mesh.points = {{-x, -y, 0}, {-x, y, 0}, {x, y, 0}, {x, -y, 0}};
    addFace(mesh, {0, 1, 2, 3});
}

void addShape(MeshData& mesh, const DiskShape& disk) {
    mesh.faceVertexCounts.push_back(kDiskCorners);
    for (int i = 0; i < kDiskCorners; ++i) {
        const double angle = -2 * kPi * i / kDiskCorners;
        mesh.points.emplace_back(disk.radius * std::cos(angle), disk.radius * std::sin(angle), 0);
        mesh.faceVertexIndices.push_back(i);
    }
}

void addShape(MeshData& mesh, const SphereShape& sphere) {
    for (int ring = 1; ring < kSphereRings; ++ring)
        for (int i = 0; i < kSphereSegments; ++i) {
            const double polar = kPi * ring / kSphereRings, angle = 2 * kPi * i / kSphereSegments;
            mesh.points.emplace_back(sphere.radius * std::sin(polar) * std::cos(angle),
                                     sphere.radius * std::sin(polar) * std::sin(angle),
                                     sphere.radius * std::cos(polar));
        }
    const int top = int(mesh.points.size()), bottom = top + 1;
    mesh.points.emplace_back(0, 0, sphere.radius);
    mesh.points.emplace_back(0, 0, -sphere.radius);
    const auto at = [](int ring, int i) {
        return (ring - 1) * kSphereSegments + i % kSphereSegments;
    };
    for (int i = 0; i < kSphereSegments; ++i) {
        addFace(mesh, {top, at(1, i), at(1, i + 1)});
        for (int ring = 1; ring + 1 < kSphereRings; ++ring)
            addFace(mesh, {at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i + 1)});
        addFace(mesh, {bottom, at(kSphereRings - 1, i + 1), at(kSphereRings - 1, i)});
    }
}

/// Whether the frame keeps angles, at least in the plane (count 2) or in space (3).
bool keepsShape(const glm::dmat4& toWorld, int axes, double& scale) {
    scale = glm::length(glm::dvec3(toWorld[0]));
    for (int i = 0; i < axes; ++i) {
        if (std::abs(glm::length(glm::dvec3(toWorld[i])) - scale) > 1e-5 * scale) return false;
        for (int j = 0; j < i; ++j)
            if (std::abs(glm::dot(glm::dvec3(toWorld[i]), glm::dvec3(toWorld[j]))) >
                1e-5 * scale * scale)
                return false;
    }
    return true;
}

} // namespace

MeshData lightShapeMesh(const Light& light) {
    MeshData mesh;
    std::visit([&](const auto& shape) { addShape(mesh, shape); }, light.shape());
    auto material = std::make_shared<Material>(light.name());
    material->setReflectance(Rgb(0.0f));
    material->setEmission(light.luminance());
    mesh.materials.push_back(std::move(material));
    return mesh;
}

Emitter lightEmitter(const Light& light, const glm::dmat4& toWorld) {
    Emitter emitter;
    emitter.exitance = lambertianExitance(light.luminance());
    emitter.centre = glm::vec3(toWorld[3]);
    const auto* disk = std::get_if<DiskShape>(&light.shape());
    const auto* sphere = std::get_if<SphereShape>(&light.shape());
    double scale = 1;
    if (disk && keepsShape(toWorld, 2, scale)) {
        emitter.kind = Emitter::Kind::disk;
        emitter.radius = float(disk->radius * scale);
        glm::dvec3 axis =
            glm::normalize(glm::cross(glm::dvec3(toWorld[1]), glm::dvec3(toWorld[0])));
        if (glm::determinant(glm::dmat3(toWorld)) < 0)
            axis = -axis; // -Z, mirrored along with the rest
        emitter.axis = glm::vec3(axis);
        emitter.area = kPi * emitter.radius * emitter.radius;
    } else if (sphere && keepsShape(toWorld, 3, scale)) {
        emitter.kind = Emitter::Kind::sphere;
        emitter.radius = float(sphere->radius * scale);
        emitter.area = 4 * kPi * emitter.radius * emitter.radius;
    } else {
        const MeshData mesh = lightShapeMesh(light);
        const bool mirrored = glm::determinant(glm::dmat3(toWorld)) < 0;
        std::size_t first = 0;
        for (std::int32_t count : mesh.faceVertexCounts) {
            std::vector<glm::vec3> polygon;
            for (std::size_t i = 0; i < std::size_t(count); ++i) {
                const std::size_t k = mirrored ? std::size_t(count) - 1 - i : i;
                const glm::vec3 point = mesh.points[std::size_t(mesh.faceVertexIndices[first + k])];
                polygon.emplace_back(glm::vec3(toWorld * glm::dvec4(glm::dvec3(point), 1.0)));
            }
            first += std::size_t(count);
            emitter.area += polygonArea(polygon);
            emitter.polygons.push_back(std::move(polygon));
        }
    }
    return emitter;
}

glm::dvec3 areaVector(std::span<const glm::vec3> polygon) {
    glm::dvec3 sum(0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(glm::dvec3(polygon[i - 1]) - glm::dvec3(polygon[0]),
                          glm::dvec3(polygon[i]) - glm::dvec3(polygon[0]));
    return 0.5 * sum;
}

double polygonArea(std::span<const glm::vec3> polygon) {
    return glm::length(areaVector(polygon));
}

} // namespace penumbra
