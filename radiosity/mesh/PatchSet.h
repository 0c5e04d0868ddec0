// The scene as flat arrays: patches that send light, elements that receive and show it.
#pragma once

#include "base/Bounds.h"
#include "base/ObjectId.h"
#include "base/Rgb.h"
#include "radiosity/mesh/Pose.h"
#include "radiosity/mesh/RayElements.h"
#include "radiosity/rays/RayMesh.h"
#include "scenegraph/LitGeometry.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// A point at which light is received.
struct Receiver {
    glm::vec3 position; ///< a hair in front of the surface, clear of edges and obstacles [m, world]
    glm::vec3 normal;   ///< unit, towards the lit side
};
/// Fills up a block of receivers, or is free to be handed out: nothing is there.
inline bool isPadding(const Receiver& receiver) {
    return receiver.normal == glm::vec3(0);
}

/// A corner of elements: drawn at `position`, lit at `receiver`. The two differ by a hair, or by up
/// to an element where the corner itself is covered by another object (see Contact.h).
struct Vertex {
    glm::vec3 position;
    Receiver receiver;
};

/// Where a vertex lies in its patch, for interpolating what is known at the patch's nodes.
struct PatchCoordinate {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::uint32_t patch = kNone; ///< kNone: in none, covered all round
    float s = 0, t = 0;          ///< in [0, 1]
    std::uint32_t blend = kNone; ///< of PatchSet::blends; kNone: the patch's own nodes are enough
};

/// A mean over the middle nodes of patches that lie around a vertex of a dense mesh.
struct NodeBlend {
    std::array<std::uint32_t, 4> patches{};
    std::array<float, 4> weights{}; ///< at least 0; those that are 0 come last
};

/// Receivers of a dense mesh around one of its vertices that is none, and their weights: together
/// 1, or all 0 where there is none.
struct VertexBlend {
    std::array<std::uint32_t, 4> vertices{};
    std::array<float, 4> weights{}; ///< at least 0; those that are 0 come last
};

/// A fine cell: a quadrilateral, or a triangle when the last two corners are the same.
struct Element {
    std::array<std::uint32_t, 4> vertices; ///< counter-clockwise seen from its front
    std::uint32_t patch = kNone;           ///< kNone: covered all over, takes part in nothing
    std::uint32_t material = 0;            ///< index into PatchSet::materials

    static constexpr std::uint32_t kNone = 0xffffffffu;
    bool isTriangle() const { return vertices[2] == vertices[3]; }
};

/// A coarse cell that sends light, one-sided: a face or a part of one, or a cluster of small faces
/// that lie together and look about the same way.
struct Patch {
    /// Its outline: PatchSet::corners[first ... first + count). A cluster has none.
    std::uint32_t firstCorner = 0;
    std::uint32_t cornerCount = 0;
    std::uint32_t firstElement =
        0; ///< its elements: PatchSet::patchElements[first ... first + count)
    std::uint32_t elementCount = 0;
    std::array<std::uint32_t, 4> cornerNodes{}; ///< nodes at its four corners, if hasCornerNodes
    std::uint32_t centreNode = 0;
    bool hasCornerNodes = false;
    bool divisible = false;      ///< a quadrilateral with coordinates: contacts may part it
    bool smooth = false;         ///< of a subdivision surface
    bool cluster = false;        ///< its elements come in an order in which near ones are near
    bool far = false;            ///< of a backdrop so large that it is cut coarser than the rest
    std::uint32_t firstNear = 0; ///< clusters that it touches: of PatchSet::nearClusters
    std::uint32_t nearCount = 0;
    glm::vec3 centre{};
    glm::vec3 normal{}; ///< unit, area-weighted mean
    float area = 0;     ///< of its elements [m^2]
    std::uint32_t material = 0;
    ObjectId object;
};

/// An emitter's shape as senders of direct light see it.
struct Emitter {
    enum class Kind { polygons, disk, sphere };
    Kind kind = Kind::polygons;
    Rgb exitance; ///< [lm/m^2]
    std::vector<std::vector<glm::vec3>>
        polygons;       ///< outlines, counter-clockwise seen from the front
    glm::vec3 centre{}; ///< of a disk or sphere
    glm::vec3 axis{};   ///< of a disk: unit normal of the emitting side
    float radius = 0;   ///< of a disk or sphere [m]
    double area = 0;    ///< emitting area [m^2]
    Rgb texture{1};     ///< mean of its part of a texture: exitance has this as a factor
    ObjectId object;
    std::string path; ///< of the light or mesh in the scene
};

