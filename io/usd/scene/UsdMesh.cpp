#include "io/usd/scene/UsdMesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace penumbra {

namespace {

constexpr std::string_view kColour = "primvars:displayColor";
constexpr std::size_t kMaxMaterials = 65'000; // of one mesh: MeshData counts them in 16 bits

Rgb usable(glm::vec3 c) {
    const auto channel = [](float v) {
        return std::isfinite(v) ? std::clamp(v, 0.0f, 1.0f) : 0.0f;
    };
    return {channel(c.x), channel(c.y), channel(c.z)};
}

// displayColor with its indices applied.
std::vector<glm::vec3> displayColours(const UsdAttributes& prim) {
    std::vector<glm::vec3> colours = prim.points(kColour);
    const auto indices = prim.integers(std::string(kColour) + ":indices");
    if (indices.empty()) return colours;
    std::vector<glm::vec3> expanded;
    for (const std::int32_t i : indices) {
        const bool inRange = i >= 0 && std::size_t(i) < colours.size();
        expanded.push_back(inRange ? colours[std::size_t(i)] : glm::vec3(0.5f));
    }
    return expanded;
}

// Which material each face has, by the numbers of the file.
class Painter {
public:
    Painter(const UsdAttributes& prim, const UsdPolygons& polygons, UsdMaterials& materials,
            Diagnostics& diagnostics)
        : prim_(prim), polygons_(polygons), materials_(materials), diagnostics_(diagnostics),
          faceMaterial_(polygons.counts.size(), 0), invisible_(polygons.counts.size(), 0) {}

    void paintAll(const UsdInherited& inherited) {
        if (!inherited.material.empty()) {
            const UsdSurface& surface = materials_.at(inherited.material);
            if (surface.material) {
                fill(surface);
                return;
            }
        }
        const auto colours = displayColours(prim_);
        if (!colours.empty())
            paintColours(colours, prim_.interpolation(kColour, "constant"));
        else if (inherited.displayColour)
            fill({ofColour(*inherited.displayColour), false});
        else
            fill({materials_.neutral(), false});
    }

    void paintSubset(const UsdSurface& surface, const std::vector<std::int32_t>& faces) {
        const std::uint16_t index = indexOf(surface.material);
        for (const std::int32_t f : faces) {
            if (f < 0 || std::size_t(f) >= faceMaterial_.size()) {
                diagnostics_.warn(prim_.prim().location(),
                                  "a GeomSubset names faces that are not there");
                continue;
            }
            faceMaterial_[std::size_t(f)] = index;
            invisible_[std::size_t(f)] = surface.invisible;
        }
    }

    const std::vector<std::uint16_t>& faceMaterial() const { return faceMaterial_; }
    const std::vector<std::uint8_t>& invisible() const { return invisible_; }
    const std::vector<std::shared_ptr<Material>>& table() const { return table_; }

private:
    void fill(const UsdSurface& surface) {
        std::fill(faceMaterial_.begin(), faceMaterial_.end(), indexOf(surface.material));
        std::fill(invisible_.begin(), invisible_.end(), std::uint8_t(surface.invisible));
    }

    std::uint16_t indexOf(const std::shared_ptr<Material>& material) {
        const auto [entry, isNew] = indexOf_.try_emplace(material.get(), table_.size());
        if (isNew) table_.push_back(material);
        return std::uint16_t(entry->second);
    }

    // One material for each colour, to 8 bits a channel.
    std::shared_ptr<Material> ofColour(Rgb c) {
        const auto bits = [](float v) { return int(std::lround(v * 255)); };
        auto& material = byColour_[{bits(c.r), bits(c.g), bits(c.b)}];
        if (!material && byColour_.size() > kMaxMaterials) {
            diagnostics_.warn(prim_.location(kColour), "a mesh of too many colours");
            material = materials_.neutral();
        }
        if (!material) {
            material = std::make_shared<Material>(prim_.prim().name + "_displayColor");
            material->setReflectance(c);
        }
        return material;
    }

