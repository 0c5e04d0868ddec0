// Runs of indices that are drawn together.
#pragma once

#include <cstddef>
#include <vector>

namespace penumbra {

/// Runs of the indices of a vertex array; what follows without a gap is joined.
class IndexRuns {
public:
    void add(std::size_t first, std::size_t count);
    bool empty() const { return counts_.empty(); }
    std::size_t size() const { return counts_.size(); }
    /// Draws them as triangles of the vertex array that is bound.
    void draw() const;

private:
    std::vector<int> counts_;
    std::vector<const void*> offsets_;
    std::size_t end_ = 0;
};

} // namespace penumbra
