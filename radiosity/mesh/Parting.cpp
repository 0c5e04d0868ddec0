#include "radiosity/mesh/Parting.h"

#include "base/PairHash.h"
#include "radiosity/surface/UnionFind.h"

#include <algorithm>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = Element::kNone;
constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr std::uint64_t kMiddle = std::uint64_t(1) << 40;
/// Room for what may be parted later: at least so many patches, and blocks of nodes.
constexpr std::size_t kSparePatches = 128, kSpareBlocks = 16;
const PatchRectangle kWhole{glm::vec2(0), glm::vec2(1)};

bool same(const Receiver& a, const Receiver& b) {
    return a.position == b.position && a.normal == b.normal;
}

void makeUnique(std::vector<std::uint32_t>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::span<std::uint32_t> elementsOf(PatchSet& set, std::uint32_t patch) {
    const Patch& p = set.patches[patch];
    return std::span(set.patchElements).subspan(p.firstElement, p.elementCount);
}

} // namespace

Parting::Parting(PatchSet& set, const Fans& fans, std::span<const std::uint32_t> wholes)
    : set_(set), fans_(fans), nodePatches_(set) {
    PatchParts& parts = set_.parts;
    parts.firstPatch = std::uint32_t(set_.patches.size());
    parts.firstNode = std::uint32_t(set_.nodes.size());
    parts.used.assign(set_.patches.size(), 1);
    std::fill_n(parts.used.begin() + set_.room.patches.first, set_.room.patches.count, 0);
    parts.vertexCoordinates = set_.vertexCoordinates;
    update(wholes);
    growing_ = false;
    const std::size_t patches = set_.patches.size() - parts.firstPatch;
    const std::size_t blocks = (set_.nodes.size() - parts.firstNode) / kBlock;
    for (std::size_t i = std::max(kSparePatches, patches); i > 0; --i) addPatch();
    for (std::size_t i = std::max(kSpareBlocks, blocks); i > 0; --i) addBlock();
}

void Parting::add(ObjectId object) {
    const ObjectPart& part = set_.objects[object.value];
    PatchParts& parts = set_.parts;
    nodePatches_.add(part.patches, part.nodes);
    std::fill_n(parts.used.begin() + part.patches.first, part.patches.count, 1);
    for (std::uint32_t v = part.vertices.first; v < part.vertices.end(); ++v)
        parts.vertexCoordinates[v] = set_.vertexCoordinates[v];
}

Parting::Change Parting::update(std::span<const std::uint32_t> wholes) {
    change_ = {};
    for (const std::uint32_t whole : wholes)
        if (follow(whole)) change_.wholes.push_back(whole);
    for (const std::uint32_t whole : change_.wholes) {
        findUnusedNodes(whole);
        placeVertices(whole);
    }
    makeUnique(change_.patches);
    makeUnique(change_.nodes);
    return std::move(change_);
}

/// \return false: nothing touches the patch, nor did anything before
bool Parting::follow(std::uint32_t whole) {
    const std::uint32_t middle = set_.patches[whole].centreNode;
    const bool isTouched = touched(whole);
    if (!isTouched && !touched_.contains(whole)) return false;
    if (isTouched)
        touched_.insert(whole);
    else
        touched_.erase(whole);
    std::vector<Group> groups = groupsOf(whole);
    for (const std::uint32_t e : elementsOf(set_, whole)) set_.elements[e].patch = whole;
    const std::vector<std::uint32_t> patches = takeParts(whole, groups.size());
    if (patches.size() < groups.size()) { // there was no room: nothing parts it
        for (std::size_t i = 1; i < groups.size(); ++i)
            groups[0].elements.insert(groups[0].elements.end(), groups[i].elements.begin(),
                                      groups[i].elements.end());
        std::sort(groups[0].elements.begin(), groups[0].elements.end());
        groups[0].spans = kWhole;
        groups.resize(1);
    }
    std::vector<std::uint32_t> order;
    for (std::size_t i = 0; i < groups.size() && patches[0] != whole; ++i) {
        makePart(patches[i], whole, groups[i], std::uint32_t(order.size()));
        order.insert(order.end(), groups[i].elements.begin(), groups[i].elements.end());
    }
    const auto run = elementsOf(set_, whole);
    std::sort(run.begin(), run.end());
    if (!order.empty()) { // part by part, then what is covered
        for (const std::uint32_t e : run)
            if (set_.covered[e]) order.push_back(e);
        std::copy(order.begin(), order.end(), run.begin());
    }
    before_ = std::exchange(own_[whole], {});
    for (std::size_t i = 0; i < groups.size(); ++i) placeNodes(whole, patches[i], groups[i]);
    if (groups.empty() || patches[0] != whole) setNode(middle, {});
    giveBackNodes(whole);
    return true;
}

