// What is drawn: triangles whose vertices carry irradiance.
#pragma once

#include "scenegraph/Bounds.h"
#include "scenegraph/Node.h"
#include "scenegraph/ObjectId.h"
#include "scenegraph/Rgb.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra {

/// A surface colour, looked up by the triangles of a LitGeometry.
struct LitMaterial {
    Rgb reflectance; ///< Lambertian rho
    Rgb emission;    ///< own luminance [nit]
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
};

/// The lit surface of one object.
class LitGeometry : public Node {
public:
    LitGeometry(std::string name, ObjectId object, LitMeshData data);
    void accept(Visitor& visitor) const override;

    const LitMeshData& data() const { return data_; }
    ObjectId object() const { return object_; }
    const Bounds& bounds() const { return bounds_; }

    /// Replaces the light, vertex by vertex; both spans are as long as positions.
    void setIlluminance(std::vector<Rgb> direct, std::vector<Rgb> indirect);

private:
    ObjectId object_;
    LitMeshData data_;
    Bounds bounds_;
};

} // namespace penumbra
