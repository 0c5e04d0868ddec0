#include "radiosity/transport/PatchMatch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace penumbra {

namespace {

constexpr std::uint32_t kNew = PatchMatch::kNew;
constexpr std::uint32_t kBlock = PatchSet::kBlock;

using ObjectsByPath = std::unordered_map<std::string_view, std::uint32_t>;

ObjectsByPath objectsByPath(const PatchSet& set) {
    ObjectsByPath objects;
    for (std::uint32_t o = 0; o < set.objects.size(); ++o) objects[set.objects[o].path] = o;
    return objects;
}

/// Paths that several objects have: which is which can't be told.
std::unordered_set<std::string_view> sharedPaths(const PatchSet& set) {
    std::unordered_set<std::string_view> seen, shared;
    for (const ObjectPart& part : set.objects)
        if (!seen.insert(part.path).second) shared.insert(part.path);
    return shared;
}

/// Bits, so that what is no number equals itself.
using Key = std::array<std::uint32_t, 7>;

Key keyOf(const Receiver& receiver, std::uint32_t address) {
    return {std::bit_cast<std::uint32_t>(receiver.position.x),
            std::bit_cast<std::uint32_t>(receiver.position.y),
            std::bit_cast<std::uint32_t>(receiver.position.z),
            std::bit_cast<std::uint32_t>(receiver.normal.x),
            std::bit_cast<std::uint32_t>(receiver.normal.y),
            std::bit_cast<std::uint32_t>(receiver.normal.z),
            address};
}

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0;
        for (const std::uint32_t word : key)
            hash = std::rotl((hash ^ word) * 0x9e3779b97f4a7c15u, 29);
        return std::size_t(hash);
    }
};

bool sameRays(const RayMesh& a, const RayMesh& b) {
    return a.vertices == b.vertices && a.triangles == b.triangles && a.solid == b.solid &&
           a.lit == b.lit;
}

bool sameObject(const PatchSet& before, std::uint32_t was, const PatchSet& now, std::uint32_t is) {
    const ObjectPart &a = before.objects[was], &b = now.objects[is];
    return a.present == b.present && sameRays(before.rayMeshes[was], now.rayMeshes[is]);
}

bool sameShape(const Emitter& a, const Emitter& b) {
    return a.kind == b.kind && a.polygons == b.polygons && a.centre == b.centre &&
           a.axis == b.axis && a.radius == b.radius && a.area == b.area;
}

/// Receivers of one kind, block by block.
struct Receivers {
    const std::vector<ObjectId>& blockObjects;
    std::vector<Key> keys;
};

/// The blocks of every object.
std::vector<std::vector<std::uint32_t>> blocksOf(const Receivers& receivers, std::size_t objects) {
    std::vector<std::vector<std::uint32_t>> blocks(objects);
    for (std::uint32_t b = 0; b < receivers.blockObjects.size(); ++b)
        blocks[receivers.blockObjects[b].value].push_back(b);
    return blocks;
}

/// Finds the receivers of some blocks among those of others: block by block where nothing was put
/// in or taken out, else one by one.
void matchBlocks(const Receivers& before, const std::vector<std::uint32_t>& were,
                 const Receivers& now, const std::vector<std::uint32_t>& are,
                 std::vector<std::uint32_t>& match) {
    const auto sameBlock = [&](std::uint32_t a, std::uint32_t b) {
        return std::equal(before.keys.begin() + a * kBlock, before.keys.begin() + (a + 1) * kBlock,
                          now.keys.begin() + b * kBlock);
    };
    std::unordered_map<Key, std::uint32_t, KeyHash> places;
    for (std::size_t i = 0; i < are.size(); ++i) {
        const std::uint32_t first = are[i] * kBlock;
        if (i < were.size() && sameBlock(were[i], are[i])) {
            for (std::uint32_t r = 0; r < kBlock; ++r) match[first + r] = were[i] * kBlock + r;
            continue;
        }
        if (places.empty())
            for (const std::uint32_t b : were)
                for (std::uint32_t v = b * kBlock; v < (b + 1) * kBlock; ++v)
                    places.try_emplace(before.keys[v], v);
        for (std::uint32_t v = first; v < first + kBlock; ++v)
            if (const auto place = places.find(now.keys[v]); place != places.end())
                match[v] = place->second;
    }
}