    void paintColours(const std::vector<glm::vec3>& colours, const std::string& interpolation) {
        const std::size_t faces = polygons_.counts.size();
        const bool perPoint = interpolation == "vertex" || interpolation == "varying";
        const std::size_t wanted = interpolation == "uniform"       ? faces
                                   : perPoint                       ? polygons_.points.size()
                                   : interpolation == "faceVarying" ? polygons_.indices.size()
                                                                    : 1;
        if (colours.size() == 1 || colours.size() < wanted) {
            if (colours.size() != 1)
                diagnostics_.warn(prim_.location(kColour),
                                  "displayColor is too short: its first value is used");
            fill({ofColour(usable(colours[0])), false});
            return;
        }
        if (perPoint || interpolation == "faceVarying")
            diagnostics_.warn(prim_.location(kColour), "displayColor averaged over each face");
        std::size_t offset = 0;
        for (std::size_t f = 0; f < faces; ++f) {
            const auto count = std::size_t(polygons_.counts[f]);
            glm::vec3 c = interpolation == "uniform" ? colours[f] : colours[0];
            if (perPoint || interpolation == "faceVarying")
                c = polygons_.kept[f] ? mean(colours, offset, count, perPoint) : glm::vec3(0);
            faceMaterial_[f] = indexOf(ofColour(usable(c)));
            offset += count;
        }
    }

    // Of a kept face: its indices are in range.
    glm::vec3 mean(const std::vector<glm::vec3>& colours, std::size_t offset, std::size_t count,
                   bool perPoint) const {
        glm::vec3 sum(0);
        for (std::size_t i = offset; i < offset + count; ++i)
            sum += colours[perPoint ? std::size_t(polygons_.indices[i]) : i];
        return sum / float(count);
    }

    const UsdAttributes& prim_;
    const UsdPolygons& polygons_;
    UsdMaterials& materials_;
    Diagnostics& diagnostics_;
    std::vector<std::uint16_t> faceMaterial_;
    std::vector<std::uint8_t> invisible_;
    std::vector<std::shared_ptr<Material>> table_;
    std::map<const Material*, std::size_t> indexOf_;
    std::map<std::tuple<int, int, int>, std::shared_ptr<Material>> byColour_;
};

void paintSubsets(const UsdStage& stage, const UsdAttributes& prim, const UsdInherited& inherited,
                  UsdMaterials& materials, Painter& painter, Diagnostics& diagnostics) {
    for (const std::uint32_t child : prim.prim().children) {
        const UsdPrim& subset = stage.prims()[child];
        if (subset.typeName != "GeomSubset" || !subset.defined || subset.abstract) continue;
        const UsdAttributes attributes(subset, prim.time());
        const UsdBinding binding = usdMaterialBinding(subset, diagnostics);
        if (binding.path.empty() || inherited.materialIsStronger) continue;
        if (attributes.text("elementType", "face") != "face") {
            diagnostics.warn(subset.location(), "a GeomSubset of anything but faces ignored");
            continue;
        }
        const UsdSurface& surface = materials.at(binding.path);
        if (surface.material) painter.paintSubset(surface, attributes.integers("indices"));
    }
}

UsdMeshLight::Paint glowing(const std::shared_ptr<Material>& plain) {
    return {plain, std::make_shared<Material>(plain->name(), plain->textures())};
}

UsdCorners cornersOf(const UsdPolygons& polygons) {
    UsdCorners corners{{}, 0, polygons.leftHanded};
    for (const std::int32_t count : polygons.counts) {
        corners.firstCorner.push_back(corners.count);
        corners.count += std::size_t(count);
    }
    return corners;
}

/// The material with constants in place of its textures.
std::shared_ptr<Material> meanOf(const Material& material) {
    auto mean = std::make_shared<Material>(material.name());
    const auto& texture = material.textures().reflectance;
    mean->setReflectance(texture ? material.reflectance() * texture->mean()
                                 : material.reflectance());
    mean->setEmission(material.meanEmission());
    return mean;
}

/// Gives the mesh the texture coordinates that its materials want; materials that find none become
/// constant.
void addTexCoords(const UsdAttributes& prim, const UsdMaterials& materials,
                  const UsdCorners& corners, const std::vector<std::size_t>& faceOf, MeshData& data,
                  Diagnostics& diagnostics) {
    std::map<std::string, std::vector<glm::vec2>> sets;
    std::vector<const std::vector<glm::vec2>*> setOf;
    for (auto& material : data.materials) {
        const std::string name = materials.primvarOf(*material);
        setOf.push_back(nullptr);
        if (name.empty()) continue;
        const auto [entry, fresh] = sets.try_emplace(name);
        if (fresh) entry->second = usdTexCoords(prim, name, data, corners, faceOf, diagnostics);
        if (entry->second.empty())
            material = meanOf(*material);
        else
            setOf.back() = &entry->second;
    }
    const auto any = std::find_if(setOf.begin(), setOf.end(), [](auto* set) { return set; });
    if (any == setOf.end()) return;
    data.uvs = **any;
    for (std::size_t face = 0, first = 0; face < data.faceVertexCounts.size(); ++face) {
        const auto count = std::size_t(data.faceVertexCounts[face]);
        const auto* set = setOf[data.faceMaterial.empty() ? 0 : data.faceMaterial[face]];
        if (set && set != *any)
            std::copy_n(set->begin() + std::ptrdiff_t(first), count,
                        data.uvs.begin() + std::ptrdiff_t(first));
        first += count;
    }
}

} // namespace