bool Parting::touched(std::uint32_t whole) const {
    const Patch& patch = set_.patches[whole];
    const auto run = std::span(set_.patchElements).subspan(patch.firstElement, patch.elementCount);
    return std::any_of(run.begin(), run.end(), [&](std::uint32_t e) {
        const auto& v = set_.elements[e].vertices;
        return set_.covered[e] || std::any_of(v.begin(), v.end(), [&](std::uint32_t vertex) {
                   return vertex >= set_.firstPrivate;
               });
    });
}

namespace {

/// What is sent is sent by the rectangle around a group: rectangles must not overlap.
bool overlap(const PatchRectangle& a, const PatchRectangle& b) {
    const glm::vec2 size = glm::min(a.high, b.high) - glm::max(a.low, b.low);
    return size.x > 1e-3f && size.y > 1e-3f;
}

template <class Group>
void mergeOverlapping(std::vector<Group>& groups) {
    for (std::size_t i = 0; i < groups.size(); ++i)
        for (std::size_t j = i + 1; j < groups.size(); ++j) {
            if (!overlap(groups[i].spans, groups[j].spans)) continue;
            Group& into = groups[i];
            const Group& from = groups[j];
            into.elements.insert(into.elements.end(), from.elements.begin(), from.elements.end());
            into.spans.add(from.spans.low);
            into.spans.add(from.spans.high);
            groups.erase(groups.begin() + std::ptrdiff_t(j));
            i = std::size_t(-1); // it has grown: search again
            break;
        }
}

} // namespace

/// Elements that are not covered, by which of them have drawn vertices in common.
std::vector<Parting::Group> Parting::groupsOf(std::uint32_t whole) const {
    const Patch& patch = set_.patches[whole];
    std::vector<std::uint32_t> elements;
    for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
        const std::uint32_t e = set_.patchElements[patch.firstElement + i];
        if (!set_.covered[e]) elements.push_back(e);
    }
    std::sort(elements.begin(), elements.end());
    if (elements.empty()) return {};
    UnionFind joined(elements.size());
    std::unordered_map<std::uint32_t, std::uint32_t> seen;
    for (std::uint32_t i = 0; i < elements.size() && patch.divisible; ++i)
        for (std::uint32_t v : set_.elements[elements[i]].vertices) {
            const auto [found, fresh] = seen.try_emplace(v, i);
            if (!fresh) joined.join(i, found->second);
        }
    std::unordered_map<std::uint32_t, std::size_t> groupOf;
    std::vector<Group> groups;
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
        const std::uint32_t root = patch.divisible ? joined.find(i) : 0;
        const auto [found, fresh] = groupOf.try_emplace(root, groups.size());
        if (fresh) groups.emplace_back();
        Group& group = groups[found->second];
        group.elements.push_back(elements[i]);
        for (glm::vec2 st : set_.parts.elementCoordinates[elements[i]]) group.spans.add(st);
    }
    mergeOverlapping(groups);
    for (Group& group : groups) std::sort(group.elements.begin(), group.elements.end());
    if (groups.size() == 1) groups[0].spans = kWhole;
    return groups;
}

/// The patches of so many groups: the whole patch itself if there is one only, or if there is no
/// room for more. Without any it sends nothing.
std::vector<std::uint32_t> Parting::takeParts(std::uint32_t whole, std::size_t count) {
    PatchParts& parts = set_.parts;
    const auto parted = parts.of.find(whole);
    const std::size_t had = parted != parts.of.end() ? parted->second.size() : 0;
    while (growing_ && count > 1 && freePatches_.size() + had < count) addPatch();
    const bool room = count < 2 || freePatches_.size() + had >= count;
    exhausted_ |= !room;
    if (count < 2 || !room) {
        giveBackParts(whole, 0);
        const std::uint8_t used = count > 0;
        if (std::exchange(parts.used[whole], used) != used) change_.patches.push_back(whole);
        return {whole};
    }
    giveBackParts(whole, count);
    std::vector<std::uint32_t>& slots = parts.of[whole];
    while (slots.size() < count) {
        slots.push_back(freePatches_.back());
        freePatches_.pop_back();
    }
    if (std::exchange(parts.used[whole], 0)) change_.patches.push_back(whole);
    return slots;
}

