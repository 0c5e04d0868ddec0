#include "radiosity/clusters/NearPairs.h"

#include "base/Axis.h"
#include "base/BoundsTree.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace penumbra {

namespace {

using Index = std::uint32_t;

float square(glm::vec3 v) {
    return glm::dot(v, v);
}

float squareGap(const Bounds& a, const Bounds& b) {
    return square(glm::max(glm::max(a.lower - b.upper, b.lower - a.upper), glm::vec3(0)));
}

/// Sorts by halving at the middle of the longest side: near boxes lie near each other in the order.
void sortByPlace(std::span<Index> order, std::span<const Bounds> boxes) {
    if (order.size() <= 1) return;
    Bounds centres;
    for (Index i : order) centres.add(boxes[i].centre());
    const int axis = longestAxis(centres.size());
    const std::size_t half = order.size() / 2;
    std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(half), order.end(),
                     [&](Index a, Index b) {
                         const float x = boxes[a].centre()[axis], y = boxes[b].centre()[axis];
                         return x != y ? x < y : a < b;
                     });
    sortByPlace(order.first(half), boxes);
    sortByPlace(order.subspan(half), boxes);
}

/// The nearest boxes of one.
class Search {
public:
    Search(std::span<const Bounds> boxes, Index self, float gap, std::size_t count)
        : boxes_(boxes), self_(self), centre_(boxes[self].centre()), gap2_(gap * gap),
          count_(count) {}

    bool meets(const Bounds& node) const {
        const float gap2 = squareGap(boxes_[self_], node);
        if (found_.size() < count_) return gap2 <= gap2_;
        return std::tuple(gap2, squareGap({centre_, centre_}, node)) <=
               std::tuple(found_.back().gap2, found_.back().distance2);
    }
    template <class MayPair>
    void visit(Index other, const MayPair& mayPair) {
        const Near near{squareGap(boxes_[self_], boxes_[other]),
                        square(boxes_[other].centre() - centre_), other};
        if (other == self_ || near.gap2 > gap2_) return;
        if (found_.size() == count_ && !(near < found_.back())) return;
        const auto place = std::lower_bound(found_.begin(), found_.end(), near);
        if (place != found_.end() && place->index == other) return; // met before
        if (!mayPair(self_, other)) return;
        found_.insert(place, near);
        if (found_.size() > count_) found_.pop_back();
    }
    template <class Visit>
    void forEach(const Visit& visit) const {
        for (const Near& near : found_) visit(near.index);
    }

private:
    struct Near {
        float gap2, distance2;
        Index index;
        auto operator<=>(const Near&) const = default;
    };

    std::span<const Bounds> boxes_;
    Index self_;
    glm::vec3 centre_;
    float gap2_;
    std::size_t count_;
    std::vector<Near> found_; // nearest first
};

} // namespace

std::vector<std::array<std::uint32_t, 2>>
nearPairs(std::span<const Bounds> boxes, float gap, std::size_t count,
          const std::function<bool(std::uint32_t, std::uint32_t)>& mayPair) {
    if (count == 0) return {};
    std::vector<Index> order(boxes.size());
    std::iota(order.begin(), order.end(), 0u);
    sortByPlace(order, boxes);
    std::vector<Bounds> sorted;
    for (Index i : order) sorted.push_back(boxes[i]);
    const BoundsTree tree(std::move(sorted));

    std::vector<std::array<Index, 2>> pairs;
    for (std::size_t at = 0; at < order.size(); ++at) {
        Search search(boxes, order[at], gap, count);
        // Those next in the order first: once `count` are found, most of the tree is out of reach.
        const std::size_t first = at > count ? at - count : 0;
        const std::size_t last = std::min(at + count + 1, order.size());
        for (std::size_t i = first; i < last; ++i) search.visit(order[i], mayPair);
        tree.query([&](std::size_t node) { return search.meets(tree.node(node)); },
                   [&](std::size_t leaf) { search.visit(order[leaf], mayPair); });
        search.forEach([&](Index other) {
            pairs.push_back({std::min(order[at], other), std::max(order[at], other)});
        });
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

} // namespace penumbra
