// What an edit did to a PatchSet.
#pragma once

#include "base/ObjectId.h"

#include <cstdint>
#include <vector>

namespace penumbra {

/// What is not as it was in a PatchSet and its RayScene.
struct SceneChange {
    std::vector<ObjectId> objects;       ///< posed anew, hidden or shown, with all that is theirs
    std::vector<std::uint32_t> vertices; ///< others that lie elsewhere
    std::vector<std::uint32_t> nodes;    ///< likewise
    std::vector<std::uint32_t> patches;  ///< of the mesh, whose elements are lit at other points
    std::vector<std::uint32_t> senders;  ///< patches that send from elsewhere, or not, or begin to
    std::vector<std::uint32_t> parted;   ///< of the mesh, which are parted otherwise, see Parting
    std::vector<std::uint32_t> emitters; ///< of another exitance
    bool colours = false;                ///< some reflectance or emission

    void add(const SceneChange& more) {
        const auto append = [](auto& to, const auto& from) {
            to.insert(to.end(), from.begin(), from.end());
        };
        append(objects, more.objects);
        append(vertices, more.vertices);
        append(nodes, more.nodes);
        append(patches, more.patches);
        append(senders, more.senders);
        append(parted, more.parted);
        append(emitters, more.emitters);
        colours |= more.colours;
    }
    bool empty() const {
        return objects.empty() && vertices.empty() && nodes.empty() && patches.empty() &&
               emitters.empty() && senders.empty() && parted.empty() && !colours;
    }
};

} // namespace penumbra
