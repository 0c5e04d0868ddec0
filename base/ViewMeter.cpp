#include "base/ViewMeter.h"

#include <algorithm>

namespace penumbra {

namespace {

std::vector<float> means(std::span<const MeterCell> cells, float MeterCell::*sum,
                         float MeterCell::*count) {
    std::vector<float> values;
    for (const MeterCell& cell : cells)
        if (cell.*count > 0) values.push_back(cell.*sum / cell.*count);
    return values;
}

} // namespace

std::vector<float> meteredLuminances(std::span<const MeterCell> cells) {
    const bool lit =
        std::ranges::any_of(cells, [](const MeterCell& cell) { return cell.reflected > 0; });
    return lit ? means(cells, &MeterCell::reflected, &MeterCell::reflecting)
               : means(cells, &MeterCell::emitted, &MeterCell::emitting);
}

} // namespace penumbra
