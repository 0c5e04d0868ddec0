#include "radiosity/BuildPatches.h"

#include "radiosity/Contact.h"
#include "radiosity/LightShapes.h"
#include "radiosity/PatchAssembly.h"
#include "radiosity/RayScene.h"
#include "radiosity/SurfaceMesh.h"
#include "radiosity/Tessellation.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <cmath>
#include <map>
#include <numbers>

namespace penumbra {

namespace {

/// A mesh of the scene, or the shape of a light, in its place.
struct Surface {
    SurfaceMesh mesh;
    ObjectId object;
    std::string path;
    const Light* light = nullptr;
    glm::dmat4 toWorld{1.0};
};

std::vector<Surface> placeSurfaces(const PlacedScene& scene, std::vector<MeshData>& lightMeshes) {
    std::vector<Surface> surfaces;
    for (const Placed<Mesh>& mesh : scene.meshes)
        surfaces.push_back(
            {placeSurface(mesh.node->data(), mesh.toWorld), mesh.object, mesh.path, nullptr, {}});
    lightMeshes.reserve(scene.lights.size()); // the surfaces point into it
    for (const Placed<Light>& light : scene.lights) {
        lightMeshes.push_back(lightShapeMesh(*light.node));
        surfaces.push_back({placeSurface(lightMeshes.back(), light.toWorld), light.object,
                            light.path, light.node, light.toWorld});
    }
    return surfaces;
}

const Material& materialOf(const SurfaceMesh& mesh, const SurfaceFace& face) {
    const MeshData& data = *mesh.data;
    return *data.materials[data.faceMaterial.empty() ? 0 : data.faceMaterial[face.source]];
}

/// A point a hair in front of every emitting face.
std::vector<glm::vec3> emitterPoints(const std::vector<Surface>& surfaces) {
    std::vector<glm::vec3> points;
    for (const Surface& surface : surfaces)
        for (const SurfaceFace& face : surface.mesh.faces) {
            if (!materialOf(surface.mesh, face).emissive()) continue;
            glm::vec3 middle(0);
            const auto corners = surface.mesh.cornersOf(face);
            for (std::uint32_t corner : corners)
                middle += surface.mesh.points[corner] / float(corners.size());
            const glm::dvec3 normal = newellNormal(surface.mesh.points, corners);
            const double size = std::sqrt(glm::length(normal));
            points.push_back(middle + glm::vec3(1e-3 * size * glm::normalize(normal)));
        }
    return points;
}

double litArea(const std::vector<Surface>& surfaces) {
    double area = 0;
    for (const Surface& surface : surfaces)
        for (const SurfaceFace& face : surface.mesh.faces)
            area +=
                0.5 * glm::length(newellNormal(surface.mesh.points, surface.mesh.cornersOf(face)));
    return area;
}

/// Emissive faces of one mesh and material are one emitter, in bundles that stay cheap to evaluate.
void addEmitters(const Surface& surface, const Tessellation& tessellation, PatchSet& out) {
    if (surface.light) {
        if (maxChannel(surface.light->luminance()) <= 0) return;
        Emitter emitter = lightEmitter(*surface.light, surface.toWorld);
        emitter.object = surface.object;
        emitter.path = surface.path;
        out.emitters.push_back(std::move(emitter));
        return;
    }
    constexpr std::size_t kMostPolygons = 64;
    std::map<const Material*, std::size_t> open;
    const auto emit = [&](const Material& material, std::vector<glm::vec3> outline) {
        const auto [found, fresh] = open.try_emplace(&material, out.emitters.size());
        if (fresh || out.emitters[found->second].polygons.size() >= kMostPolygons) {
            Emitter emitter;
            emitter.exitance = std::numbers::pi_v<float> * material.emission();
            emitter.object = surface.object;
            emitter.path = surface.path;
            found->second = out.emitters.size();
            out.emitters.push_back(std::move(emitter));
        }
        Emitter& emitter = out.emitters[found->second];
        emitter.area += polygonArea(outline);
        emitter.polygons.push_back(std::move(outline));
    };
    const SurfaceMesh& mesh = surface.mesh;
    if (!mesh.subdivided()) {
        for (const SurfaceFace& face : mesh.faces) {
            if (!materialOf(mesh, face).emissive()) continue;
            std::vector<glm::vec3> outline;
            for (std::uint32_t corner : mesh.cornersOf(face))
                outline.push_back(mesh.points[corner]);
            emit(materialOf(mesh, face), std::move(outline));
        }
        return;
    }
    for (const Cell& cell : tessellation.cells) {
        const Material& material = materialOf(mesh, mesh.faces[cell.face]);
        if (!material.emissive()) continue;
        const auto first = tessellation.outline.begin() + cell.firstCorner;
        emit(material, {first, first + cell.cornerCount});
    }
}

} // namespace

float defaultPatchSize(double area) {
    constexpr double kRoom =
        0.5; // in a larger building people stand as near to things as in a room
    const double size = std::sqrt(std::max(area, 1e-12) / 1650.0);
    return float(size <= kRoom ? size : std::max(kRoom, std::sqrt(area / 6000.0)));
}

BuiltPatches buildPatches(const PlacedScene& scene, const MeshingOptions& options) {
    BuiltPatches built;
    PatchSet& out = built.patches;
    std::vector<MeshData> lightMeshes;
    std::vector<Surface> surfaces = placeSurfaces(scene, lightMeshes);
    const std::vector<glm::vec3> lights = emitterPoints(surfaces);
    std::size_t skipped = 0;
    for (Surface& surface : surfaces) {
        chooseSides(surface.mesh, lights);
        for (glm::vec3 point : surface.mesh.points) out.bounds.add(point);
        if (!surface.light) {
            skipped += surface.mesh.skipped;
            out.polygons += surface.mesh.used;
        }
    }
    out.patchSize = options.patchSize > 0 ? options.patchSize : defaultPatchSize(litArea(surfaces));
    out.elementSize = options.elementSize > 0 ? options.elementSize : out.patchSize / 8;
    out.patchSize = std::max(out.patchSize, out.elementSize);
    out.skin = std::max(1e-5f * out.bounds.diagonal(), 1e-7f);
    out.rayMeshes.resize(scene.objects.size());
    for (const Object& object : scene.objects) out.objectPaths.push_back(object.path);

    PatchAssembly assembly(out);
    for (const Surface& surface : surfaces) {
        bool understood = true;
        const Tessellation tessellation =
            tessellate(surface.mesh, out.patchSize, out.elementSize, understood);
        if (!understood)
            built.warnings.push_back(
                surface.path + ": OpenSubdiv refuses this cage; its polygons are used as they are");
        assembly.add(surface.mesh, tessellation, surface.object);
        addEmitters(surface, tessellation, out);
    }
    assembly.finish(RayScene(out.rayMeshes));
    if (skipped > 0)
        built.warnings.push_back(std::to_string(skipped) +
                                 " faces without area or with too many corners were left out");
    if (out.emitters.empty())
        built.warnings.push_back("the scene has no light: nothing emits, everything will be black");
    return built;
}

} // namespace penumbra
