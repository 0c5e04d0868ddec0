#include "radiosity/query/SceneRays.h"

#include "radiosity/mesh/Emitters.h"
#include "radiosity/surface/FaceTriangles.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <limits>

namespace penumbra {

namespace {

/// The reach of rays is in units of their direction, in floats.
constexpr double kFarthest = 1e7;

} // namespace

SceneRays::SceneRays(const PlacedScene& scene) {
    build(scene);
}

void SceneRays::build(const PlacedScene& scene) {
    parts_.assign(scene.objects.size(), {});
    std::vector<RayMesh> meshes(scene.objects.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].path = scene.objects[i].path;
        parts_[i].toWorld = scene.objects[i].toWorld;
        parts_[i].visible = scene.objects[i].visible;
    }
    const auto add = [&](const auto& place, const MeshData& data, const Mesh* mesh,
                         const Light* light) {
        Part& part = parts_[place.object.value];
        RayMesh& ray = meshes[place.object.value];
        const auto first = std::uint32_t(part.local.size());
        for (const glm::vec3 point : data.points) // radiosity says which faces are left out
            part.local.push_back(canBeTraced(point)
                                     ? glm::vec3(place.toObject * glm::dvec4(point, 1))
                                     : glm::vec3(0));
        Piece& piece = part.pieces.emplace_back(Piece{
            mesh, light, place.path, place.toObject, std::uint32_t(ray.triangles.size()), {}});
        const FaceTriangles triangles = faceTriangles(data);
        const auto somewhere = [&](std::size_t i) {
            return canBeTraced(data.points[triangles.indices[i]]);
        };
        for (const MaterialRange& range : triangles.ranges)
            for (std::size_t i = range.firstIndex; i < range.firstIndex + range.indexCount;
                 i += 3) {
                if (!somewhere(i) || !somewhere(i + 1) || !somewhere(i + 2)) continue;
                ray.triangles.push_back({first + triangles.indices[i],
                                         first + triangles.indices[i + 1],
                                         first + triangles.indices[i + 2]});
                piece.materials.push_back(std::uint16_t(range.material));
            }
    };
    for (const auto& mesh : scene.meshes) add(mesh, mesh.node->data(), mesh.node, nullptr);
    for (const auto& light : scene.lights)
        add(light, lightShapeMesh(*light.node), nullptr, light.node);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        meshes[i].vertices = placed(parts_[i]);
    }
    rays_ = std::make_unique<RayScene>(meshes);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (!parts_[i].visible) rays_->show(ObjectId{std::uint32_t(i)}, false);
    rays_->commit();
}

std::vector<glm::vec3> SceneRays::placed(const Part& part) {
    std::vector<glm::vec3> world;
    world.reserve(part.local.size());
    for (const glm::vec3 point : part.local)
        world.push_back(glm::vec3(part.toWorld * glm::dvec4(point, 1)));
    return world;
}

bool SceneRays::sameStructure(const PlacedScene& scene) const {
    if (scene.objects.size() != parts_.size()) return false;
    std::vector<std::size_t> next(parts_.size(), 0);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (parts_[i].path != scene.objects[i].path) return false;
    const auto same = [&](const auto& place, const Mesh* mesh, const Light* light) {
        const Part& part = parts_[place.object.value];
        const std::size_t at = next[place.object.value]++;
        return at < part.pieces.size() && part.pieces[at].mesh == mesh &&
               part.pieces[at].light == light && part.pieces[at].toObject == place.toObject;
    };
    for (const auto& mesh : scene.meshes)
        if (!same(mesh, mesh.node, nullptr)) return false;
    for (const auto& light : scene.lights)
        if (!same(light, nullptr, light.node)) return false;
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (next[i] != parts_[i].pieces.size()) return false;
    return true;
}

