#include "radiosity/mesh/Emitters.h"

#include "base/Axis.h"
#include "scenegraph/Light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kDiskCorners = 64;
constexpr int kSphereSegments = 24, kSphereRings = 12;

void addFace(MeshData& mesh, std::initializer_list<int> corners) {
    mesh.faceVertexCounts.push_back(std::int32_t(corners.size()));
    mesh.faceVertexIndices.insert(mesh.faceVertexIndices.end(), corners.begin(), corners.end());
}

/// All shapes of lights that lie in the XY plane emit towards -Z: counter-clockwise seen from
/// there.
void addShape(MeshData& mesh, const RectShape& rect) {
    const float x = rect.width / 2, y = rect.height / 2;
    mesh.points = {{-x, -y, 0}, {-x, y, 0}, {x, y, 0}, {x, -y, 0}};
    addFace(mesh, {0, 1, 2, 3});
}

void addShape(MeshData& mesh, const DiskShape& disk) {
    mesh.faceVertexCounts.push_back(kDiskCorners);
    for (int i = 0; i < kDiskCorners; ++i) {
        const double angle = -2 * kPi * i / kDiskCorners;
        mesh.points.emplace_back(disk.radius * std::cos(angle), disk.radius * std::sin(angle), 0);
        mesh.faceVertexIndices.push_back(i);
    }
}

void addShape(MeshData& mesh, const SphereShape& sphere) {
    for (int ring = 1; ring < kSphereRings; ++ring)
        for (int i = 0; i < kSphereSegments; ++i) {
            const double polar = kPi * ring / kSphereRings, angle = 2 * kPi * i / kSphereSegments;
            mesh.points.emplace_back(sphere.radius * std::sin(polar) * std::cos(angle),
                                     sphere.radius * std::sin(polar) * std::sin(angle),
                                     sphere.radius * std::cos(polar));
        }
    const int top = int(mesh.points.size()), bottom = top + 1;
    mesh.points.emplace_back(0, 0, sphere.radius);
    mesh.points.emplace_back(0, 0, -sphere.radius);
    const auto at = [](int ring, int i) {
        return (ring - 1) * kSphereSegments + i % kSphereSegments;
    };
    for (int i = 0; i < kSphereSegments; ++i) {
        addFace(mesh, {top, at(1, i), at(1, i + 1)});
        for (int ring = 1; ring + 1 < kSphereRings; ++ring)
            addFace(mesh, {at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i + 1)});
        addFace(mesh, {bottom, at(kSphereRings - 1, i + 1), at(kSphereRings - 1, i)});
    }
}

/// Whether the frame keeps angles, at least in the plane (count 2) or in space (3).
bool keepsShape(const glm::dmat4& toWorld, int axes, double& scale) {
    scale = glm::length(glm::dvec3(toWorld[0]));
    for (int i = 0; i < axes; ++i) {
        if (std::abs(glm::length(glm::dvec3(toWorld[i])) - scale) > 1e-5 * scale) return false;
        for (int j = 0; j < i; ++j)
            if (std::abs(glm::dot(glm::dvec3(toWorld[i]), glm::dvec3(toWorld[j]))) >
                1e-5 * scale * scale)
                return false;
    }
    return true;
}

} // namespace

MeshData lightShapeMesh(const Light& light) {
    MeshData mesh;
    std::visit([&](const auto& shape) { addShape(mesh, shape); }, light.shape());
    auto material = std::make_shared<Material>(light.name());
    material->setReflectance(Rgb(0.0f));
    material->setEmission(light.luminance());
    mesh.materials.push_back(std::move(material));
    return mesh;
}

