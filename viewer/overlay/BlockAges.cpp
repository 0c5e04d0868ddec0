#include "viewer/overlay/BlockAges.h"

#include "radiosity/process/RadiosityNode.h"

#include <algorithm>
#include <functional>
#include <string_view>

namespace penumbra {

namespace {

/// Of the light of a block; values that differ have different ones, for all that matters here.
std::uint64_t hashOf(const LitMeshData& data, std::size_t block) {
    const std::size_t first = block * LitGeometry::kBlock;
    const std::size_t count = std::min(LitGeometry::kBlock, data.direct.size() - first);
    const auto hash = [&](const std::vector<Rgb>& light) {
        return std::hash<std::string_view>()(
            {reinterpret_cast<const char*>(&light[first]), count * sizeof(Rgb)});
    };
    return hash(data.direct) + 31 * hash(data.indirect);
}

} // namespace

void BlockAges::follow(Entry& entry, const LitGeometry& geometry, double time) {
    const std::vector<std::uint64_t>& latest = geometry.blockRevisions();
    entry.blockRevisions.resize(latest.size());
    entry.light.resize(latest.size());
    entry.times.resize(latest.size(), time);
    for (std::size_t block = 0; block < latest.size(); ++block) {
        if (std::exchange(entry.blockRevisions[block], latest[block]) == latest[block]) continue;
        const std::uint64_t light = hashOf(geometry.data(), block);
        if (std::exchange(entry.light[block], light) == light) continue;
        newest_ = entry.times[block] = time;
    }
}

void BlockAges::advance(std::span<const LitObject> objects, double time) {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.alive.expired(); });
    for (const LitObject& object : objects) {
        if (!object.geometry) continue;
        Entry& entry = entries_[object.geometry.get()];
        entry.alive = object.geometry;
        if (std::exchange(entry.revision, object.geometry->revision()) !=
            object.geometry->revision())
            follow(entry, *object.geometry, time);
    }
}

std::span<const double> BlockAges::times(const LitGeometry& geometry) const {
    const auto found = entries_.find(&geometry);
    return found == entries_.end() ? std::span<const double>() : found->second.times;
}

} // namespace penumbra