void Parting::giveBackParts(std::uint32_t whole, std::size_t left) {
    const auto parted = set_.parts.of.find(whole);
    if (parted == set_.parts.of.end()) return;
    std::vector<std::uint32_t>& slots = parted->second;
    for (; slots.size() > left; slots.pop_back()) {
        const std::uint32_t slot = slots.back();
        set_.parts.used[slot] = 0;
        set_.parts.wholePatch[slot - set_.parts.firstPatch] = kNone;
        set_.patches[slot].elementCount = 0;
        freePatches_.push_back(slot);
        change_.patches.push_back(slot);
    }
    if (slots.empty()) set_.parts.of.erase(parted);
}

/// \param first of its elements, in the run of the whole patch
void Parting::makePart(std::uint32_t slot, std::uint32_t whole, const Group& group,
                       std::uint32_t first) {
    const Patch& from = set_.patches[whole];
    Patch patch = from;
    patch.firstElement = from.firstElement + first;
    patch.elementCount = std::uint32_t(group.elements.size());
    measurePatch(set_, group.elements, patch);
    patch.divisible = false;
    patch.firstCorner = set_.patches[slot].firstCorner;
    patch.cornerCount = 4;
    const glm::vec3* const q = &set_.corners[from.firstCorner];
    const glm::vec2 low = group.spans.low, high = group.spans.high;
    bool changed = !std::exchange(set_.parts.used[slot], 1);
    std::uint32_t c = patch.firstCorner;
    for (const glm::vec2 st : {low, glm::vec2(high.x, low.y), high, glm::vec2(low.x, high.y)}) {
        const glm::vec3 corner =
            glm::mix(glm::mix(q[0], q[1], st.x), glm::mix(q[3], q[2], st.x), st.y);
        changed |= std::exchange(set_.corners[c++], corner) != corner;
    }
    const Patch& before = set_.patches[slot];
    changed |= before.centre != patch.centre || before.normal != patch.normal ||
               before.area != patch.area || before.object != patch.object ||
               before.material != patch.material || before.elementCount != patch.elementCount ||
               set_.parts.wholePatch[slot - set_.parts.firstPatch] != whole;
    set_.parts.wholePatch[slot - set_.parts.firstPatch] = whole;
    spans_[slot - set_.parts.firstPatch] = group.spans;
    set_.patches[slot] = patch;
    for (const std::uint32_t e : group.elements) set_.elements[e].patch = slot;
    if (!set_.textures.patches.empty())
        set_.textures.patches[slot] = textureMeanOf(set_, group.elements);
    if (changed) change_.patches.push_back(slot);
}

/// Where the vertices of a patch's elements lie in patches as they are now.
void Parting::placeVertices(std::uint32_t whole) {
    for (const std::uint32_t e : elementsOf(set_, whole))
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = set_.elements[e].vertices[k];
            if (v >= set_.firstPrivate) set_.vertexCoordinates[v] = placeIn(whole, e, k);
            const std::uint32_t shared = set_.uncoveredElements[e].vertices[k];
            set_.vertexCoordinates[shared] = placeOf(shared);
        }
}

PatchCoordinate Parting::placeIn(std::uint32_t whole, std::uint32_t element,
                                 std::size_t corner) const {
    const glm::vec2 st = glm::clamp(set_.parts.elementCoordinates[element][corner], 0.0f, 1.0f);
    const std::uint32_t patch = set_.elements[element].patch;
    if (patch == whole) {
        const std::uint32_t shared = set_.uncoveredElements[element].vertices[corner];
        const bool blends = set_.patches[whole].cluster;
        return {whole, st.x, st.y,
                blends ? set_.parts.vertexCoordinates[shared].blend : PatchCoordinate::kNone};
    }
    const PatchRectangle& spans = spans_[patch - set_.parts.firstPatch];
    const glm::vec2 size = glm::max(spans.high - spans.low, glm::vec2(1e-6f));
    const glm::vec2 in = glm::clamp((st - spans.low) / size, 0.0f, 1.0f);
    return {patch, in.x, in.y};
}