Emitter lightEmitter(const Light& light, const glm::dmat4& toWorld) {
    Emitter emitter;
    emitter.exitance = lambertianExitance(light.luminance());
    emitter.centre = glm::vec3(toWorld[3]);
    const auto* disk = std::get_if<DiskShape>(&light.shape());
    const auto* sphere = std::get_if<SphereShape>(&light.shape());
    double scale = 1;
    if (disk && keepsShape(toWorld, 2, scale)) {
        emitter.kind = Emitter::Kind::disk;
        emitter.radius = float(disk->radius * scale);
        glm::dvec3 axis =
            glm::normalize(glm::cross(glm::dvec3(toWorld[1]), glm::dvec3(toWorld[0])));
        if (glm::determinant(glm::dmat3(toWorld)) < 0)
            axis = -axis; // -Z, mirrored along with the rest
        emitter.axis = glm::vec3(axis);
        emitter.area = kPi * emitter.radius * emitter.radius;
    } else if (sphere && keepsShape(toWorld, 3, scale)) {
        emitter.kind = Emitter::Kind::sphere;
        emitter.radius = float(sphere->radius * scale);
        emitter.area = 4 * kPi * emitter.radius * emitter.radius;
    } else {
        const MeshData mesh = lightShapeMesh(light);
        const bool mirrored = glm::determinant(glm::dmat3(toWorld)) < 0;
        std::size_t first = 0;
        for (std::int32_t count : mesh.faceVertexCounts) {
            std::vector<glm::vec3> polygon;
            for (std::size_t i = 0; i < std::size_t(count); ++i) {
                const std::size_t k = mirrored ? std::size_t(count) - 1 - i : i;
                const glm::vec3 point = mesh.points[std::size_t(mesh.faceVertexIndices[first + k])];
                polygon.emplace_back(glm::vec3(toWorld * glm::dvec4(glm::dvec3(point), 1.0)));
            }
            first += std::size_t(count);
            emitter.area += polygonArea(polygon);
            emitter.polygons.push_back(std::move(polygon));
        }
    }
    return emitter;
}

