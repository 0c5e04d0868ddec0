// Value resolution at a time: the strongest layer that has samples or a default decides.
#include "io/usd/stage/UsdInterpolation.h"

#include "io/usd/stage/UsdStage.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

template <class T>
std::vector<T> lerp(const std::vector<T>& a, const std::vector<T>& b, double t) {
    std::vector<T> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) result[i] = T((1 - t) * a[i] + t * b[i]);
    return result;
}

// Shortest arc between unit quaternions (Shoemake, SIGGRAPH 1985), four components each.
template <class T>
std::vector<T> slerp(const std::vector<T>& a, const std::vector<T>& b, double t) {
    std::vector<T> result(a.size());
    for (std::size_t q = 0; q + 3 < a.size(); q += 4) {
        double cosine = 0;
        for (std::size_t i = q; i < q + 4; ++i) cosine += double(a[i]) * b[i];
        const double sign = cosine < 0 ? -1 : 1;
        const double angle = std::acos(std::min(1.0, std::abs(cosine)));
        constexpr double kTooClose = 1e-6; // [rad] the sines would cancel
        const bool close = angle < kTooClose;
        const double wa = close ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle);
        const double wb = sign * (close ? t : std::sin(t * angle) / std::sin(angle));
        for (std::size_t i = q; i < q + 4; ++i) result[i] = T(wa * a[i] + wb * b[i]);
    }
    return result;
}

// Empty if the values can only be held.
UsdValue between(const UsdValue& a, const UsdValue& b, double t) {
    const auto blend = [&](const auto& va) -> UsdValue {
        using Vector = std::decay_t<decltype(va)>;
        if constexpr (std::is_same_v<Vector, std::vector<float>> ||
                      std::is_same_v<Vector, std::vector<double>>) {
            const Vector* vb = std::get_if<Vector>(&b.data);
            if (!vb || vb->size() != va.size() || a.type != b.type) return {};
            if (va == *vb) return a; // what stands still does so to the last bit
            return {a.type, a.type.quaternion ? slerp(va, *vb, t) : lerp(va, *vb, t)};
        }
        return {};
    };
    return std::visit(blend, a.data);
}

} // namespace

UsdSampled sampleUsd(std::span<const UsdTimeSample> samples, double time) {
    const auto after =
        std::upper_bound(samples.begin(), samples.end(), time,
                         [](double t, const UsdTimeSample& sample) { return t < sample.time; });
    if (after == samples.begin()) return {&samples.front().value, {}};
    const UsdTimeSample& low = *(after - 1);
    if (after == samples.end() || low.time == time) return {&low.value, {}};
    return {&low.value,
            between(low.value, after->value, (time - low.time) / (after->time - low.time))};
}

UsdResolved UsdStage::value(const UsdPrim& prim, std::string_view attribute, UsdTime time) {
    const UsdProperty* earliest = nullptr;
    UsdResolved result;
    bool found = false;
    eachUsdDeclaration(
        prim, attribute, [&](const UsdProperty& property, const UsdOpinion& opinion) {
            if (!property.samples.empty() && !earliest) earliest = &property;
            if (time && !property.samples.empty()) {
                const double local = (*time - opinion.offset.offset) / opinion.offset.scale;
                UsdSampled sampled = sampleUsd(property.samples, local);
                if (!sampled.held->blocked())
                    result = sampled.made.empty() ? UsdResolved(sampled.held)
                                                  : UsdResolved(std::move(sampled.made));
                return found = true;
            }
            if (property.value.empty()) return false; // a block is not empty
            if (!property.value.blocked()) result = UsdResolved(&property.value);
            return found = true;
        });
    if (found || !earliest || earliest->samples.front().value.blocked()) return result;
    return UsdResolved(&earliest->samples.front().value);
}

UsdSamples UsdStage::samples(const UsdPrim& prim, std::string_view attribute) {
    UsdSamples result;
    eachUsdDeclaration(prim, attribute,
                       [&](const UsdProperty& property, const UsdOpinion& opinion) {
                           if (property.samples.empty()) return !property.value.empty();
                           result = {&property, opinion.offset};
                           return true;
                       });
    return result;
}

bool UsdStage::animated(const UsdPrim& prim, std::string_view attribute) {
    bool changes = false;
    eachUsdDeclaration(prim, attribute, [&](const UsdProperty& property, const UsdOpinion&) {
        for (const UsdTimeSample& sample : property.samples)
            changes = changes || !(sample.value == property.samples.front().value);
        return changes;
    });
    return changes;
}

} // namespace penumbra