void UsdMeshLight::set(Rgb luminance) const {
    for (const auto& [plain, glowing] : paints) {
        const Rgb reflectance = plain->reflectance();
        const Rgb emission = plain->emissive() ? luminance * plain->emission() : luminance;
        if (glowing->reflectance() != reflectance) glowing->setReflectance(reflectance);
        if (glowing->emission() != emission) glowing->setEmission(emission);
    }
}

NodePtr makeUsdMesh(const std::string& name, const UsdStage& stage, const UsdAttributes& prim,
                    UsdPolygons polygons, const UsdInherited& inherited, UsdMaterials& materials,
                    UsdMeshLight* light, Diagnostics& diagnostics) {
    Painter painter(prim, polygons, materials, diagnostics);
    painter.paintAll(inherited);
    paintSubsets(stage, prim, inherited, materials, painter, diagnostics);
    const std::vector<std::uint16_t> faceMaterial = painter.faceMaterial();
    for (std::size_t f = 0; f < polygons.kept.size(); ++f)
        if (painter.invisible()[f]) polygons.kept[f] = 0;
    const UsdCorners corners = cornersOf(polygons);
    std::vector<std::size_t> faceOf;
    MeshData data = toMeshData(prim, std::move(polygons), faceOf, diagnostics);
    if (faceOf.empty()) {
        diagnostics.warn(prim.prim().location(), "a mesh without visible faces left out");
        return nullptr;
    }
    data.materials = painter.table();
    if (data.materials.size() > 1)
        for (const std::size_t f : faceOf) data.faceMaterial.push_back(faceMaterial[f]);
    addTexCoords(prim, materials, corners, faceOf, data, diagnostics);
    if (light)
        for (auto& material : data.materials) {
            light->paints.push_back(glowing(material));
            material = light->paints.back().glowing;
        }
    return std::make_shared<Mesh>(name, std::move(data));
}

std::optional<Rgb> usdConstantColour(const UsdAttributes& prim) {
    if (!UsdStage::property(prim.prim(), kColour)) return std::nullopt;
    const auto colours = displayColours(prim);
    if (colours.size() != 1 || prim.interpolation(kColour, "constant") != "constant")
        return std::nullopt;
    return usable(colours[0]);
}

double areaOf(const UsdPolygons& polygons, const glm::dmat3& toWorld) {
    double sum = 0;
    std::size_t offset = 0;
    for (std::size_t f = 0; f < polygons.counts.size(); ++f) {
        const auto count = std::size_t(polygons.counts[f]);
        glm::dvec3 normal(0);
        for (std::size_t i = 1; polygons.kept[f] && i + 1 < count; ++i) {
            const auto corner = [&](std::size_t k) {
                return toWorld *
                       glm::dvec3(polygons.points[std::size_t(polygons.indices[offset + k])]);
            };
            normal += glm::cross(corner(i) - corner(0), corner(i + 1) - corner(0));
        }
        sum += glm::length(normal) / 2;
        offset += count;
    }
    return sum;
}

} // namespace penumbra
