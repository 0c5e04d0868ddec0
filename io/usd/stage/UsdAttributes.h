// Attributes of one prim at one time, as plain C++ values.
#pragma once

#include "base/Rgb.h"
#include "io/usd/stage/UsdStage.h"

#include <glm/glm.hpp>

namespace penumbra {

/// Reads attributes of one prim at one time. An attribute that is absent, blocked, or of a type
/// that can't be meant (text for a number, two components for a point) gives the fallback.
class UsdAttributes {
public:
    UsdAttributes(const UsdPrim& prim, UsdTime time) : prim_(prim), time_(time) {}
    const UsdPrim& prim() const { return prim_; }
    UsdTime time() const { return time_; }
    UsdResolved value(std::string_view name) const { return UsdStage::value(prim_, name, time_); }
    SourceLocation location(std::string_view name) const { return UsdStage::location(prim_, name); }

    double number(std::string_view name, double fallback) const;
    bool flag(std::string_view name, bool fallback) const;
    /// A token, string or asset path.
    std::string text(std::string_view name, std::string_view fallback) const;
    /// How many values a primvar has, and for what (USD's `interpolation`).
    std::string interpolation(std::string_view name, std::string_view fallback) const;
    Rgb colour(std::string_view name, Rgb fallback) const;
    /// The components of a number, tuple or matrix; empty unless there are exactly `count`.
    std::vector<double> tuple(std::string_view name, std::size_t count) const;
    std::vector<double> numbers(std::string_view name) const;
    /// Whole numbers of any width; those that 32 bits can't hold are -1, which is no index.
    std::vector<std::int32_t> integers(std::string_view name) const;
    /// Whole numbers of any width; those that 63 bits can't hold are -1.
    std::vector<std::int64_t> wideIntegers(std::string_view name) const;
    std::vector<std::string> texts(std::string_view name) const;
    std::vector<glm::vec3> points(std::string_view name) const;

private:
    const UsdPrim& prim_;
    UsdTime time_;
};

/// Elements of three numbers; empty for any other value.
std::vector<glm::vec3> toVectors(const UsdValue& value);

} // namespace penumbra
