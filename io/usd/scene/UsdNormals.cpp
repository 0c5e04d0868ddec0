#include "io/usd/scene/UsdNormals.h"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

namespace {

constexpr std::string_view kPrimvar = "primvars:normals";
constexpr std::string_view kAttribute = "normals";

// The primvar's indices applied; none if one of them is out of range.
std::optional<std::vector<glm::vec3>> valuesOf(const UsdAttributes& mesh, std::string_view name) {
    std::vector<glm::vec3> values = mesh.points(name);
    if (name != kPrimvar) return values;
    const auto indices = mesh.integers(std::string(kPrimvar) + ":indices");
    if (indices.empty()) return values;
    std::vector<glm::vec3> expanded;
    expanded.reserve(indices.size());
    for (const std::int32_t i : indices) {
        if (i < 0 || std::size_t(i) >= values.size()) return std::nullopt;
        expanded.push_back(values[std::size_t(i)]);
    }
    return expanded;
}

glm::vec3 unitOrZero(glm::vec3 v) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length) : glm::vec3(0);
}

std::size_t wanted(const UsdPolygons& polygons, std::string_view interpolation) {
    if (interpolation == "constant") return 1;
    if (interpolation == "uniform") return polygons.counts.size();
    if (interpolation == "faceVarying") return polygons.indices.size();
    return polygons.points.size(); // vertex, varying
}

} // namespace

std::vector<glm::vec3> readUsdNormals(const UsdAttributes& mesh, const UsdPolygons& polygons,
                                      Diagnostics& diagnostics) {
    if (polygons.scheme != SubdivisionScheme::none) return {};
    const std::string_view name = mesh.value(kPrimvar) ? kPrimvar : kAttribute;
    const auto values = valuesOf(mesh, name);
    if (values && values->empty()) return {};
    const char* const fallback = name == kPrimvar ? "constant" : "vertex"; // as USD has it
    const std::string interpolation = mesh.interpolation(name, fallback);
    if (!values || values->size() != wanted(polygons, interpolation)) {
        diagnostics.warn(mesh.location(name), "normals that do not fit their mesh ignored");
        return {};
    }
    std::vector<glm::vec3> normals(polygons.indices.size(), glm::vec3(0));
    std::size_t offset = 0;
    for (std::size_t f = 0; f < polygons.counts.size(); ++f)
        for (std::int32_t k = 0; k < polygons.counts[f]; ++k, ++offset) {
            if (!polygons.kept[f]) continue; // its indices may be out of range
            const std::size_t of = interpolation == "constant"  ? 0
                                   : interpolation == "uniform" ? f
                                   : interpolation == "faceVarying"
                                       ? offset
                                       : std::size_t(polygons.indices[offset]);
            normals[offset] = unitOrZero((*values)[of]);
        }
    return normals;
}

} // namespace penumbra
