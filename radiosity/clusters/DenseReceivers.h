// Which vertices of a dense mesh receive light.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra {

/// A vertex of an object.
struct DenseVertex {
    enum class Role : std::uint8_t {
        open,     ///< may receive or take from others
        receives, ///< and others may take from it
        alone     ///< receives, but others may not take from it
    };
    glm::vec3 position{0}, normal{0}; ///< [m, frame of the object]
    Role role = Role::open;
    /// Filled in: inside of a smooth piece, with nothing that rises beside it. What sees as much of
    /// a light as others near by.
    bool flat = false;
};

/// What of an object is clustered.
struct DenseMesh {
    std::vector<DenseVertex> vertices; ///< all of the object's
    /// Indices into vertices, cluster by cluster; a triangle has its last corner twice.
    std::vector<std::array<std::uint32_t, 4>> faces;
    std::vector<std::uint32_t> firstFace; ///< one a cluster, and one for the end
};

/// Whether what is seen at a place of a surface is about what is seen at another: the one is no
/// groove of which the other is the ridge. \param cosine between the normals, at least
/// \param slope over each other's tangent plane, at most
bool isAlongside(const DenseVertex& a, const DenseVertex& b, float cosine, float slope);

/// Chooses receivers among the open vertices of clusters: in each, as many as are an element apart
/// or look another way; at creases, borders and beside what rises, an eighth of an element: nearer
/// vertices are made for the shape, not for light. An earlier face's are chosen rather. Those that
/// stay open lie alongside a receiver of one of their clusters, flat ones alongside a flat one.
void chooseReceivers(DenseMesh& mesh, float elementSize);

} // namespace penumbra
