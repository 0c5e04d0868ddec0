// Disjoint sets that are joined one by one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace penumbra {

/// Sets of the numbers 0 ... count - 1, at first one each, named by their least member.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }
    std::uint32_t find(std::uint32_t x) {
        while (parents_[x] != x) x = parents_[x] = parents_[parents_[x]];
        return x;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parents_;
};

} // namespace penumbra
