// A hierarchy of boxes that move.
#pragma once

#include "base/Bounds.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace penumbra {

/// A binary tree over boxes 0 ... count - 1 in their given order: neighbours in that order should
/// lie near each other. Moving a box costs the logarithm of the count.
class BoundsTree {
public:
    BoundsTree() = default;
    explicit BoundsTree(std::vector<Bounds> boxes) { assign(std::move(boxes)); }

    void assign(std::vector<Bounds> boxes) {
        count_ = boxes.size();
        leaves_ = 1;
        while (leaves_ < count_) leaves_ *= 2;
        nodes_.assign(2 * leaves_, Bounds());
        for (std::size_t i = 0; i < count_; ++i) nodes_[leaves_ + i] = boxes[i];
        for (std::size_t n = leaves_; n-- > 1;) refit(n);
    }
    void set(std::size_t index, const Bounds& box) {
        std::size_t n = leaves_ + index;
        nodes_[n] = box;
        while (n > 1) refit(n /= 2);
    }
    /// Adds boxes at the end.
    void append(const Bounds& box) {
        if (count_ < leaves_) return set(count_++, box);
        std::vector<Bounds> boxes(nodes_.begin() + std::ptrdiff_t(leaves_), nodes_.end());
        boxes.resize(count_);
        boxes.push_back(box);
        assign(std::move(boxes));
    }

    std::size_t size() const { return count_; }
    const Bounds& operator[](std::size_t index) const { return nodes_[leaves_ + index]; }

    /// Box of a node: of a single box, or around those below it.
    const Bounds& node(std::size_t n) const { return nodes_[n]; }
    /// Calls visit(index), in order, for every box whose node `meets(node)` accepts. `meets` must
    /// accept every node above one that it accepts.
    template <class Meets, class Visit>
    void query(const Meets& meets, const Visit& visit) const {
        query(0, count_, meets, visit);
    }
    /// The same of boxes first ... end - 1.
    template <class Meets, class Visit>
    void query(std::size_t first, std::size_t end, const Meets& meets, const Visit& visit) const {
        if (first < std::min(end, count_)) descend(1, 0, leaves_, first, end, meets, visit);
    }

private:
    void refit(std::size_t n) {
        nodes_[n] = nodes_[2 * n];
        nodes_[n].add(nodes_[2 * n + 1]);
    }
    /// \param leaf, leaves the first below n, and how many there are
    template <class Meets, class Visit>
    void descend(std::size_t n, std::size_t leaf, std::size_t leaves, std::size_t first,
                 std::size_t end, const Meets& meets, const Visit& visit) const {
        if (leaf >= end || leaf + leaves <= first) return;
        if (nodes_[n].empty() || !meets(n)) return;
        if (leaves == 1) return visit(leaf);
        descend(2 * n, leaf, leaves / 2, first, end, meets, visit);
        descend(2 * n + 1, leaf + leaves / 2, leaves / 2, first, end, meets, visit);
    }

    std::size_t count_ = 0, leaves_ = 1;
    std::vector<Bounds> nodes_{Bounds(), Bounds()}; ///< a heap: children of n are 2n and 2n + 1
};

} // namespace penumbra
