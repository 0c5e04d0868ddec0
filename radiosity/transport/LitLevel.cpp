#include "radiosity/transport/LitLevel.h"

#include <algorithm>
#include <numeric>

namespace penumbra {

void LitLevel::add(double illuminance, double area) {
    if (illuminance > 0 && area > 0) lit_.emplace_back(illuminance, area);
}

double LitLevel::median() const {
    const auto areaOf = [](auto first, auto end) {
        return std::accumulate(first, end, 0.0,
                               [](double sum, const auto& lit) { return sum + lit.second; });
    };
    std::vector<std::pair<double, double>> some = lit_;
    auto first = some.begin(), end = some.end();
    double below = -0.5 * areaOf(first, end); // reaches 0 at the median
    while (end - first > 1) {                 // the median is one of these
        const auto middle = first + (end - first) / 2;
        std::nth_element(first, middle, end);
        const double area = areaOf(first, middle);
        if (below + area >= 0) {
            end = middle;
        } else {
            below += area;
            first = middle;
        }
    }
    return first != end ? first->first : 0;
}

} // namespace penumbra
