// What is drawn: triangles whose vertices carry irradiance.
#pragma once

#include "base/Bounds.h"
#include "base/ObjectId.h"
#include "base/Rgb.h"
#include "scenegraph/Material.h"
#include "scenegraph/Node.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra {

/// A surface colour, looked up by the triangles of a LitGeometry.
struct LitMaterial {
    Rgb reflectance;                ///< Lambertian rho
    Rgb emission;                   ///< own luminance [nit]
    MaterialTextures textures = {}; ///< factors of the two, point by point
    friend bool operator==(const LitMaterial&, const LitMaterial&) = default;
};

/// Flat arrays of lit triangles, one-sided: front is counter-clockwise. The luminance of a point is
/// rho / pi * (direct + indirect) + emission.
struct LitMeshData {
    std::vector<glm::vec3> positions;            ///< [m, local frame]
    std::vector<glm::vec3> normals;              ///< unit
    std::vector<Rgb> direct;                     ///< illuminance from emitters [lux]
    std::vector<Rgb> indirect;                   ///< illuminance by interreflection [lux]
    std::vector<std::uint32_t> indices;          ///< three a triangle
    std::vector<std::uint32_t> triangleMaterial; ///< index into materials, one a triangle
    std::vector<LitMaterial> materials;
    /// Which patch a triangle is part of: any number, the same for those of one patch. As long as
    /// triangleMaterial; empty: nobody knows.
    std::vector<std::uint32_t> trianglePatch = {};
    std::vector<glm::vec2> uvs = {}; ///< as long as positions; empty: no textures
};

/// The lit surface of one object. Its light comes in blocks of kBlock consecutive vertices: one
/// that keeps a copy of it remembers revisions, and copies the blocks that have another one.
///
/// | what was edited | revision() | topologyRevision() | blockRevisions() |
/// |---|---|---|---|
/// | light of some blocks | rises | | of these rise |
/// | reflectance, emission | rises | | |
/// | which vertices make up which triangles, or their number | rises | rises | of new ones |
class LitGeometry : public Node {
public:
    static constexpr std::size_t kBlock = 64; ///< vertices

    LitGeometry(std::string name, ObjectId object, LitMeshData data);
    void accept(Visitor& visitor) const override;

    const LitMeshData& data() const { return data_; }
    ObjectId object() const { return object_; }
    const Bounds& bounds() const { return bounds_; }

    /// Replaces the light, vertex by vertex; both spans are as long as positions.
    void setIlluminance(std::vector<Rgb> direct, std::vector<Rgb> indirect);
    /// Replaces the light of one block; `edit` is given the arrays to write to, see LitMeshData.
    void setBlock(std::size_t block, const std::function<void(LitMeshData&)>& edit);
    /// Replaces what triangles are made of; positions may only be added at the end.
    void setTopology(const std::function<void(LitMeshData&)>& edit);
    void setMaterials(std::vector<LitMaterial> materials);

    std::uint64_t topologyRevision() const { return topologyRevision_; }
    /// One a block of vertices, 1 at first.
    const std::vector<std::uint64_t>& blockRevisions() const { return blockRevisions_; }

protected:
    /// All blocks are to be read anew.
    void touchBlocks();

private:
    ObjectId object_;
    LitMeshData data_;
    Bounds bounds_;
    std::uint64_t topologyRevision_ = 1;
    std::vector<std::uint64_t> blockRevisions_;
};

} // namespace penumbra
