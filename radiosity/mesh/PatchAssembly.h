// Puts tessellated surfaces together into a PatchSet.
#pragma once

#include "base/Progress.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "radiosity/surface/Tessellation.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace penumbra {

/// Collects surfaces with add(), object by object, then makes patches of them with finish().
class PatchAssembly {
public:
    /// \param out has its objects and as many rayMeshes; the rest is filled in here
    explicit PatchAssembly(PatchSet& out) : out_(out), raySides_(out.objects.size()) {}

    /// Adds the sides of `mesh` that there are as elements, and its triangles to the object's
    /// RayMesh. \param mesh in the object's stretched frame \param far see Patch
    /// \pre all surfaces of an object follow one another
    void add(const SurfaceMesh& mesh, const Tessellation& tessellation, ObjectId object, bool far);

    /// Makes patches of the elements, as if no object were near another, and places the objects.
    void finish(const Progress& progress = {});

    /// Of out.materials, one by one.
    struct MaterialSource {
        const Material* material = nullptr;
        bool emits = false; ///< a front
    };
    const std::vector<MaterialSource>& materialSources() const { return materialSources_; }

private:
    /// A cell of one sheet.
    struct SheetCell {
        std::uint32_t firstCorner = 0, cornerCount = 0; ///< of outlines_; 0: there is no such side
        std::uint32_t material = 0;
        ObjectId object;
        bool back = false;
        bool whole = false;
        bool smooth = false;    ///< of a subdivision surface
        bool clustered = false; ///< in a group that is a cluster
        bool far = false;
    };
    /// See DenseVertex.
    struct VertexKind {
        std::uint32_t index = Element::kNone; ///< in its object's DenseMesh
        bool receives = true, flat = false;
    };
    /// Cells that become a patch together.
    using Group = std::vector<std::uint32_t>;
    /// Groups first ... last - 1.
    struct Run {
        std::size_t first, last;
    };
    std::span<const glm::vec3> outlineOf(const SheetCell& cell) const {
        return std::span(outlines_).subspan(cell.firstCorner, cell.cornerCount);
    }
    void addSheet(const SurfaceMesh& mesh, const Tessellation& tessellation, ObjectId object,
                  bool back);
    void addElements(const Tessellation& tessellation, std::uint32_t firstCell, ObjectId object,
                     bool back, bool textured);
    std::uint32_t materialIndex(const Material& material, bool emits);
    std::vector<Group> groupCells();
    std::vector<Group> groupsInOrder();
    CellElements elementsByCell() const;
    std::vector<std::vector<std::uint32_t>> elementsOf(const std::vector<Group>& groups) const;
    void orderElements(const std::vector<Group>& groups,
                       std::vector<std::vector<std::uint32_t>>& elements);
    void chooseReceivers(std::span<const Group> groups,
                         std::span<const std::vector<std::uint32_t>> elements,
                         std::vector<VertexKind>& kinds) const;
    std::vector<Run> runsOf(const std::vector<Group>& order) const;
    std::vector<VertexKind> kindsOf(std::span<const Run> runs, std::span<const Group> order,
                                    std::span<const std::vector<std::uint32_t>> elements) const;
    void orderVertices(const std::vector<std::vector<std::uint32_t>>& elements,
                       const std::vector<Group>& order);
    void findRayElements();
    void placeObjects();
    void makePatch(const Group& group, const std::vector<std::uint32_t>& elements);
    void placeElements(const Patch& patch, const std::vector<std::uint32_t>& elements);
    void placeVertices(std::uint32_t index, const std::vector<std::uint32_t>& elements);
    void placeNodes(Patch& patch, const SheetCell& cell,
                    const std::vector<std::uint32_t>& elements);
    std::uint32_t nodeOfVertex(std::uint32_t vertex);

    PatchSet& out_;
    std::vector<SheetCell> cells_;
    std::vector<glm::vec3> outlines_;
    std::vector<std::uint32_t> elementCell_;
    std::vector<std::vector<RaySide>> raySides_; ///< of each object: see findRayElements()
    std::vector<std::uint8_t> flat_;             ///< see DenseVertex; in blocks
    std::map<std::pair<const Material*, bool>, std::uint32_t> materials_;
    std::vector<MaterialSource> materialSources_;
};

} // namespace penumbra
