#include "radiosity/PatchSet.h"

namespace penumbra {

namespace {

Receiver placed(const Receiver& receiver, const Pose& pose) {
    return {pose.point(receiver.position), pose.direction(receiver.normal)};
}

} // namespace

void placeObject(PatchSet& set, ObjectId object, const Pose& pose) {
    ObjectPart& part = set.objects[object.value];
    const ObjectShape& shape = part.shape;
    part.pose = pose;
    for (std::uint32_t i = 0; i < part.vertices.count; ++i)
        set.vertices[part.vertices.first + i] = {pose.point(shape.vertices[i].position),
                                                 placed(shape.vertices[i].receiver, pose)};
    for (std::uint32_t i = 0; i < part.nodes.count; ++i)
        set.nodes[part.nodes.first + i] = set.uncoveredNodes[part.nodes.first + i] =
            placed(shape.nodes[i], pose);
    for (std::uint32_t i = 0; i < part.corners.count; ++i)
        set.corners[part.corners.first + i] = pose.point(shape.corners[i]);
    for (std::uint32_t i = 0; i < part.patches.count; ++i) {
        Patch& patch = set.patches[part.patches.first + i];
        patch.centre = pose.point(shape.patches[i].position);
        patch.normal = pose.direction(shape.patches[i].normal);
    }
    for (std::uint32_t i = 0; i < part.emitters.count; ++i) {
        Emitter& emitter = set.emitters[part.emitters.first + i];
        const Emitter& own = shape.emitters[i];
        emitter.centre = pose.point(own.centre);
        emitter.axis = pose.direction(own.axis);
        for (std::size_t p = 0; p < own.polygons.size(); ++p)
            for (std::size_t k = 0; k < own.polygons[p].size(); ++k)
                emitter.polygons[p][k] = pose.point(own.polygons[p][k]);
    }
    RayMesh& rays = set.rayMeshes[object.value];
    for (std::size_t i = 0; i < rays.vertices.size(); ++i)
        rays.vertices[i] = pose.point(shape.rayVertices[i]);
}

Bounds boundsOf(const PatchSet& set, ObjectId object) {
    Bounds bounds;
    for (glm::vec3 vertex : set.rayMeshes[object.value].vertices) bounds.add(vertex);
    return bounds;
}

} // namespace penumbra
