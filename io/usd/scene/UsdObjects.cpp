#include "io/usd/scene/UsdObjects.h"

#include <algorithm>
#include <numeric>

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
bool allTouch(const std::vector<Bounds>& boxes, float distance) {
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
    order();
    findModels(stage);
}

/// The stage lists prims level by level.
void UsdObjects::order() {
    std::vector<std::uint32_t> open{0};
    for (std::uint32_t number = 0; !open.empty(); ++number) {
        const std::uint32_t prim = open.back();
        open.pop_back();
        entries_[prim].order = number;
        const auto& children = stage_.prims()[prim].children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
}

void UsdObjects::findModels(const UsdStage& stage) {
    for (std::size_t p = entries_.size(); p-- > 1;) {
        const UsdPrim& prim = stage.prims()[p];
        entries_[p].model = isModelKind(prim);
        entries_[prim.parent].holdsModels |= entries_[p].model || entries_[p].holdsModels;
    }
}

bool UsdObjects::needsTransform(const UsdPrim& prim) const {
    return stage_.prims()[prim.parent].typeName != "Xform" ||
           entries_[prim.parent].shapesHeld > kMostShapes;
}

void UsdObjects::addTransform(std::size_t prim, const std::shared_ptr<Transform>& transform,
                              bool apart) {
    entries_[prim].transform = transform;
    entries_[prim].apart = apart;
}

void UsdObjects::addInstance(std::size_t instancer, const std::shared_ptr<Transform>& transform) {
    instances_.push_back({instancer, transform});
}

void UsdObjects::addShape(std::size_t prim, const Bounds& box) {
    parts_.push_back({entries_[prim].order, box, stage_.prims()[prim].typeName.ends_with("Light")});
    for (std::size_t p = prim; p != 0; p = stage_.prims()[p].parent) ++entries_[p].partCount;
}

std::span<const UsdObjects::Part> UsdObjects::partsOf(const Entry& entry) const {
    const auto first = std::ranges::lower_bound(parts_, entry.order, {}, &Part::order);
    return {first, entry.partCount};
}

bool UsdObjects::holdsAll(const Entry& entry) const {
    const auto own = std::ranges::count(partsOf(entry), false, &Part::light);
    return instances_.empty() && own == std::ranges::count(parts_, false, &Part::light);
}

Bounds UsdObjects::boxOf(const Entry& entry) const {
    Bounds box;
    for (const Part& part : partsOf(entry)) box.add(part.box);
    return box;
}

bool UsdObjects::canBeCarried(const Bounds& box) {
    const glm::vec3 size = box.size();
    return std::max({size.x, size.y, size.z}) <= kMostSize;
}

bool UsdObjects::isPlace(const Entry& entry) const {
    if (holdsAll(entry)) return true;
    const Bounds box = boxOf(entry);
    if (canBeCarried(box)) return false;
    if (entry.holdsModels) return true;
    const glm::vec3 size = box.size();
    const std::span<const Part> own = partsOf(entry);
    if (own.size() > kMostParts && std::min({size.x, size.y, size.z}) > kRoom) return true;
    return std::ranges::any_of(parts_, [&](const Part& part) {
        const bool others = part.order < own.front().order || part.order > own.back().order;
        return others && box.contains(part.box.lower) && box.contains(part.box.upper);
    });
}

bool UsdObjects::isThing(const Entry& entry) const {
    if (entry.partCount == 0 || entry.partCount > kMostParts) return false;
    if (!canBeCarried(boxOf(entry))) return false;
    std::vector<Bounds> boxes;
    for (const Part& part : partsOf(entry)) boxes.push_back(part.box);
    return allTouch(boxes, kTouching);
}

bool UsdObjects::isObject(const Entry& entry) const {
    if (entry.apart) return false;
    if (entry.transform->beginsObject() || entry.shape) return true;
    if (entry.partCount == 0) return false;
    if (entry.model && !isPlace(entry)) return true;
    return entry.shapesHeld > 0 && !holdsAll(entry) && isThing(entry);
}

std::unordered_set<const Transform*> UsdObjects::mark() {
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const Part& a, const Part& b) { return a.order < b.order; });
    std::vector<std::uint8_t> inside(entries_.size(), 0); // an object
    std::unordered_set<const Transform*> apart;
    for (std::size_t p = 1; p < entries_.size(); ++p) {
        const Entry& entry = entries_[p];
        inside[p] = inside[stage_.prims()[p].parent];
        if (inside[p] || !entry.transform) continue;
        inside[p] = isObject(entry);
        const bool holds = entry.shapesHeld > 0 && entry.partCount > 0; // not prototypes alone
        if (inside[p] || holds) entry.transform->setBeginsObject(true);
        if (!inside[p] && entry.transform->beginsObject()) apart.insert(entry.transform.get());
    }
    for (const Instance& instance : instances_)
        if (!inside[instance.instancer]) instance.transform->setBeginsObject(true);
    return apart;
}

} // namespace penumbra