glm::dvec3 areaVector(std::span<const glm::vec3> polygon) {
    glm::dvec3 sum(0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(glm::dvec3(polygon[i - 1]) - glm::dvec3(polygon[0]),
                          glm::dvec3(polygon[i]) - glm::dvec3(polygon[0]));
    return 0.5 * sum;
}

double polygonArea(std::span<const glm::vec3> polygon) {
    return glm::length(areaVector(polygon));
}

namespace {

/// Collects emissive polygons as emitters. Small ones that lie close together, like the faces of a
/// bulb, are one; large ones are cut, so that each is seen mildly by most of what it lights. How
/// many there are goes by their extent, not by how many polygons they have.
class EmitterCollector {
public:
    /// \param emissiveAreas of the polygons of each material [m^2]: others, that may shine or not,
    /// cut none of them
    EmitterCollector(const std::map<const Material*, double>& emissiveAreas, float patchSize) {
        for (const auto& [material, area] : emissiveAreas)
            extents_[material] = {patchSize / 2,
                                  std::max(2 * patchSize, float(std::sqrt(area / 16))),
                                  std::max(4 * patchSize, float(std::sqrt(area / 32)))};
    }

    /// In the order in which their materials were first seen.
    std::vector<FaceEmitter> take() {
        for (MaterialPieces& of : pieces_) group(*of.material, of.pieces);
        return std::move(found_);
    }

    /// \param uvs of the outline's corners; empty: no textures
    void add(const Material& material, const std::vector<glm::vec3>& outline,
             std::span<const glm::vec2> uvs) {
        if (outline.size() != 4) return addPiece(material, outline, {uvs.begin(), uvs.end()});
        const float large = extents_.at(&material).large;
        const auto parts = [&](float a, float b) {
            return std::max(1, int(std::ceil(std::max(a, b) / large - 1e-3f)));
        };
        const auto& q = outline;
        const int nu = parts(glm::distance(q[0], q[1]), glm::distance(q[3], q[2]));
        const int nv = parts(glm::distance(q[0], q[3]), glm::distance(q[1], q[2]));
        const auto at = [&](int i, int j) {
            const float s = float(i) / float(nu), t = float(j) / float(nv);
            return glm::mix(glm::mix(q[0], q[1], s), glm::mix(q[3], q[2], s), t);
        };
        const auto uvAt = [&](int i, int j) {
            const float s = float(i) / float(nu), t = float(j) / float(nv);
            return glm::mix(glm::mix(uvs[0], uvs[1], s), glm::mix(uvs[3], uvs[2], s), t);
        };
        for (int j = 0; j < nv; ++j)
            for (int i = 0; i < nu; ++i) {
                std::vector<glm::vec2> part;
                if (!uvs.empty())
                    part = {uvAt(i, j), uvAt(i + 1, j), uvAt(i + 1, j + 1), uvAt(i, j + 1)};
                addPiece(material, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, part);
            }
    }

private:
    /// Mean of the texture of emission over a convex piece.
    static Rgb meanOf(const Material& material, const std::vector<glm::vec3>& outline,
                      std::span<const glm::vec2> uvs) {
        const auto& texture = material.textures().emission;
        if (!texture || uvs.empty()) return Rgb(1);
        Rgb sum;
        float area = 0;
        for (std::size_t i = 2; i < outline.size(); ++i) {
            const std::array<glm::vec3, 4> at{outline[0], outline[i - 1], outline[i], outline[i]};
            const float part = glm::length(glm::cross(at[1] - at[0], at[2] - at[0]));
            sum += part * textureMean(*texture, at, {uvs[0], uvs[i - 1], uvs[i], uvs[i]});
            area += part;
        }
        return area > 0 ? sum * (1 / area) : Rgb();
    }

    struct Piece {
        std::vector<glm::vec3> outline;
        glm::vec3 middle;
        glm::dvec3 vectorArea{0}; ///< [m^2]
        double area = 0;          ///< its length
        Rgb texture;              ///< its mean
        std::size_t index = 0;
    };
    struct MaterialPieces {
        const Material* material = nullptr;
        std::vector<Piece> pieces;
    };
    struct Extents {
        float narrow = 0; ///< of pieces that send as one whichever way they look: their width [m]
        float small = 0;  ///< of pieces that send as one: their box's diagonal at most [m]
        float large = 0;  ///< of one piece: a side at most [m]
    };

    void addPiece(const Material& material, std::vector<glm::vec3> outline,
                  std::span<const glm::vec2> uvs) {
        const glm::dvec3 vectorArea = areaVector(outline);
        const double area = glm::length(vectorArea);
        if (!(area > 0)) return;
        const Rgb texture = meanOf(material, outline, uvs);
        if (!(maxChannel(texture) > 0)) return; // a dark part of a texture never emits
        auto of = std::ranges::find(pieces_, &material, &MaterialPieces::material);
        if (of == pieces_.end()) {
            pieces_.push_back({&material, {}});
            of = pieces_.end() - 1;
        }
        glm::vec3 middle(0);
        for (const glm::vec3 corner : outline) middle += corner / float(outline.size());
        of->pieces.push_back(
            {std::move(outline), middle, vectorArea, area, texture, of->pieces.size()});
    }

    /// Sorts pieces along the longest side of a box around their middles. \return its axis
    static int sortAlong(std::span<Piece> pieces) {
        Bounds box;
        for (const Piece& piece : pieces) box.add(piece.middle);
        const int axis = longestAxis(box.size());
        std::ranges::sort(pieces, {}, [axis](const Piece& piece) {
            return std::pair(piece.middle[axis], piece.index);
        });
        return axis;
    }

    /// Where neighbours lie farthest apart, preferably in the middle. 0: all lie at one place.
    static std::size_t widestGap(std::span<const Piece> pieces, int axis) {
        const float first = pieces.front().middle[axis], last = pieces.back().middle[axis];
        std::size_t best = 0;
        float widest = 0;
        for (std::size_t i = 1; i < pieces.size(); ++i) {
            const float from = pieces[i - 1].middle[axis], to = pieces[i].middle[axis];
            const float score = (to - from) * std::min(to - first, last - from);
            if (score > widest) widest = score, best = i;
        }
        return best;
    }

    /// Of a ball a receiver sees half, so half of its samples would be wasted. Parts pieces that
    /// look to either side of a plane. \return how many look to its front; 0: all look much the
    /// same way, or they are many things far apart, like the bulbs of a chandelier
    static std::size_t partByNormal(std::span<Piece> pieces, glm::vec3 size) {
        glm::dvec3 sum(0), squares(0);
        double area = 0;
        for (const Piece& piece : pieces) {
            sum += piece.vectorArea;
            squares += piece.vectorArea * piece.vectorArea / piece.area;
            area += piece.area;
        }
        if (glm::length(sum) > 0.6 * area) return 0; // of a hemisphere .5, of half of one .71
        if (area < 0.5 * (size.x * size.y + size.y * size.z + size.z * size.x)) return 0;
        // along the axis on which normals differ most
        const glm::dvec3 spread = squares - sum * sum / area;
        const int axis = longestAxis(spread);
        const auto back =
            std::stable_partition(pieces.begin(), pieces.end(), [axis](const Piece& piece) {
                return piece.vectorArea[axis] >= 0;
            });
        return std::size_t(back - pieces.begin());
    }

    /// The second longest of three sides.
    static float width(glm::vec3 size) {
        return std::max(std::min(size.x, size.y), std::min(std::max(size.x, size.y), size.z));
    }

    void group(const Material& material, std::span<Piece> pieces) {
        Bounds box;
        for (const Piece& piece : pieces)
            for (const glm::vec3 corner : piece.outline) box.add(corner);
        const Extents& extents = extents_.at(&material);
        std::size_t first = 0;
        if (box.diagonal() > extents.small) first = widestGap(pieces, sortAlong(pieces));
        if (first == 0 && width(box.size()) > extents.narrow)
            first = partByNormal(pieces, box.size());
        if (first % pieces.size() != 0) {
            group(material, pieces.first(first));
            group(material, pieces.subspan(first));
            return;
        }
        halve(pieces);
        FaceEmitter& faces = found_.emplace_back(FaceEmitter{{}, &material});
        Emitter& emitter = faces.emitter;
        for (Piece& piece : pieces) {
            emitter.area += piece.area;
            emitter.texture += (piece.texture - emitter.texture) * float(piece.area / emitter.area);
            emitter.polygons.push_back(std::move(piece.outline));
        }
        emitter.exitance = lambertianExitance(material.emission()) * emitter.texture;
    }

    /// Orders pieces so that neighbours in space are neighbours in the list, half by half.
    static void halve(std::span<Piece> pieces) {
        if (pieces.size() < 3) return;
        sortAlong(pieces);
        halve(pieces.first(pieces.size() / 2));
        halve(pieces.subspan(pieces.size() / 2));
    }

    std::map<const Material*, Extents> extents_;
    std::vector<MaterialPieces> pieces_;
    std::vector<FaceEmitter> found_;
};

} // namespace

std::vector<FaceEmitter> faceEmitters(const SurfaceMesh& mesh, const Tessellation& tessellation,
                                      float patchSize) {
    std::map<const Material*, double> areas;
    for (const SurfaceFace& face : mesh.faces)
        if (mesh.materialOf(face).emissive())
            areas[&mesh.materialOf(face)] +=
                0.5 * glm::length(newellNormal(mesh.points, mesh.cornersOf(face)));
    EmitterCollector collector(areas, patchSize);
    if (!mesh.subdivided()) {
        for (const SurfaceFace& face : mesh.faces) {
            if (!mesh.materialOf(face).emissive()) continue;
            std::vector<glm::vec3> outline;
            for (std::uint32_t corner : mesh.cornersOf(face))
                outline.push_back(mesh.points[corner]);
            collector.add(mesh.materialOf(face), outline, mesh.uvsOf(face));
        }
        return collector.take();
    }
    for (const Cell& cell : tessellation.cells) {
        const Material& material = mesh.materialOf(mesh.faces[cell.face]);
        if (!material.emissive()) continue;
        const auto first = tessellation.outline.begin() + cell.firstCorner;
        collector.add(
            material, {first, first + cell.cornerCount},
            tessellation.outlineUvs.empty()
                ? std::span<const glm::vec2>()
                : std::span(tessellation.outlineUvs).subspan(cell.firstCorner, cell.cornerCount));
    }
    return collector.take();
}

} // namespace penumbra
