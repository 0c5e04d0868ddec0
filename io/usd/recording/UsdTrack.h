// Values over time, as a recorded session has them.
#pragma once

#include "base/Rgb.h"
#include "io/usd/layer/UsdLayer.h"

#include <glm/glm.hpp>

#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace penumbra {

/// The components of a vector or colour.
template <class Vector>
auto listOf(const Vector& v) {
    return std::vector{v.x, v.y, v.z};
}
inline std::vector<float> listOf(Rgb c) {
    return {c.r, c.g, c.b};
}

/// The values of one attribute over time.
class UsdTrack {
public:
    /// \param type as in USD text, e.g. `double3`
    explicit UsdTrack(const char* type) : type_(type) {}

    /// A value from `code` on; before it the last one held until the code before.
    /// \param components of the C++ type that UsdValue stores
    template <class T>
    void put(double code, std::vector<T> components) {
        if constexpr (std::is_arithmetic_v<T>)
            for (T& component : components) component += T(0); // no -0
        put(code, UsdValue{usdTypeNamed(type_), std::move(components)});
    }
    bool empty() const { return samples_.empty(); }
    /// Whether it became another value, be it at its first time code.
    bool changes() const { return changed_; }
    std::vector<double> first() const { return samples_.front().value.numbers(); }

    /// As an attribute of a prim: time samples, or one value that never changes.
    void write(UsdPrimSpec& prim, std::string_view name) const;

private:
    void put(double code, UsdValue value);

    const char* type_;
    std::vector<UsdTimeSample> samples_;
    bool changed_ = false;
};

/// The transform of one prim over time, both ways it may be written.
struct UsdPoseTrack {
    UsdTrack translate{"double3"}, orient{"quatd"}, scale{"double3"}, matrix{"matrix4d"};
    bool rigid = true; ///< translate, orient and scale say it all

    void put(double code, const glm::dmat4& value);
    bool changes() const { return matrix.changes(); }
    /// \param absolute whether it is in the scene's frame, whatever is above the prim
    void write(UsdPrimSpec& prim, bool absolute) const;
};

/// A luminance as UsdLux has it: a colour whose largest channel is 1, times an intensity.
struct UsdLightTrack {
    UsdTrack colour{"color3f"}, intensity{"float"};

    void put(double code, Rgb nits);
    bool changes() const { return colour.changes() || intensity.changes(); }
    void write(UsdPrimSpec& light) const;
};

} // namespace penumbra
