#include "viewer/panels/PanelState.h"

#include <algorithm>

namespace penumbra {

float History::most() const {
    const auto end = values_.begin() + std::ptrdiff_t(count_);
    return count_ == 0 ? 0 : *std::max_element(values_.begin(), end);
}

} // namespace penumbra