/// An emissive mesh of which all emitting faces have one luminance, and its emitters.
struct EmissiveMesh {
    std::string path;
    /// As they send direct light: see PatchSet::emitters. Their exitances are the scene's affair.
    std::vector<Emitter> emitters;
};

/// A run of consecutive indices.
struct Range {
    std::uint32_t first = 0, count = 0;
    std::uint32_t end() const { return first + count; }
    bool contains(std::uint32_t index) const { return index - first < count; }
};

/// A large convex face, see Walls.h.
struct Wall {
    ObjectId object;
    glm::vec3 normal{};             ///< unit
    std::vector<glm::vec3> outline; ///< counter-clockwise around the normal [m]
};

/// Geometry of an object in its own stretched frame (see Pose.h), in the order of its ranges.
struct ObjectShape {
    std::vector<Vertex> vertices;
    std::vector<glm::vec3> corners;
    std::vector<Receiver> nodes;
    std::vector<Receiver> patches; ///< centres and normals
    std::vector<Emitter> emitters;
    std::vector<Wall> walls;
    std::vector<glm::vec3> rayVertices;
    RayElements rayElements; ///< empty in a set that a viewer was given
};

/// One rigid piece of the scene, and where its share of a PatchSet's arrays lies.
struct ObjectPart {
    std::string path;      ///< empty: it is not in the scene any more, nor will it be
    std::uint64_t key = 0; ///< of its path: the same in every scene that has it
    bool present = true;   ///< false: hidden, neither blocks nor sends nor receives
    bool removed = false;  ///< hidden because it is not in the scene any more
    Pose pose;
    glm::dmat3 stretch{1.0};
    Range vertices, elements, patches, nodes, corners, emitters, walls;
    ObjectShape shape;
};

/// What textures say of elements and patches, found once, when the scene is meshed. All of it is
/// empty if no surface has a texture of reflectance or emission.
struct SurfaceTextures {
    std::vector<std::array<glm::vec2, 4>> uvs; ///< of the corners of each element
    /// Mean reflectance over each, as a factor of that of its material; 1 without a texture.
    std::vector<Rgb> elements, patches;
};

/// How patches are parted where other things cut through them (a partition that stands on the
/// floor), and which nodes are split there. Kept up to date by Parting. Empty in a set without
/// nodes.
///
/// Patches and nodes that parts take are handed out behind those of the mesh, as private vertices
/// are: which one of them stands for which part is a matter of history, and decides nothing.
struct PatchParts {
    std::uint32_t firstPatch = 0; ///< the first patch that is handed out
    std::uint32_t firstNode = 0;  ///< the first node that is
    /// 1: a patch that sends and receives; 0: a parted one, one that is covered all over, or one
    /// that nobody has.
    std::vector<std::uint8_t> used;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> of; ///< of each parted patch
    std::vector<std::uint32_t> wholePatch; ///< of each patch that is handed out, or kNone

    std::vector<std::array<glm::vec2, 4>> elementCoordinates; ///< of its corners, in its patch
    std::vector<PatchCoordinate> vertexCoordinates;           ///< in whole patches; shared ones
    std::vector<std::uint32_t> vertexNode;                    ///< at a shared vertex, or kNone
    std::vector<std::array<std::uint32_t, 4>> cornerNodes;    ///< of each whole patch
    /// Of each node that is handed out: the whole patch that it is of, or kNone, and its address.
    std::vector<std::uint32_t> nodePatch, nodeAddress;
    /// Of each block of them: the block in which the middles of their whole patches are, or kNone.
    std::vector<std::uint32_t> sourceBlock;
};

/// Room for objects that come later: vertices and nodes that are padding, and patches that are not
/// there. What is behind them, and all that refers to things by their numbers, stays as it is when
/// objects come.
struct PatchRoom {
    ObjectId object; ///< whose blocks these are: one that is hidden, without a path
    Range vertices, nodes, patches;
};

/// A scene, meshed: hot loops see these arrays and nothing else. Objects are brought to their poses
/// by placeObject(), and what they cover of each other, and part, is kept up to date by Coverage.
///
/// Vertices and nodes come in blocks of kBlock consecutive ones that belong to one object and lie
/// near each other; what is left of an object's last block is padding that receives nothing.
/// Where a mesh is dense, light is received at some of its vertices; the others, in blended blocks
/// behind those of their object, take it from receivers around them.
/// Vertices behind those of all objects are private corners that Coverage hands out. A set without
/// nodes is one for direct light alone.
struct PatchSet {
    static constexpr std::uint32_t kBlock = 64;