/// A shared vertex is of the patch that had it first, if that one has it still, or else of the
/// first that has it: in none if nothing around it is lit.
PatchCoordinate Parting::placeOf(std::uint32_t shared) const {
    const PatchCoordinate& base = set_.parts.vertexCoordinates[shared];
    PatchCoordinate found;
    for (const std::uint32_t corner : fans_.at(shared)) {
        const std::uint32_t e = corner / 4, k = corner % 4;
        const std::uint32_t whole = set_.uncoveredElements[e].patch;
        if (whole == kNone || set_.covered[e] || set_.elements[e].vertices[k] != shared) continue;
        const bool first = whole == base.patch;
        if (first && set_.elements[e].patch == whole) return base;
        if (first || found.patch == kNone) found = placeIn(whole, e, k);
        if (first) break;
    }
    return found;
}

/// Nodes are where the mesh has them, unless something touches the elements there.
void Parting::placeNodes(std::uint32_t whole, std::uint32_t patch, const Group& group) {
    Patch& at = set_.patches[patch];
    const NodePlaces places = findNodePlaces(set_, at, group.elements, group.spans);
    if (patch == whole) {
        setNode(at.centreNode, middleOf(whole, places));
    } else {
        at.centreNode = ownNode(whole, kMiddle + group.elements[0], places.centre);
        at.hasCornerNodes = !places.small;
    }
    for (std::size_t c = 0; c < 4 && at.hasCornerNodes; ++c) {
        const std::uint32_t v = places.vertices[c];
        const std::uint32_t shared = sharedNode(whole, v);
        at.cornerNodes[c] =
            shared != kNone ? shared : ownNode(whole, places.corners[c], set_.vertices[v].receiver);
    }
}

/// The node that the mesh has at a vertex, as one of the patch's, or kNone.
std::uint32_t Parting::sharedNode(std::uint32_t whole, std::uint32_t vertex) const {
    if (vertex >= set_.firstPrivate || !set_.patches[whole].hasCornerNodes) return kNone;
    const auto& nodes = set_.parts.cornerNodes[whole];
    const std::uint32_t node = set_.parts.vertexNode[vertex];
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end() ? node : kNone;
}

/// The middle node's own place, bit for bit, if nothing touches the element that it is in.
Receiver Parting::middleOf(std::uint32_t whole, const NodePlaces& places) const {
    const Patch& patch = set_.patches[whole];
    const auto all = std::span(set_.patchElements).subspan(patch.firstElement, patch.elementCount);
    const std::uint32_t e = places.centreElement;
    const bool free = findNodePlaces(set_, patch, all, kWhole).centreElement == e &&
                      set_.elements[e].vertices == set_.uncoveredElements[e].vertices;
    return free ? set_.uncoveredNodes[patch.centreNode] : places.centre;
}

std::uint32_t Parting::ownNode(std::uint32_t whole, std::uint64_t key, const Receiver& place) {
    OwnNodes& own = own_[whole];
    std::uint32_t node = kNone;
    if (const auto now = own.find(key); now != own.end()) {
        node = now->second;
    } else if (const auto had = before_.find(key); had != before_.end()) {
        node = had->second;
        before_.erase(had);
    } else {
        node = takeNode(whole);
    }
    if (node == kNone) return set_.patches[whole].centreNode; // there was no room
    own[key] = node;
    const ObjectPart& part = set_.objects[set_.patches[whole].object.value];
    const bool middle = key >= kMiddle;
    const auto element = std::uint32_t(middle ? key - kMiddle : key / 4) - part.elements.first;
    const std::uint32_t corner = middle ? 4 : std::uint32_t(key % 4);
    set_.parts.nodeAddress[node - set_.parts.firstNode] =
        pairHash(addressOfPatch(set_, whole), 5 * element + corner);
    setNode(node, place);
    return node;
}

