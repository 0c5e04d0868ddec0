#include "io/usd/compose/UsdPrimIndex.h"

#include <algorithm>

namespace penumbra {

const char* nameOf(UsdArc arc) {
    constexpr const char* kNames[] = {"root",      "inherit", "variant",   "relocate",
                                      "reference", "payload", "specialize"};
    return kNames[std::size_t(arc)];
}

std::size_t UsdPrimIndex::below(std::uint32_t node) const {
    const UsdNode& n = nodes[node];
    return n.parent == kNoNode ? 0 : nodes[n.parent].path.levels() - n.depth;
}

UsdSitePath UsdPrimIndex::pathAtIntroduction(std::uint32_t node) const {
    UsdSitePath path = nodes[node].path;
    for (std::size_t names = below(node); names > 0; path = path.parent())
        if (!path.isChoice()) --names;
    return path;
}

bool UsdPrimIndex::hangsAt(std::uint32_t node, std::uint32_t above) const {
    while (node != kNoNode && node != above) node = nodes[node].parent;
    return node == above;
}

std::uint32_t UsdPrimIndex::originRoot(std::uint32_t node) const {
    while (nodes[node].origin != kNoNode && nodes[node].origin != nodes[node].parent)
        node = nodes[node].origin;
    return node;
}

bool UsdPrimIndex::isBefore(std::uint32_t a, std::uint32_t b) const {
    if (a == b) return false;
    std::vector<std::uint32_t> up; // b and its ancestors
    for (std::uint32_t n = b; n != kNoNode; n = nodes[n].parent) up.push_back(n);
    std::uint32_t childOfCommon = kNoNode;
    std::uint32_t common = a;
    auto found = std::find(up.begin(), up.end(), common);
    while (found == up.end()) {
        childOfCommon = common;
        common = nodes[common].parent;
        found = std::find(up.begin(), up.end(), common);
    }
    if (childOfCommon == kNoNode) return true; // b is below a
    if (found == up.begin()) return false;     // a is below b
    const std::uint32_t other = *(found - 1);
    for (const std::uint32_t child : nodes[common].children) {
        if (child == childOfCommon) return true;
        if (child == other) return false;
    }
    return false; // neither has its place yet
}

bool UsdPrimIndex::isStronger(std::uint32_t a, std::uint32_t b) const {
    const UsdNode &x = nodes[a], &y = nodes[b];
    if (x.arc != y.arc) return x.arc < y.arc;
    if (x.depth != y.depth) return x.depth > y.depth;
    if (x.origin != y.origin) return isBefore(x.origin, y.origin);
    return x.sibling < y.sibling;
}

void UsdPrimIndex::place(std::uint32_t node) {
    auto& siblings = nodes[nodes[node].parent].children;
    const auto at =
        std::upper_bound(siblings.begin(), siblings.end(), node,
                         [this](std::uint32_t a, std::uint32_t b) { return isStronger(a, b); });
    siblings.insert(at, node);
}

void UsdPrimIndex::placeAgain(std::uint32_t node) {
    std::erase(nodes[nodes[node].parent].children, node);
    place(node);
}

void UsdPrimIndex::silence(std::uint32_t node) {
    UsdNode& n = nodes[node];
    if (n.bar == 0) n.bar = std::uint32_t(n.path.length());
    n.silent = true;
}

void UsdPrimIndex::cut(std::uint32_t node) {
    for (const std::uint32_t one : subtree(node)) {
        UsdNode& n = nodes[one];
        if (n.bar == 0) n.bar = std::uint32_t(n.path.length());
        n.cut = true;
    }
}

std::vector<std::uint32_t> UsdPrimIndex::subtree(std::uint32_t node) const {
    std::vector<std::uint32_t> list, open{node};
    while (!open.empty()) {
        const std::uint32_t one = open.back();
        open.pop_back();
        list.push_back(one);
        const auto& children = nodes[one].children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return list;
}

bool UsdPrimIndex::anySpecs(std::uint32_t node) const {
    const auto list = subtree(node);
    return std::any_of(list.begin(), list.end(),
                       [&](std::uint32_t n) { return nodes[n].hasSpecs; });
}

const UsdMapping& UsdPrimIndex::toRoot(std::uint32_t node) {
    std::vector<std::uint32_t> missing;
    for (std::uint32_t n = node; n != kNoNode && !nodes[n].toRoot; n = nodes[n].parent)
        missing.push_back(n);
    for (std::size_t i = missing.size(); i-- > 0;) {
        UsdNode& n = nodes[missing[i]];
        if (n.parent == kNoNode)
            n.toRoot = std::make_shared<UsdMapping>(UsdMapping::identity(n.path.root()));
        else if (nodes[n.parent].toRoot->isIdentity())
            n.toRoot = n.toParent;
        else if (n.toParent->isIdentity())
            n.toRoot = nodes[n.parent].toRoot;
        else
            n.toRoot = std::make_shared<UsdMapping>(nodes[n.parent].toRoot->after(*n.toParent));
    }
    return *nodes[node].toRoot;
}

} // namespace penumbra
