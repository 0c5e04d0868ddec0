#include "radiosity/mesh/PatchSet.h"

#include "radiosity/rays/Margins.h"

namespace penumbra {

Receiver placedReceiver(const Receiver& own, const Pose& pose, float skin) {
    Receiver receiver{pose.point(own.position), pose.direction(own.normal)};
    const float lift = hoverAt(skin, receiver.position) - hoverAt(skin, own.position);
    if (lift > 0) receiver.position += lift * receiver.normal;
    return receiver;
}

Emitter placedEmitter(const Emitter& own, const Pose& pose) {
    Emitter emitter = own;
    emitter.centre = pose.point(own.centre);
    emitter.axis = pose.direction(own.axis);
    for (auto& polygon : emitter.polygons)
        for (glm::vec3& corner : polygon) corner = pose.point(corner);
    return emitter;
}

void placeObject(PatchSet& set, ObjectId object, const Pose& pose) {
    ObjectPart& part = set.objects[object.value];
    const ObjectShape& shape = part.shape;
    part.pose = pose;
    for (std::uint32_t i = 0; i < part.vertices.count; ++i)
        set.vertices[part.vertices.first + i] = {
            pose.point(shape.vertices[i].position),
            placedReceiver(shape.vertices[i].receiver, pose, set.skin)};
    for (std::uint32_t i = 0; i < part.nodes.count; ++i)
        set.nodes[part.nodes.first + i] = set.uncoveredNodes[part.nodes.first + i] =
            placedReceiver(shape.nodes[i], pose, set.skin);
    for (std::uint32_t i = 0; i < part.corners.count; ++i)
        set.corners[part.corners.first + i] = pose.point(shape.corners[i]);
    for (std::uint32_t i = 0; i < part.patches.count; ++i) {
        Patch& patch = set.patches[part.patches.first + i];
        patch.centre = pose.point(shape.patches[i].position);
        patch.normal = pose.direction(shape.patches[i].normal);
    }
    for (std::uint32_t i = 0; i < part.emitters.count; ++i) {
        Emitter& emitter = set.emitters[part.emitters.first + i];
        const Rgb exitance = emitter.exitance;
        emitter = placedEmitter(shape.emitters[i], pose);
        emitter.exitance = exitance; // it may have been dimmed since
    }
    RayMesh& rays = set.rayMeshes[object.value];
    for (std::size_t i = 0; i < rays.vertices.size(); ++i)
        rays.vertices[i] = pose.point(shape.rayVertices[i]);
    set.farthest = std::max(set.farthest, magnitude(boundsOf(set, object)));
}

Bounds boundsOf(const PatchSet& set, ObjectId object) {
    Bounds bounds;
    for (glm::vec3 vertex : set.rayMeshes[object.value].vertices) bounds.add(vertex);
    return bounds;
}

} // namespace penumbra