void Parting::giveBackNodes(std::uint32_t whole) {
    PatchParts& parts = set_.parts;
    for (const auto& [key, node] : before_) {
        setNode(node, {});
        parts.nodePatch[node - parts.firstNode] = kNone;
        parts.nodeAddress[node - parts.firstNode] = 0;
        std::uint32_t& source = parts.sourceBlock[(node - parts.firstNode) / kBlock];
        std::vector<std::uint32_t>& free = freeNodes_[source];
        free.push_back(node);
        const std::uint32_t first = node / kBlock * kBlock;
        const auto ofBlock = [&](std::uint32_t n) { return n - first < kBlock; };
        if (std::count_if(free.begin(), free.end(), ofBlock) < std::ptrdiff_t(kBlock)) continue;
        std::erase_if(free, ofBlock);
        source = kNone;
        freeBlocks_.push_back(first / kBlock);
    }
    before_.clear();
    if (own_[whole].empty()) own_.erase(whole);
}

void Parting::setNode(std::uint32_t node, const Receiver& place) {
    if (same(set_.nodes[node], place)) return;
    set_.nodes[node] = place;
    change_.nodes.push_back(node);
}

bool Parting::usesNode(std::uint32_t whole, std::uint32_t node) const {
    bool uses = false;
    set_.forEachPart(whole, [&](std::uint32_t p) {
        const Patch& patch = set_.patches[p];
        uses |= set_.parts.used[p] && patch.hasCornerNodes &&
                std::find(patch.cornerNodes.begin(), patch.cornerNodes.end(), node) !=
                    patch.cornerNodes.end();
    });
    return uses;
}

/// A node of the mesh that no patch has any more receives nothing.
void Parting::findUnusedNodes(std::uint32_t whole) {
    if (!set_.patches[whole].hasCornerNodes) return;
    for (const std::uint32_t node : set_.parts.cornerNodes[whole]) {
        const auto patches = nodePatches_.of(node);
        const bool used = std::any_of(patches.begin(), patches.end(),
                                      [&](std::uint32_t p) { return usesNode(p, node); });
        setNode(node, used ? set_.uncoveredNodes[node] : Receiver{});
    }
}

/// Room for one more part.
void Parting::addPatch() {
    const auto slot = std::uint32_t(set_.patches.size());
    Patch patch;
    patch.firstCorner = std::uint32_t(set_.corners.size());
    patch.object = {0};
    set_.corners.resize(set_.corners.size() + 4);
    set_.patches.push_back(patch);
    set_.parts.used.push_back(0);
    set_.parts.wholePatch.push_back(kNone);
    spans_.emplace_back();
    if (!set_.textures.patches.empty()) set_.textures.patches.push_back(Rgb(1));
    freePatches_.push_back(slot);
}

/// Room for one more block of nodes.
void Parting::addBlock() {
    const auto block = std::uint32_t(set_.nodes.size() / kBlock);
    set_.nodes.resize(set_.nodes.size() + kBlock, Receiver{});
    set_.uncoveredNodes.resize(set_.nodes.size(), Receiver{});
    set_.nodeBlockObject.push_back({0});
    set_.parts.nodePatch.resize(set_.nodes.size() - set_.parts.firstNode, kNone);
    set_.parts.nodeAddress.resize(set_.nodes.size() - set_.parts.firstNode, 0);
    set_.parts.sourceBlock.push_back(kNone);
    freeBlocks_.push_back(block);
}

/// Near others of the same whole patch: see PatchParts::sourceBlock.
std::uint32_t Parting::takeNode(std::uint32_t whole) {
    PatchParts& parts = set_.parts;
    const Patch& patch = set_.patches[whole];
    const std::uint32_t source = patch.centreNode / kBlock;
    std::vector<std::uint32_t>& free = freeNodes_[source];
    if (free.empty()) {
        if (freeBlocks_.empty() && growing_) addBlock();
        if (freeBlocks_.empty()) {
            exhausted_ = true;
            return kNone;
        }
        const std::uint32_t block = freeBlocks_.back();
        freeBlocks_.pop_back();
        parts.sourceBlock[block - parts.firstNode / kBlock] = source;
        set_.nodeBlockObject[block] = patch.object;
        for (std::uint32_t i = kBlock; i-- > 0;) free.push_back(block * kBlock + i);
    }
    const std::uint32_t node = free.back();
    free.pop_back();
    parts.nodePatch[node - parts.firstNode] = whole;
    return node;
}

} // namespace penumbra
