#include "radiosity/mesh/Coverage.h"

#include "base/Parallel.h"
#include "radiosity/mesh/OpenElements.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"

#include <algorithm>

namespace penumbra {

namespace {

const ContactResolver::Result kFree{true, {}, {}};
constexpr const char* kPhase = "finding what touches";

void makeUnique(std::vector<std::uint32_t>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Vertices that are covered all round are in no patch: as Parting has it, where there are nodes.
void noteCovered(PatchSet& set, const Fans& fans, std::span<const std::uint32_t> vertices) {
    for (const std::uint32_t v : vertices) {
        const auto isDrawn = [&](std::uint32_t corner) {
            const std::uint32_t e = corner / 4;
            return set.uncoveredElements[e].patch != Element::kNone && !set.covered[e] &&
                   set.elements[e].vertices[corner % 4] == v;
        };
        const auto corners = fans.at(v);
        const auto drawn = std::ranges::find_if(corners, isDrawn);
        set.vertexCoordinates[v].patch =
            drawn != corners.end() ? set.uncoveredElements[*drawn / 4].patch : Element::kNone;
    }
}

} // namespace

Coverage::Coverage(PatchSet& set, const RayScene& rays, const Progress& progress)
    : set_(set), rays_(rays), resolver_(rays, set.rayMeshes, set.skin, set.vertices),
      shared_(set.uncoveredElements), fans_(fansOf(shared_, set.vertices.size())) {
    set_.displaced.resize(set_.firstPrivate);
    for (std::uint32_t o = 0; o < set_.objects.size(); ++o) orderElements({o});
    std::vector<std::uint32_t> all;
    for (std::uint32_t e = 0; e < shared_.size(); ++e)
        if (set_.objects[set_.elementObject[e].value].present) all.push_back(e);
    Change change;
    refresh(std::move(all), change, progress);
    if (!set_.nodes.empty()) parting_.emplace(set_, fans_, change.patches);
}

void Coverage::add(std::span<const ObjectId> objects) {
    for (const ObjectId object : objects) {
        const ObjectPart& part = set_.objects[object.value];
        fans_.add(shared_, part.elements, part.vertices);
        orderElements(object);
        if (parting_) parting_->add(object);
    }
}

/// Patches lie along a curve; elements that no patch owns are left out.
void Coverage::orderElements(ObjectId object) {
    const ObjectPart& part = set_.objects[object.value];
    const std::size_t first = order_.size();
    for (std::uint32_t p = part.patches.first; p < part.patches.end(); ++p) {
        const Patch& patch = set_.patches[p];
        order_.insert(order_.end(), set_.patchElements.begin() + patch.firstElement,
                      set_.patchElements.begin() + patch.firstElement + patch.elementCount);
    }
    for (std::size_t i = first; i < order_.size(); i += kChunk) {
        chunkObject_.push_back(object);
        chunkFirst_.push_back(std::uint32_t(std::min<std::size_t>(i + kChunk, order_.size())));
        places_.append({});
        updateChunk(chunkObject_.size() - 1);
    }
}

Bounds Coverage::boxOf(std::uint32_t element) const {
    Bounds box;
    for (std::uint32_t v : shared_[element].vertices) box.add(set_.vertices[v].position);
    return box;
}

void Coverage::updateChunk(std::size_t chunk) {
    Bounds place;
    for (std::uint32_t i = chunkFirst_[chunk]; i < chunkFirst_[chunk + 1]; ++i) {
        const Bounds box = boxOf(order_[i]);
        place.add(box);
        largest_ = std::max(largest_, box.diagonal());
    }
    places_.set(chunk, place);
}

/// Elements whose lie an object within `box` may decide: those that it can touch or hold.
void Coverage::collectNear(const Bounds& box, std::vector<std::uint32_t>& elements) const {
    if (box.empty()) return;
    const float hover = hoverAt(set_.skin, magnitude(box));
    const float reach = coverDistance(largest_, hover) + 8 * hover;
    const Bounds target = grown(box, reach);
    places_.query([&](std::size_t n) { return target.overlaps(places_.node(n)); },
                  [&](std::size_t chunk) {
                      if (!set_.objects[chunkObject_[chunk].value].present) return;
                      for (std::uint32_t i = chunkFirst_[chunk]; i < chunkFirst_[chunk + 1]; ++i)
                          if (target.overlaps(boxOf(order_[i]))) elements.push_back(order_[i]);
                  });
}

Coverage::Change Coverage::update(std::span<const ObjectId> moved, std::span<const Bounds> before) {
    Change change;
    std::vector<std::uint32_t> near;
    for (std::size_t c = 0; c < chunkObject_.size(); ++c)
        if (std::find(moved.begin(), moved.end(), chunkObject_[c]) != moved.end()) updateChunk(c);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const ObjectPart& part = set_.objects[moved[i].value];
        collectNear(before[i], near);
        if (part.present) collectNear(boundsOf(set_, moved[i]), near);
        for (std::uint32_t e = part.elements.first; e < part.elements.end(); ++e) near.push_back(e);
    }
    refresh(std::move(near), change);
    return change;
}

void Coverage::refresh(std::vector<std::uint32_t> elements, Change& change,
                       const Progress& progress) {
    std::erase_if(elements, [&](std::uint32_t e) { return shared_[e].patch == Element::kNone; });
    makeUnique(elements);
    examine(elements, shareOf(progress, 0, 0.6));
    if (progress) progress(kPhase, 0.6);
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t e : elements) {
        const auto& v = shared_[e].vertices;
        vertices.insert(vertices.end(), v.begin(), v.end());
    }
    makeUnique(vertices);
    std::vector<std::uint8_t> apart(vertices.size());
    parallelFor(vertices.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) apart[i] = parted(vertices[i]);
    });
    if (progress) progress(kPhase, 0.8);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::uint32_t corner : fans_.at(vertices[i]))
            if (shared_[corner / 4].patch != Element::kNone)
                settleCorner(corner / 4, corner % 4, apart[i], change);
    makeUnique(change.vertices);
    makeUnique(change.patches);
    if (parting_)
        change.parted = parting_->update(change.patches);
    else if (set_.nodes.empty()) // else it is about to be made
        noteCovered(set_, fans_, vertices);
}