    std::vector<Vertex> vertices;
    std::vector<PatchCoordinate> vertexCoordinates; ///< one a vertex
    std::vector<NodeBlend> blends;                  ///< of vertices of clusters
    std::vector<std::uint32_t> nearClusters;        ///< patches; each is near to those near to it
    std::vector<ObjectId> vertexBlockObject;        ///< one a block of vertices
    std::vector<VertexBlend> vertexBlends;          ///< one a vertex of blended blocks
    /// One a block of vertices: the first of its blends, or kNone: its vertices are receivers.
    std::vector<std::uint32_t> blockBlends;
    std::vector<ObjectId> nodeBlockObject; ///< one a block of nodes
    std::vector<Element> elements;
    std::vector<Element> uncoveredElements; ///< the same when nothing else is near
    std::vector<std::uint8_t> covered;      ///< 1: an element that other things cover all over
    std::uint32_t firstPrivate = 0;         ///< the first vertex that Coverage hands out
    /// Of each vertex before it: at how many corners of elements a private one stands for it.
    std::vector<std::uint16_t> displaced;
    std::vector<std::uint32_t> privateElement; ///< whose corner each of those is
    std::vector<Patch> patches;
    std::vector<glm::vec3> corners;           ///< outlines of the patches
    std::vector<std::uint32_t> patchElements; ///< indices into elements, patch by patch
    std::vector<Receiver> nodes;              ///< where indirect light is received
    std::vector<Receiver> uncoveredNodes;     ///< the same when nothing else is near
    PatchParts parts;
    PatchRoom room;
    std::vector<LitMaterial> materials;
    SurfaceTextures textures;
    std::vector<Emitter> emitters;
    std::vector<ObjectPart> objects;
    std::vector<Wall> walls;             ///< in the world, object by object
    std::vector<RayMesh> rayMeshes;      ///< one an object
    std::vector<ObjectId> elementObject; ///< one an element
    Bounds bounds;
    double area = 0;                      ///< of all elements [m^2]
    std::size_t polygons = 0;             ///< faces of the scene that were meshed
    float patchSize = 0, elementSize = 0; ///< as used [m]
    double backdropArea = 0;              ///< likewise [m^2], see MeshingOptions
    float skin = 0; ///< how far receivers hover over their surface, at least: see hoverAt() [m]
    /// Largest coordinate that anything has had so far [m]. Says how far to search around what
    /// moves, never what is found there.
    float farthest = 0;

    /// Whether any of an element is lit and seen.
    bool receives(std::uint32_t element) const {
        return elements[element].patch != Element::kNone && !covered[element] &&
               objects[elementObject[element].value].present;
    }
    /// Whether a patch is there, as a whole.
    bool sends(std::uint32_t patch) const {
        return (parts.used.empty() || parts.used[patch]) &&
               objects[patches[patch].object.value].present;
    }
    /// Number of patches of what is in the scene, hidden or not.
    std::size_t patchCount() const;
    /// Whether there are parts of a patch in its place.
    bool isParted(std::uint32_t patch) const {
        return !parts.used.empty() && parts.used[patch] == 0 && parts.of.contains(patch);
    }
    /// Calls visit(patch) for what there is of a patch of the mesh: itself, or its parts.
    template <class Visit>
    void forEachPart(std::uint32_t whole, const Visit& visit) const {
        if (!isParted(whole)) return visit(whole);
        for (const std::uint32_t part : parts.of.at(whole)) visit(part);
    }
    /// Calls visit(point) for the outline of a patch or, of a cluster, for the corners of all of
    /// its elements: all of it lies between these, and none of them outside of its object [m,
    /// world].
    template <class Visit>
    void forEachCorner(const Patch& patch, const Visit& visit) const {
        for (std::uint32_t c = 0; c < patch.cornerCount; ++c) visit(corners[patch.firstCorner + c]);
        for (std::uint32_t i = 0; patch.cluster && i < patch.elementCount; ++i)
            for (const std::uint32_t v :
                 uncoveredElements[patchElements[patch.firstElement + i]].vertices)
                visit(vertices[v].position);
    }
    /// Whether no vertex of a block receives light itself.
    bool isBlended(std::uint32_t vertexBlock) const {
        return vertexBlock < blockBlends.size() &&
               blockBlends[vertexBlock] != PatchCoordinate::kNone;
    }
    /// \pre a vertex of a blended block
    const VertexBlend& vertexBlend(std::uint32_t vertex) const {
        return vertexBlends[blockBlends[vertex / kBlock] + vertex % kBlock];
    }
    /// Calls visit(receiver, weight) for those that a vertex takes its light from, itself if it is
    /// one. Those that other things cover, or touch so that no element is drawn with them, count
    /// only where there are no others; weights add up to 1.
    template <class Visit>
    void forEachReceiver(std::uint32_t vertex, const Visit& visit) const {
        forEachReceiver(
            vertex, [&](std::uint32_t v) { return isDrawnAsIs(v); }, visit);
    }
    /// \param counts whether a receiver does, as far as other things go
    template <class Counts, class Visit>
    void forEachReceiver(std::uint32_t vertex, const Counts& counts, const Visit& visit) const {
        if (!isBlended(vertex / kBlock)) return visit(vertex, 1.0f);
        const VertexBlend& blend = vertexBlend(vertex);
        std::array<float, 4> weights{};
        float sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
            if (blend.weights[k] > 0 && counts(blend.vertices[k]))
                sum += weights[k] = blend.weights[k];
        if (!(sum > 0)) weights = blend.weights, sum = 1;
        for (std::size_t k = 0; k < 4; ++k)
            if (weights[k] > 0) visit(blend.vertices[k], weights[k] / sum);
    }
    /// Whether nothing covers a shared vertex or moves a corner of its elements away from it.
    bool isDrawnAsIs(std::uint32_t vertex) const {
        return vertexCoordinates[vertex].patch != PatchCoordinate::kNone &&
               (vertex >= displaced.size() || displaced[vertex] == 0);
    }
    /// The clusters that one touches, some of whose vertices blend with it.
    std::span<const std::uint32_t> clustersNear(const Patch& patch) const {
        return std::span(nearClusters).subspan(patch.firstNear, patch.nearCount);
    }
    /// The patch of the mesh that a patch is, or is a part of.
    std::uint32_t wholeOf(std::uint32_t patch) const {
        return patch < parts.firstPatch || parts.used.empty()
                   ? patch
                   : parts.wholePatch[patch - parts.firstPatch];
    }
};

