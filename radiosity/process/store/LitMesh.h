// The mesh that is lit, as the worker reports it to the node.
#pragma once

#include "radiosity/mesh/BuildPatches.h"
#include "radiosity/process/memory/Bytes.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

class SceneReplica;
class LitScene;

/// Emitting faces of a mesh, as one sender of direct light: one of PatchSet::emitters.
struct LitMeshEmitter {
    std::string path;                             ///< of the mesh
    std::uint32_t material = 0;                   ///< a number of the scene snapshot
    Rgb texture{1};                               ///< mean of its part of a texture, see Emitter
    std::vector<std::vector<glm::vec3>> polygons; ///< in the frame of the vertices [m]
};

/// One object. Its vertices are those of its blocks, so a multiple of PatchSet::kBlock; padding
/// lies at the origin.
struct LitMeshObject {
    std::string path;
    glm::dmat4 toObject{1.0}; ///< of the stretched frame (see Pose.h) to the object's own
    std::uint32_t firstBlock = 0;
    std::uint32_t present = 0; ///< 0: was hidden when it was meshed
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec3> receivers; ///< where vertices take their light, see Vertex
    /// Of the last vertices, as many as these; the others receive light themselves. Of this
    /// object's vertices.
    std::vector<VertexBlend> blends;
    std::vector<std::array<std::uint32_t, 4>> elements; ///< see Element; of this object's vertices
    std::vector<std::uint32_t> elementMaterial;
    std::vector<std::uint32_t> elementPatch; ///< any number, the same for those of one patch;
                                             ///< Element::kNone: covered all over
    std::vector<std::array<glm::vec2, 4>> elementUvs; ///< see SurfaceTextures; may be empty
    RayMesh rays;                                     ///< what blocks rays
    std::vector<LitMeshEmitter> emitters;             ///< of its meshes; lights the graph knows of
};

/// Where a colour comes from: numbers of the scene snapshot, kNone if there is none.
struct LitMeshMaterial {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    std::uint32_t material = kNone, light = kNone;
    std::uint32_t emits = 0; ///< 0: what the material emits does not count, see BuiltPatches
};

struct LitMeshHead {
    MeshingOptions sizes;      ///< that it was meshed with
    std::uint32_t objects = 0; ///< in all, those that were described before included
    std::vector<LitMeshMaterial> materials;
};

/// The mesh of a scene as it was built, each object in its stretched frame.
/// \param first of the objects that are described; those before it were already
std::vector<std::byte> describeMesh(const LitScene& scene, const SceneReplica& graph,
                                    std::uint32_t first = 0);

/// Reads a mesh object by object, so that nobody has to wait for all of it.
class LitMeshReader {
public:
    /// \param blocks vertices are there for as many
    LitMeshReader(std::span<const std::byte> bytes, std::uint32_t blocks);

    /// Goes on with objects that were described later. \pre done()
    void goOn(std::span<const std::byte> bytes);

    bool ok() const { return reader_.ok(); }
    const LitMeshHead& head() const { return head_; }
    bool done() const { return next_ == head_.objects; }
    /// The next object; none: this is no mesh. \pre not done()
    std::optional<LitMeshObject> next();

private:
    void readHead();
    bool sound(const LitMeshObject& object) const;

    ByteReader reader_;
    LitMeshHead head_;
    std::uint32_t blocks_;
    std::uint32_t next_ = 0, nextBlock_ = 0;
};

/// The corner of an element that each vertex of a private block represents: 4 * element + corner,
/// in the order of LitMeshObject::elements; kNoCorner: none.
constexpr std::uint32_t kNoCorner = 0xffffffffu;

/// Numbers the elements that have no number yet, in the order of their objects. \pre all elements
/// of an object have one, or none
void numberElements(const PatchSet& set, std::vector<std::uint32_t>& number);

} // namespace penumbra
