// Light on its way from the solver to a store.
#pragma once

#include "radiosity/LitScene.h"
#include "radiosity/process/LightStore.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

/// Keeps a store true to a LitScene: remembers which blocks are not as they were published, and
/// writes these, a bounded number at a time.
class LightPublisher {
public:
    /// \param scene must outlive this, and not be meshed anew
    explicit LightPublisher(LitScene& scene);

    /// Where to publish from now on: everything.
    void setStore(std::unique_ptr<StoreWriter> store);
    bool hasStore() const { return store_ != nullptr; }
    /// Whether there are more blocks than the store has room for: it needs another one.
    bool outgrown() const;
    std::uint32_t blockCount() const;

    /// An edit was taken in.
    void follow(const SceneChange& change);
    /// The solver has worked: looks at the direct light, which it has told of what changed.
    void directWorked();
    /// Looks at all light. \param settled all light is as it will stay
    void solverWorked(bool settled);
    /// Publishes at most so many blocks. \return false: there was none
    bool publish(std::size_t most);
    std::size_t open() const { return open_.size(); }

private:
    void touch(std::uint32_t block);
    void nodesChanged(bool exact);
    LightBlock blockOf(std::uint32_t block) const;
    Rgb interpolatedAt(std::uint32_t vertex) const;
    Rgb indirectAt(std::uint32_t vertex) const;
    void writeCorners(std::uint32_t block, LightBlock& light) const;

    LitScene& scene_;
    std::unique_ptr<StoreWriter> store_;
    std::vector<std::uint32_t> elementNumber_;            ///< see numberElements()
    std::vector<std::vector<std::uint32_t>> patchBlocks_; ///< blocks lit by the nodes of a patch
    std::vector<glm::dvec3> nodes_;                       ///< illuminance that is published [lux]
    std::vector<Rgb> detail_; ///< what fine shadows added when it was settled last [lux]
    std::vector<std::uint32_t> open_;
    std::vector<std::uint8_t> touched_;
};

} // namespace penumbra
