// The order of all nodes: the tree's, with specializes taken out and put at the end.
#include "io/usd/compose/UsdPrimIndex.h"

#include <algorithm>

namespace penumbra {

namespace {

// A node that specializes, and what its place among all others depends on.
struct Specialize {
    std::uint32_t node = 0;
    std::uint32_t origin = 0;    // where its origins lead
    std::size_t originPlace = 0; // in the tree
    std::size_t below = 0;       // of that origin
    std::size_t depth = 0;       // of what specializes
    std::size_t steps = 0;       // implied, from the origin
    std::size_t causePlace = 0;  // of its own origin in the tree
};

class SpecializesLast {
public:
    explicit SpecializesLast(const UsdPrimIndex& index) : index_(index) {}

    std::vector<std::uint32_t> order() {
        std::vector<std::uint32_t> tree = index_.subtree(0);
        std::vector<std::uint32_t> found;
        for (const std::uint32_t node : tree)
            if (index_[node].arc == UsdArc::specialize) found.push_back(node);
        if (found.empty()) return tree;
        place_.resize(index_.nodes.size());
        for (std::size_t i = 0; i < tree.size(); ++i) place_[tree[i]] = i;
        std::vector<Specialize> specializes;
        for (const std::uint32_t node : found) specializes.push_back(described(node));
        std::stable_sort(
            specializes.begin(), specializes.end(),
            [this](const Specialize& a, const Specialize& b) { return isStronger(a, b); });
        std::vector<std::uint32_t> order;
        append(0, order);
        for (const Specialize& one : specializes) append(one.node, order);
        return order;
    }

private:
    Specialize described(std::uint32_t node) const {
        Specialize one;
        one.node = node;
        one.origin = index_.originRoot(node);
        one.originPlace = place_[one.origin];
        one.below = index_.below(one.origin);
        std::uint32_t parent = index_[node].parent;
        while (index_[parent].arc == UsdArc::relocate) parent = index_[parent].parent;
        one.depth = index_[parent].depth;
        for (std::uint32_t n = node; n != one.origin; n = index_[n].origin) ++one.steps;
        if (index_[node].parent != 0) ++one.steps;
        one.causePlace = place_[index_[node].origin];
        return one;
    }

    bool isStronger(const Specialize& a, const Specialize& b) const {
        if (a.origin != b.origin) {
            const bool related =
                index_.hangsAt(a.origin, b.origin) || index_.hangsAt(b.origin, a.origin);
            if (!related && a.below != b.below) return a.below < b.below;
            return a.originPlace < b.originPlace;
        }
        if (a.depth != b.depth) return a.depth < b.depth;
        if (a.steps != b.steps) return a.steps > b.steps;
        return a.causePlace < b.causePlace;
    }

    // The nodes at or below `top` without other specializes.
    void append(std::uint32_t top, std::vector<std::uint32_t>& order) const {
        std::vector<std::uint32_t> open{top};
        while (!open.empty()) {
            const std::uint32_t node = open.back();
            open.pop_back();
            order.push_back(node);
            const auto& children = index_[node].children;
            for (std::size_t i = children.size(); i-- > 0;)
                if (index_[children[i]].arc != UsdArc::specialize) open.push_back(children[i]);
        }
    }

    const UsdPrimIndex& index_;
    std::vector<std::size_t> place_;
};

} // namespace

std::vector<std::uint32_t> UsdPrimIndex::strengthOrder() const {
    if (nodes.size() == 1) return {0};
    return SpecializesLast(*this).order();
}

} // namespace penumbra
