#include "io/usd/scene/UsdObjects.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace penumbra {

namespace {

bool isModelKind(const UsdPrim& prim) {
    for (const UsdOpinion& opinion : prim.opinions) {
        const UsdValue* const kind = find(opinion.spec->metadata, "kind");
        if (kind && kind->text()) return *kind->text() == "component" || *kind->text() == "model";
    }
    return false;
}

/// Whether one can go from any box to any other over boxes that touch.
bool allTouch(std::span<const Bounds> boxes, float distance) {
    std::vector<std::size_t> open{0}, left(boxes.size() - 1);
    std::iota(left.begin(), left.end(), std::size_t(1));
    while (!open.empty() && !left.empty()) {
        Bounds around = boxes[open.back()];
        open.pop_back();
        around.lower -= distance;
        around.upper += distance;
        const auto far = std::partition(left.begin(), left.end(),
                                        [&](std::size_t i) { return !around.overlaps(boxes[i]); });
        open.insert(open.end(), far, left.end());
        left.erase(far, left.end());
    }
    return left.empty();
}

} // namespace

UsdObjects::UsdObjects(const UsdStage& stage, bool (*isShape)(std::string_view type))
    : stage_(stage), entries_(stage.prims().size()) {
    for (std::size_t p = 1; p < entries_.size(); ++p) {
        const UsdPrim& prim = stage.prims()[p];
        entries_[p].shape = prim.defined && !prim.abstract && isShape(prim.typeName);
        entries_[prim.parent].shapesHeld += entries_[p].shape;
    }
    findModels(stage);
}

void UsdObjects::findModels(const UsdStage& stage) {
    std::vector<std::uint8_t> below(entries_.size(), 0); // has a model below it
    for (std::size_t p = entries_.size(); p-- > 1;) {
        const UsdPrim& prim = stage.prims()[p];
        const bool model = isModelKind(prim);
        entries_[p].model = model && !below[p];
        if (model || below[p]) below[prim.parent] = 1;
    }
}

bool UsdObjects::needsTransform(const UsdPrim& prim) const {
    return stage_.prims()[prim.parent].typeName != "Xform" ||
           entries_[prim.parent].shapesHeld > kMostShapes;
}

void UsdObjects::addTransform(std::size_t prim, const std::shared_ptr<Transform>& transform) {
    entries_[prim].transform = transform;
}

void UsdObjects::addInstance(std::size_t instancer, const std::shared_ptr<Transform>& transform) {
    instances_.push_back({instancer, transform});
}

void UsdObjects::addShape(std::size_t prim, const Bounds& box) {
    for (std::size_t p = prim;; p = stage_.prims()[p].parent) {
        Entry& entry = entries_[p];
        if (entry.partCount++ == 0) entry.firstPart = std::uint32_t(parts_.size());
        if (p == 0) break;
    }
    parts_.push_back(box);
}

bool UsdObjects::isThing(const Entry& entry) const {
    if (entry.partCount == 0 || entry.partCount > kMostParts) return false;
    const std::span<const Bounds> parts(parts_.data() + entry.firstPart, entry.partCount);
    Bounds all;
    for (const Bounds& part : parts) all.add(part);
    const glm::vec3 size = all.size();
    return std::max({size.x, size.y, size.z}) <= kMostSize && allTouch(parts, kTouching);
}

bool UsdObjects::isObject(const Entry& entry) const {
    if (entry.transform->movable() || entry.shape) return true;
    if (entry.partCount == parts_.size() && instances_.empty()) return false; // all of the scene
    return entry.model || (entry.shapesHeld > 0 && isThing(entry));
}

void UsdObjects::mark() const {
    std::vector<std::uint8_t> inside(entries_.size(), 0); // an object
    for (std::size_t p = 1; p < entries_.size(); ++p) {
        const Entry& entry = entries_[p];
        inside[p] = inside[stage_.prims()[p].parent];
        if (inside[p] || !entry.transform) continue;
        inside[p] = isObject(entry);
        const bool holds = entry.shapesHeld > 0 && entry.partCount > 0; // not prototypes alone
        if (inside[p] || holds) entry.transform->setBeginsObject(true);
    }
    for (const Instance& instance : instances_)
        if (!inside[instance.instancer]) instance.transform->setBeginsObject(true);
}

} // namespace penumbra
