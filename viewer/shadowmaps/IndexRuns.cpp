#include "viewer/shadowmaps/IndexRuns.h"

#include <epoxy/gl.h>

#include <cstdint>

namespace penumbra {

void IndexRuns::add(std::size_t first, std::size_t count) {
    if (!empty() && first == end_) {
        counts_.back() += int(count);
    } else {
        counts_.push_back(int(count));
        offsets_.push_back(reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
    }
    end_ = first + count;
}

void IndexRuns::draw() const {
    if (empty()) return;
    glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                        GLsizei(counts_.size()));
}

} // namespace penumbra