/// Addresses name what an object is made of in every scene that has the object: a hash of its key
/// and of where the thing lies in the object's own frame, whatever else is there. Things that can't
/// be told apart have the same.
std::uint32_t addressOf(const ObjectPart& part, const Receiver& inFrame);
std::uint32_t addressOfNode(const PatchSet& set, std::uint32_t node);
std::uint32_t addressOfPatch(const PatchSet& set, std::uint32_t patch);

/// A receiver of an object's own frame, as seen from a pose, where it may have to hover higher.
/// \param skin of the set [m]
Receiver placedReceiver(const Receiver& own, const Pose& pose, float skin);
/// An emitter of an object's own frame, as seen from a pose.
Emitter placedEmitter(const Emitter& own, const Pose& pose);
/// Writes an object's share of the arrays as seen from `pose`, as if nothing else were near.
void placeObject(PatchSet& set, ObjectId object, const Pose& pose);
/// Box around an object's triangles [m, world].
Bounds boundsOf(const PatchSet& set, ObjectId object);
/// Box around an emitter [m, world]; of a disk, around the sphere of its radius.
Bounds boundsOf(const Emitter& emitter);

/// Reflectance in the mean over an element or a patch: its own part of a texture, if there is one.
Rgb elementReflectance(const PatchSet& set, std::uint32_t element);
Rgb patchReflectance(const PatchSet& set, std::uint32_t patch);
/// Mean of a texture over a quadrilateral, or triangle, of which these are the corners.
Rgb textureMean(const Texture& texture, const std::array<glm::vec3, 4>& positions,
                const std::array<glm::vec2, 4>& uvs);
/// Reflectance and emission [nit] at a point of an element, as it is drawn.
LitMaterial surfaceAt(const PatchSet& set, std::uint32_t element, glm::vec2 uv);
/// What textures make of the reflectance of a patch in the mean, as a factor of that of its
/// material. \param elements of the patch; those of set.textures have their means
Rgb textureMeanOf(const PatchSet& set, std::span<const std::uint32_t> elements);
/// Fills in the means of set.textures. \pre the set has elements and patches, in the frames of
/// their objects
void findTextureMeans(PatchSet& set);

/// Area of an element [m^2], half the cross product of its diagonals.
inline float elementArea(const PatchSet& set, const Element& element) {
    const auto at = [&](std::size_t k) { return set.vertices[element.vertices[k]].position; };
    return 0.5f * glm::length(glm::cross(at(2) - at(0), at(3) - at(1)));
}

} // namespace penumbra