void Coverage::examine(const std::vector<std::uint32_t>& elements, const Progress& progress) {
    if (progress) progress(kPhase, 0);
    std::vector<std::uint32_t> present, near;
    for (const std::uint32_t e : elements) {
        set_.covered[e] = 0;
        results_.erase(e);
        if (set_.objects[set_.elementObject[e].value].present) present.push_back(e);
    }
    const std::vector<std::uint8_t> open =
        findOpen(rays_, set_.rayMeshes, resolver_, shared_, fans_, present);
    for (std::size_t i = 0; i < present.size(); ++i)
        if (open[i] == 0) near.push_back(present[i]);
    if (progress) progress(kPhase, 0.5);
    std::vector<Result> fresh(near.size());
    parallelFor(near.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) fresh[i] = resolver_.examine(shared_[near[i]]);
    });
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (fresh[i] == kFree) continue;
        set_.covered[near[i]] = !fresh[i].free;
        results_[near[i]] = fresh[i];
    }
}

/// Whether the elements around a vertex can't share it: something stands on one of them, or a wall
/// between them.
bool Coverage::parted(std::uint32_t vertex) const {
    bool anchored = false;
    glm::vec3 anchor(0);
    for (std::uint32_t corner : fans_.at(vertex)) {
        const Element& element = shared_[corner / 4];
        if (element.patch == Element::kNone) continue;
        if (!set_.objects[set_.elementObject[corner / 4].value].present) return false;
        const auto found = results_.find(corner / 4);
        if (found != results_.end() && (!found->second.free || found->second.moved[corner % 4]))
            return true;
        const glm::vec3 place = resolver_.cornerOf(element, corner % 4);
        if (anchored && rays_.occluded(anchor, place)) return true;
        if (!anchored) anchor = place;
        anchored = true;
    }
    return false;
}

void Coverage::settleCorner(std::uint32_t element, std::uint32_t corner, bool parted,
                            Change& change) {
    const std::uint32_t shared = shared_[element].vertices[corner];
    const Vertex& from = set_.vertices[shared];
    Vertex wanted = from;
    const auto found = results_.find(element);
    const bool covered = found != results_.end() && !found->second.free;
    if (!covered && found != results_.end() && found->second.moved[corner])
        wanted.receiver.position = found->second.position[corner];
    else if (!covered && parted)
        wanted.receiver.position = resolver_.cornerOf(shared_[element], corner);

    Element& drawn = set_.elements[element];
    const std::uint32_t before = drawn.vertices[corner];
    const std::uint32_t key = 4 * element + corner;
    std::uint32_t now = shared;
    if (wanted.receiver.position != from.receiver.position) {
        const auto own = own_.find(key);
        now = own != own_.end() ? own->second : takeVertex(set_.elementObject[element]);
        if (own == own_.end()) ++set_.displaced[shared];
        own_[key] = now;
        Vertex& vertex = set_.vertices[now];
        if (vertex.receiver.position != wanted.receiver.position ||
            vertex.receiver.normal != wanted.receiver.normal)
            change.vertices.push_back(now);
        vertex = wanted;
        set_.vertexCoordinates[now] = set_.vertexCoordinates[shared]; // until Parting says better
        set_.privateElement[now - set_.firstPrivate] = element;
    } else if (before != shared) {
        unused_[set_.elementObject[element].value].push_back(before);
        own_.erase(key);
        --set_.displaced[shared];
        set_.vertices[before].receiver.normal = glm::vec3(0);
        set_.vertexCoordinates[before] = {};
        change.vertices.push_back(before);
    }
    drawn.vertices[corner] = now;
    if (corner == 2 && shared_[element].isTriangle()) drawn.vertices[3] = now;
    change.patches.push_back(shared_[element].patch);
}

/// A free vertex in a block of the object's own.
std::uint32_t Coverage::takeVertex(ObjectId object) {
    std::vector<std::uint32_t>& unused = unused_[object.value];
    if (unused.empty()) {
        const auto first = std::uint32_t(set_.vertices.size());
        set_.vertices.resize(first + PatchSet::kBlock);
        set_.vertexCoordinates.resize(first + PatchSet::kBlock);
        set_.privateElement.resize(first + PatchSet::kBlock - set_.firstPrivate);
        set_.vertexBlockObject.push_back(object);
        for (std::uint32_t i = PatchSet::kBlock; i-- > 0;) unused.push_back(first + i);
    }
    const std::uint32_t vertex = unused.back();
    unused.pop_back();
    return vertex;
}

} // namespace penumbra
