// Puts tessellated surfaces together into a PatchSet.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/mesh/SurfaceMesh.h"
#include "radiosity/mesh/Tessellation.h"
#include "radiosity/rays/RayScene.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace penumbra {

/// Collects surfaces with add(), object by object, then makes patches of them with finish().
class PatchAssembly {
public:
    /// \param out has its objects and as many rayMeshes; the rest is filled in here
    explicit PatchAssembly(PatchSet& out) : out_(out) {}

    /// Adds the sides of `mesh` that there are as elements, and its triangles to the object's
    /// RayMesh. \param mesh in the object's stretched frame
    /// \pre all surfaces of an object follow one another
    void add(const SurfaceMesh& mesh, const Tessellation& tessellation, ObjectId object);

    /// Resolves contacts within the fixed part, groups the elements into patches and places the
    /// movable objects.
    void finish();

    /// Of out.materials, one by one.
    struct MaterialSource {
        const Material* material = nullptr;
        bool emits = false; ///< a front
    };
    const std::vector<MaterialSource>& materialSources() const { return materialSources_; }

private:
    /// A cell of one sheet, before contacts may divide it into several patches.
    struct SheetCell {
        std::vector<glm::vec3> outline;
        std::uint32_t material = 0;
        ObjectId object;
        bool present = false; ///< the surface has this side here
        bool whole = false;
        bool smooth = false; ///< of a subdivision surface
    };
    using CornerCoordinates = std::array<glm::vec2, 4>;
    /// A rectangle of a cell, in its coordinates from 0 to 1.
    struct Part {
        glm::vec2 low{1}, high{0};

        void add(glm::vec2 st) {
            low = glm::min(low, st);
            high = glm::max(high, st);
        }
    };
    /// Elements of a cell that hang together, and the part of the cell that they span.
    struct Group {
        std::vector<std::uint32_t> elements;
        Part part;
    };

    void addSheet(const SurfaceMesh& mesh, const Tessellation& tessellation, ObjectId object,
                  bool back);
    void addElements(const Tessellation& tessellation, std::uint32_t firstCell, ObjectId object,
                     bool back, bool textured);
    void addRays(const SurfaceMesh& mesh, const Tessellation& tessellation, ObjectId object);
    std::uint32_t materialIndex(const Material& material, bool emits);
    void resolveFixedContacts(std::vector<std::uint8_t>& free);
    std::vector<std::uint32_t> cellsInOrder() const;
    void orderVertices(const std::vector<std::vector<std::uint32_t>>& cellElements,
                       const std::vector<std::uint32_t>& order);
    void placeMovables();
    void makePatches(std::uint32_t cell, const std::vector<std::uint32_t>& elements);
    static void mergeOverlapping(std::vector<Group>& groups);
    bool measure(Patch& patch, const std::vector<std::uint32_t>& elements) const;
    Part placeCorners(Patch& patch, const SheetCell& cell, const Group& group, bool part);
    void placeVertices(std::uint32_t index, const std::vector<std::uint32_t>& elements,
                       const Part& part);
    void makePatch(const SheetCell& cell, const Group& group, bool part);
    void placeNodes(Patch& patch, const SheetCell& cell, const std::vector<std::uint32_t>& elements,
                    const Part& part);
    std::uint32_t nodeOfVertex(std::uint32_t vertex);

    PatchSet& out_;
    std::vector<SheetCell> cells_;
    std::vector<std::uint32_t> elementCell_;
    std::vector<CornerCoordinates> elementSt_;
    std::map<std::pair<const Material*, bool>, std::uint32_t> materials_;
    std::vector<MaterialSource> materialSources_;
    std::vector<std::uint32_t> vertexNode_;
    std::vector<std::uint8_t> vertexPlaced_;
};

} // namespace penumbra
