#include "radiosity/process/LightPublisher.h"

#include "radiosity/Interpolation.h"
#include "radiosity/Parallel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

/// Light that differs by less is not published while it is still being worked on: half the
/// precision of 16-bit floats.
constexpr double kSmall = 0x1p-12;

bool differs(const glm::dvec3& a, const glm::dvec3& b, bool exact) {
    if (exact) return a != b;
    for (int c = 0; c < 3; ++c)
        if (std::abs(a[c] - b[c]) > kSmall * std::max(std::abs(a[c]), std::abs(b[c]))) return true;
    return false;
}

} // namespace

LightPublisher::LightPublisher(LitScene& scene)
    : scene_(scene), elementNumber_(numberElements(scene.patches())),
      patchBlocks_(scene.patches().patches.size()), nodes_(scene.patches().nodes.size()) {
    const PatchSet& set = scene.patches();
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v) {
        const std::uint32_t patch = set.vertexCoordinates[v].patch;
        if (patch == Element::kNone) continue;
        std::vector<std::uint32_t>& blocks = patchBlocks_[patch];
        if (std::find(blocks.rbegin(), blocks.rend(), v / kBlock) == blocks.rend())
            blocks.push_back(v / kBlock);
    }
}

std::uint32_t LightPublisher::blockCount() const {
    return std::uint32_t(scene_.patches().vertices.size() / kBlock);
}

bool LightPublisher::outgrown() const {
    return store_ && store_->shape().blocks < blockCount();
}

void LightPublisher::setStore(std::unique_ptr<StoreWriter> store) {
    store_ = std::move(store);
    for (std::uint32_t b = 0; b < blockCount(); ++b) touch(b);
}

void LightPublisher::touch(std::uint32_t block) {
    if (touched_.size() <= block) touched_.resize(std::max(block + 1, blockCount()));
    if (!std::exchange(touched_[block], 1)) open_.push_back(block);
}

void LightPublisher::follow(const SceneChange& change) {
    for (std::uint32_t vertex : change.vertices) {
        touch(vertex / kBlock);
        const std::uint32_t patch = scene_.patches().vertexCoordinates[vertex].patch;
        if (patch == Element::kNone) continue;
        std::vector<std::uint32_t>& blocks = patchBlocks_[patch];
        if (std::find(blocks.begin(), blocks.end(), vertex / kBlock) == blocks.end())
            blocks.push_back(vertex / kBlock);
    }
}

void LightPublisher::directWorked() {
    for (std::uint32_t block : scene_.solver().takeSummedBlocks()) touch(block);
}

void LightPublisher::solverWorked(bool settled) {
    directWorked();
    nodesChanged(settled);
    if (!settled || scene_.solver().directOnly()) return;
    const Lighting light = scene_.solver().lighting();
    detail_.resize(light.indirect.size());
    for (std::uint32_t v = 0; v < detail_.size(); ++v)
        if (const Rgb detail = light.indirect[v] - interpolatedAt(v); detail != detail_[v]) {
            detail_[v] = detail;
            touch(v / kBlock);
        }
}

/// \param exact takes note of the smallest change, not only of what can be seen
void LightPublisher::nodesChanged(bool exact) {
    const std::vector<glm::dvec3> now = scene_.solver().nodeIlluminance();
    const PatchSet& set = scene_.patches();
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        const Patch& patch = set.patches[p];
        const auto changed = [&](std::uint32_t node) {
            return differs(nodes_[node], now[node], exact);
        };
        if (!changed(patch.centreNode) &&
            !(patch.hasCornerNodes &&
              std::any_of(patch.cornerNodes.begin(), patch.cornerNodes.end(), changed)))
            continue;
        for (std::uint32_t block : patchBlocks_[p]) touch(block);
    }
    nodes_ = now;
}

bool LightPublisher::publish(std::size_t most) {
    if (!store_ || open_.empty()) return false;
    store_->setUsed(std::min(blockCount(), store_->shape().blocks));
    const std::size_t count = std::min(most, open_.size());
    const auto some = std::span(open_).last(count);
    parallelFor(count, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (some[i] < store_->shape().blocks) store_->write(some[i], blockOf(some[i]));
    });
    for (std::uint32_t block : some) touched_[block] = 0;
    open_.resize(open_.size() - count);
    return true;
}

LightBlock LightPublisher::blockOf(std::uint32_t block) const {
    const PatchSet& set = scene_.patches();
    LightBlock light;
    light.object = set.vertexBlockObject[block].value;
    std::array<float, 3 * kBlock> direct, indirect;
    const std::span<const Rgb> lit = scene_.solver().direct().vertices();
    for (std::uint32_t k = 0; k < kBlock; ++k) {
        const std::uint32_t v = block * kBlock + k;
        const Rgb from = v < lit.size() ? lit[v] : Rgb();
        const Rgb between = indirectAt(v);
        direct[3 * k] = from.r, direct[3 * k + 1] = from.g, direct[3 * k + 2] = from.b;
        indirect[3 * k] = between.r, indirect[3 * k + 1] = between.g,
                     indirect[3 * k + 2] = between.b;
    }
    light.directScale = packHalves(direct, light.direct.data());
    light.indirectScale = packHalves(indirect, light.indirect.data());
    if (block * kBlock >= set.firstPrivate) writeCorners(block, light);
    return light;
}

Rgb LightPublisher::interpolatedAt(std::uint32_t vertex) const {
    const PatchSet& set = scene_.patches();
    const auto [index, s, t] = set.vertexCoordinates[vertex];
    if (index == Element::kNone || scene_.solver().directOnly()) return {};
    const glm::dvec3 light = interpolateNodes<glm::dvec3>(set.patches[index], s, t, nodes_);
    return {float(light.x), float(light.y), float(light.z)};
}

Rgb LightPublisher::indirectAt(std::uint32_t vertex) const {
    const bool known = vertex < detail_.size() &&
                       scene_.patches().vertexCoordinates[vertex].patch != Element::kNone;
    return interpolatedAt(vertex) + (known ? detail_[vertex] : Rgb());
}

void LightPublisher::writeCorners(std::uint32_t block, LightBlock& light) const {
    const PatchSet& set = scene_.patches();
    for (std::uint32_t k = 0; k < kBlock; ++k) {
        const std::uint32_t v = block * kBlock + k;
        light.corners[k] = kNoCorner;
        if (isPadding(set.vertices[v].receiver)) continue;
        const std::uint32_t element = set.privateElement[v - set.firstPrivate];
        const auto& corners = set.elements[element].vertices;
        const auto corner = std::find(corners.begin(), corners.end(), v) - corners.begin();
        if (corner < 4) light.corners[k] = 4 * elementNumber_[element] + std::uint32_t(corner);
    }
}

} // namespace penumbra