void SceneRays::follow(const PlacedScene& scene) {
    if (!sameStructure(scene)) {
        build(scene);
        return;
    }
    bool changed = false;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        const Object& object = scene.objects[i];
        const ObjectId id{std::uint32_t(i)};
        if (part.toWorld != object.toWorld) {
            part.toWorld = object.toWorld;
            rays_->move(id, placed(part));
            changed = true;
        }
        if (part.visible != object.visible) {
            part.visible = object.visible;
            rays_->show(id, part.visible);
            changed = true;
        }
    }
    if (changed) rays_->commit();
}

const SceneRays::Piece& SceneRays::pieceAt(const RayHit& hit) const {
    const Part& part = parts_[hit.object.value];
    const auto after = std::upper_bound(
        part.pieces.begin(), part.pieces.end(), hit.triangle,
        [](std::uint32_t triangle, const Piece& piece) { return triangle < piece.firstTriangle; });
    return *(after - 1);
}

/// In mirrored frames the sides keep their meaning.
bool SceneRays::isSeen(const RayHit& hit, glm::dvec3 direction) const {
    const Piece& piece = pieceAt(hit);
    if (!piece.mesh || piece.mesh->data().doubleSided) return true;
    const glm::dmat3 toWorld(parts_[hit.object.value].toWorld * piece.toObject);
    const double facing = glm::dot(glm::dvec3(hit.normal), direction);
    return glm::determinant(toWorld) < 0 ? facing > 0 : facing < 0;
}

Touch SceneRays::describe(const RayHit& hit, glm::dvec3 from, glm::dvec3 direction) const {
    const Piece& piece = pieceAt(hit);
    Touch touch;
    touch.object = hit.object;
    touch.mesh = piece.mesh;
    touch.light = piece.light;
    touch.path = piece.path;
    if (piece.mesh)
        touch.material =
            piece.mesh->data().materials[piece.materials[hit.triangle - piece.firstTriangle]];
    touch.position = from + double(hit.distance) * direction;
    touch.normal = glm::normalize(glm::dvec3(hit.normal));
    if (glm::dot(touch.normal, direction) > 0) touch.normal = -touch.normal;
    touch.distance = double(hit.distance) * glm::length(direction);
    return touch;
}

std::optional<Touch> SceneRays::touch(glm::dvec3 from, glm::dvec3 direction, double reach,
                                      ObjectId except) const {
    const glm::dvec3 unit = glm::normalize(direction);
    const float longest = float(std::min(reach, kFarthest));
    if (!except.valid()) {
        const RayHit hit = rays_->nearest(glm::vec3(from), glm::vec3(unit), longest);
        if (!hit.met()) return std::nullopt;
        return describe(hit, from, unit);
    }
    std::vector<RayHit> hits;
    rays_->all(glm::vec3(from), glm::vec3(unit), longest, hits);
    const RayHit* nearest = nullptr;
    for (const RayHit& hit : hits)
        if (hit.object != except && hit.distance <= longest &&
            (!nearest || hit.distance < nearest->distance))
            nearest = &hit;
    if (!nearest) return std::nullopt;
    return describe(*nearest, from, unit);
}

std::optional<Touch> SceneRays::seen(glm::dvec3 from, glm::dvec3 direction, double reach) const {
    const glm::dvec3 unit = glm::normalize(direction);
    std::vector<RayHit> hits;
    rays_->all(glm::vec3(from), glm::vec3(unit), float(std::min(reach, kFarthest)), hits);
    std::erase_if(hits, [&](const RayHit& hit) { return !isSeen(hit, unit); });
    const auto nearest =
        std::min_element(hits.begin(), hits.end(),
                         [](const RayHit& a, const RayHit& b) { return a.distance < b.distance; });
    if (nearest == hits.end()) return std::nullopt;
    return describe(*nearest, from, unit);
}

std::optional<Surroundings::Obstacle> SceneRays::ahead(glm::dvec3 from, glm::dvec3 direction,
                                                       double reach) const {
    const auto found = touch(from, direction, reach);
    if (!found) return std::nullopt;
    return Obstacle{found->distance, found->normal};
}

Bounds SceneRays::bounds(ObjectId object) const {
    Bounds box;
    for (const glm::vec3 point : placed(parts_[object.value])) box.add(point);
    return box;
}

} // namespace penumbra
