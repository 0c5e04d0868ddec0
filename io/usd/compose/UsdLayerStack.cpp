#include "io/usd/compose/UsdLayerStack.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

double positiveNumber(const UsdLayer& layer, std::string_view key) {
    const UsdValue* value = find(layer.metadata, key);
    const auto numbers = value ? value->numbers() : std::vector<double>{};
    return numbers.size() == 1 && std::isfinite(numbers[0]) && numbers[0] > 0 ? numbers[0] : 0;
}

} // namespace

bool UsdLayerStack::hasSpec(UsdSitePath path) const {
    if (path.isRoot()) return true;
    return std::any_of(layers.begin(), layers.end(),
                       [path](const UsdStackedLayer& l) { return l.index->spec(path); });
}

double timeCodesPerSecond(const UsdLayer& layer) {
    if (const double authored = positiveNumber(layer, "timeCodesPerSecond")) return authored;
    if (const double frames = positiveNumber(layer, "framesPerSecond")) return frames;
    return 24;
}

bool isValid(const UsdLayerOffset& offset) {
    return std::isfinite(offset.offset) && std::isfinite(offset.scale) && offset.scale != 0;
}

} // namespace penumbra