Receivers verticesOf(const PatchSet& set) {
    Receivers receivers{set.vertexBlockObject, {}};
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v)
        receivers.keys.push_back(keyOf(set.vertices[v].receiver, set.isBlended(v / kBlock)));
    return receivers;
}

Receivers nodesOf(const PatchSet& set) {
    Receivers receivers{set.nodeBlockObject, {}};
    for (std::uint32_t n = 0; n < set.nodes.size(); ++n)
        receivers.keys.push_back(keyOf(set.nodes[n], addressOfNode(set, n)));
    return receivers;
}

/// \param was of each object now: its number before
std::vector<std::uint32_t> matchReceivers(const Receivers& before, const Receivers& now,
                                          const std::vector<std::uint32_t>& was,
                                          std::size_t objectsBefore) {
    std::vector<std::uint32_t> match(now.keys.size(), kNew);
    const auto were = blocksOf(before, objectsBefore), are = blocksOf(now, was.size());
    for (std::size_t o = 0; o < was.size(); ++o)
        if (was[o] != kNew) matchBlocks(before, were[was[o]], now, are[o], match);
    return match;
}

std::vector<std::uint32_t> matchEmitters(const PatchSet& before, const PatchSet& now,
                                         const std::vector<std::uint32_t>& was) {
    std::vector<std::uint32_t> match(now.emitters.size(), kNew);
    std::vector<std::uint8_t> taken(before.emitters.size()); // each is one emitter now
    for (std::size_t o = 0; o < was.size(); ++o) {
        if (was[o] == kNew) continue;
        const Range were = before.objects[was[o]].emitters, are = now.objects[o].emitters;
        for (std::uint32_t i = 0; i < are.count; ++i) {
            const Emitter& emitter = now.emitters[are.first + i];
            const auto same = [&](std::uint32_t e) {
                return !taken[e] && sameShape(before.emitters[e], emitter);
            };
            std::uint32_t e = std::min(were.first + i, were.end());
            if (e == were.end() || !same(e))
                for (e = were.first; e < were.end() && !same(e);) ++e;
            if (e == were.end()) continue;
            match[are.first + i] = e;
            taken[e] = 1;
        }
    }
    return match;
}

} // namespace

bool PatchMatch::isChanged(ObjectId object) const {
    return std::find(changed.begin(), changed.end(), object) != changed.end();
}

PatchMatch matchPatches(const PatchSet& before, const PatchSet& now) {
    PatchMatch match;
    const ObjectsByPath named = objectsByPath(now);
    const auto sharedBefore = sharedPaths(before), sharedNow = sharedPaths(now);
    std::vector<std::uint32_t> was(now.objects.size(), kNew);
    for (std::uint32_t o = 0; o < before.objects.size(); ++o) {
        const std::string_view path = before.objects[o].path;
        const auto found = named.find(path);
        match.objects.push_back(found != named.end() ? found->second : kNew);
        const bool shared = sharedBefore.contains(path) || sharedNow.contains(path);
        if (found != named.end() && !shared && sameObject(before, o, now, found->second))
            was[found->second] = o;
    }
    for (std::uint32_t o = 0; o < was.size(); ++o)
        if (was[o] == kNew) match.changed.push_back({o});
    match.emitters = matchEmitters(before, now, was);
    match.vertices =
        matchReceivers(verticesOf(before), verticesOf(now), was, before.objects.size());
    match.nodes = matchReceivers(nodesOf(before), nodesOf(now), was, before.objects.size());
    return match;
}

void keepGone(const PatchSet& before, PatchSet& now, bool all) {
    const ObjectsByPath named = objectsByPath(now);
    std::vector<ObjectPart> gone;
    for (std::uint32_t o = 0; o < before.objects.size(); ++o) {
        const ObjectPart& part = before.objects[o];
        if (named.contains(part.path) || (!all && before.rayMeshes[o].vertices.empty())) continue;
        ObjectPart left;
        left.path = part.path;
        left.key = part.key;
        left.removed = true;
        left.present = false;
        gone.push_back(std::move(left));
    }
    for (ObjectPart& part : gone) {
        now.objects.push_back(std::move(part));
        now.rayMeshes.emplace_back();
    }
}

} // namespace penumbra
