// A scene graph written down: flat, without pointers between nodes.
#pragma once

#include "base/Rgb.h"
#include "radiosity/process/memory/Bytes.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace penumbra {

struct MaterialSnapshot {
    std::string name;
    Rgb reflectance, emission;
    MaterialTextures textures = {};
};

struct NodeSnapshot {
    enum class Kind : std::uint8_t { none, group, choice, transform, mesh, light };
    Kind kind = Kind::none; ///< none: the number is not in use
    std::string name;
    std::vector<std::uint32_t> children;  ///< of a group, a switch (choice) or a transform
    bool visible = true;                  ///< of a switch
    bool beginsObject = false;            ///< of a transform
    glm::dmat4 matrix{1.0};               ///< of a transform
    LightShape shape;                     ///< of a light
    Rgb luminance;                        ///< of a light [nit]
    std::shared_ptr<const MeshData> mesh; ///< of a mesh; its materials mean nothing
    std::vector<std::uint32_t> materials; ///< of a mesh, in its order
};

/// Node 0 is the root, a group. Numbers are good for the life of a snapshot.
struct SceneSnapshot {
    std::vector<NodeSnapshot> nodes;
    std::vector<MaterialSnapshot> materials;
};

/// The edits that are made to graphs. Each one says how something is now, not how it came there: of
/// several for the same thing only the last one counts.
struct SetMatrix {
    std::uint32_t node;
    glm::dmat4 matrix;
};
struct SetVisible {
    std::uint32_t node;
    bool visible;
};
struct SetLuminance {
    std::uint32_t node;
    Rgb luminance;
};
struct SetMaterial {
    std::uint32_t material;
    Rgb reflectance, emission;
};
struct SetChildren {
    std::uint32_t node;
    std::vector<std::uint32_t> children;
};
struct SetBeginsObject {
    std::uint32_t node;
    bool beginsObject;
};
using GraphEdit =
    std::variant<SetMatrix, SetVisible, SetLuminance, SetMaterial, SetChildren, SetBeginsObject>;

/// Things that come to a snapshot, and what becomes of the others for it. Numbers are not used
/// again: what comes follows what was ever there.
struct SceneGrowth {
    std::uint32_t firstNode = 0, firstMaterial = 0; ///< how many there were
    std::vector<NodeSnapshot> nodes;
    std::vector<MaterialSnapshot> materials;
    std::vector<SetChildren> children; ///< of nodes that were there
    std::vector<std::uint32_t> gone;   ///< nodes that are in the graph no more
};

/// The same for two edits of the same thing.
std::uint64_t keyOf(const GraphEdit& edit);

/// \return false, and nothing is done: there is no such thing, or its value can't be
bool apply(SceneSnapshot& snapshot, const GraphEdit& edit);
/// \return false: it makes no sense, and the snapshot none any more
bool apply(SceneSnapshot& snapshot, const SceneGrowth& growth);

/// Whether the graph has no circles, and not so many paths that nobody could walk them.
bool walkable(const SceneSnapshot& snapshot);
/// Whether all numbers are those of things, all values can be, and the graph can be walked.
bool makesSense(const SceneSnapshot& snapshot);

void write(ByteWriter& out, const SceneSnapshot& snapshot);
void write(ByteWriter& out, const GraphEdit& edit);
void write(ByteWriter& out, const SceneGrowth& growth);
/// \return none: it is not one, or not one that can be walked
std::optional<SceneSnapshot> readSceneSnapshot(ByteReader& in);
std::optional<GraphEdit> readGraphEdit(ByteReader& in);
std::optional<SceneGrowth> readSceneGrowth(ByteReader& in);

} // namespace penumbra
