// Small scenes made by hand, and the way from a scene to its light.
#pragma once

#include "radiosity/transport/LitScene.h"
#include "scenegraph/Material.h"
#include "tests/scenegraph/SceneParts.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

inline std::shared_ptr<Material> paint(Rgb reflectance, Rgb emission = {}) {
    auto material = std::make_shared<Material>("paint");
    material->setReflectance(reflectance);
    material->setEmission(emission);
    return material;
}

/// The eight corners of a box; bit 0, 1, 2 of the index: upper in x, y, z.
inline std::vector<glm::vec3> boxCorners(glm::vec3 lower, glm::vec3 upper) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 8; ++i)
        points.emplace_back(i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y,
                            i & 4 ? upper.z : lower.z);
    return points;
}

/// Corners of a box's faces, counter-clockwise seen from inside: -x, +x, -y, +y, -z, +z.
inline constexpr std::array<std::array<std::uint32_t, 4>, 6> kBoxFacesInwards{
    {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}};

/// Adds faces of a box to a mesh; `faces` are indices into kBoxFacesInwards.
inline void addBox(MeshData& mesh, glm::vec3 lower, glm::vec3 upper, bool inwards,
                   std::initializer_list<int> faces = {0, 1, 2, 3, 4, 5}) {
    const auto base = std::int32_t(mesh.points.size());
    for (glm::vec3 point : boxCorners(lower, upper)) mesh.points.push_back(point);
    for (int face : faces) {
        mesh.faceVertexCounts.push_back(4);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& corners = kBoxFacesInwards[std::size_t(face)];
            mesh.faceVertexIndices.push_back(base +
                                             std::int32_t(corners[inwards ? k : (4 - k) % 4]));
        }
    }
}

inline MeshData boxData(glm::vec3 lower, glm::vec3 upper, bool inwards,
                        std::shared_ptr<Material> material = paint(Rgb(0.5f))) {
    MeshData mesh;
    addBox(mesh, lower, upper, inwards);
    mesh.materials = {std::move(material)};
    return mesh;
}

inline MeshData polygonData(std::vector<glm::vec3> points,
                            std::shared_ptr<Material> material = paint(Rgb(0.5f))) {
    MeshData mesh;
    mesh.faceVertexCounts = {std::int32_t(points.size())};
    for (std::size_t i = 0; i < points.size(); ++i)
        mesh.faceVertexIndices.push_back(std::int32_t(i));
    mesh.points = std::move(points);
    mesh.materials = {std::move(material)};
    return mesh;
}

/// The rectangle [x0, x1] x [y0, y1] at height z, facing up.
inline MeshData floorData(float x0, float x1, float y0, float y1, float z,
                          std::shared_ptr<Material> material = paint(Rgb(0.5f))) {
    return polygonData({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, std::move(material));
}

/// A mesh as an object of its own.
inline NodePtr object(const std::string& name, MeshData data) {
    return placed(name, glm::dmat4(1.0), {std::make_shared<Mesh>("mesh", std::move(data))});
}

/// A light of luminance 1 nit that faces down from `centre`.
inline NodePtr ceilingLight(glm::vec3 centre, float width, float height, Rgb nits = Rgb(1.0f)) {
    return placed("lamp", moved(centre.x, centre.y, centre.z),
                  {std::make_shared<Light>("light", RectShape{width, height}, nits)});
}

/// Two squares of 0.3 m that emit downwards from 2 m, 2 m apart, with backs of another material
/// that does not: too far from each other to be one emitter in a mesh of patches below a metre.
inline MeshData twoPanels(std::shared_ptr<Material> one, std::shared_ptr<Material> other) {
    MeshData mesh;
    for (const float x : {-1.0f, 1.0f}) {
        addBox(mesh, {x - 0.15f, -0.15f, 2}, {x + 0.15f, 0.15f, 2.02f}, false, {4, 5});
        mesh.faceMaterial.push_back(x < 0 ? 0 : 1);
        mesh.faceMaterial.push_back(2);
    }
    mesh.materials = {std::move(one), std::move(other), paint(Rgb(0.5f))};
    return mesh;
}

/// A scene with everything that is computed from it.
struct Solution {
    Scene scene;
    PlacedScene placed;
    LitScene lit;
    const RayScene& rays;
    const Solver& solver;
    Lighting lighting;

    explicit Solution(Scene from, const MeshingOptions& meshing = {},
                      const SolverOptions& options = {})
        : scene(std::move(from)), placed(placeScene(scene)), lit(placed, meshing, options),
          rays(lit.rays()), solver(lit.solver()) {
        lit.solver().settle();
        lighting = solver.lighting();
    }
    Solution(const Solution&) = delete;
    Solution& operator=(const Solution&) = delete;

    const PatchSet& patches() const { return lit.patches(); }
    /// Illuminance at a vertex [lux].
    Rgb at(std::size_t vertex) const { return lighting.direct[vertex] + lighting.indirect[vertex]; }
};

inline BuiltPatches meshed(const Scene& scene, const MeshingOptions& meshing = {}) {
    return buildPatches(placeScene(scene), meshing);
}

} // namespace penumbra
