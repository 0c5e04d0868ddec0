#include "io/usd/stage/UsdAttributes.h"

#include "io/usd/layer/UsdNumber.h"

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

namespace penumbra {

namespace {

// Stored whole numbers as Integers; -1 for those that they can't hold.
template <class Integer>
std::vector<Integer> wholeNumbers(const UsdResolved& resolved) {
    std::vector<Integer> numbers;
    if (!resolved) return numbers;
    const auto convert = [&](const auto& stored) {
        if constexpr (requires { requires std::integral<std::decay_t<decltype(stored[0])>>; })
            for (const auto n : stored)
                numbers.push_back(std::in_range<Integer>(n) ? Integer(n) : Integer(-1));
    };
    std::visit(convert, resolved->data);
    return numbers;
}

} // namespace

double UsdAttributes::number(std::string_view name, double fallback) const {
    const auto values = tuple(name, 1);
    return values.empty() ? fallback : values[0];
}

bool UsdAttributes::flag(std::string_view name, bool fallback) const {
    const auto values = tuple(name, 1);
    return values.empty() ? fallback : values[0] != 0;
}

std::string UsdAttributes::text(std::string_view name, std::string_view fallback) const {
    const UsdResolved resolved = value(name);
    const std::string* text = resolved ? resolved->text() : nullptr;
    return text ? *text : std::string(fallback);
}

Rgb UsdAttributes::colour(std::string_view name, Rgb fallback) const {
    const auto c = tuple(name, 3);
    return c.empty() ? fallback : Rgb(roundToFloat(c[0]), roundToFloat(c[1]), roundToFloat(c[2]));
}

std::vector<double> UsdAttributes::tuple(std::string_view name, std::size_t count) const {
    const UsdResolved resolved = value(name);
    if (!resolved || resolved->type.array) return {};
    auto values = resolved->numbers();
    return values.size() == count ? values : std::vector<double>{};
}

std::vector<double> UsdAttributes::numbers(std::string_view name) const {
    const UsdResolved resolved = value(name);
    return resolved ? resolved->numbers() : std::vector<double>{};
}

std::vector<std::int32_t> UsdAttributes::integers(std::string_view name) const {
    return wholeNumbers<std::int32_t>(value(name));
}

std::vector<std::int64_t> UsdAttributes::wideIntegers(std::string_view name) const {
    return wholeNumbers<std::int64_t>(value(name));
}

std::vector<std::string> UsdAttributes::texts(std::string_view name) const {
    const UsdResolved resolved = value(name);
    const auto* stored = resolved ? resolved->as<std::string>() : nullptr;
    return stored ? *stored : std::vector<std::string>{};
}

std::string UsdAttributes::interpolation(std::string_view name, std::string_view fallback) const {
    const UsdValue* const value = UsdStage::metadata(prim_, name, "interpolation");
    const std::string* const word = value ? value->text() : nullptr;
    return word ? *word : std::string(fallback);
}

std::vector<glm::vec3> UsdAttributes::points(std::string_view name) const {
    const UsdResolved resolved = value(name);
    return resolved ? toVectors(*resolved) : std::vector<glm::vec3>{};
}

std::vector<glm::vec3> toVectors(const UsdValue& value) {
    std::vector<glm::vec3> vectors;
    if (value.type.components() != 3) return vectors;
    const auto convert = [&](const auto& stored) {
        if constexpr (requires { static_cast<double>(stored[0]); }) {
            vectors.reserve(stored.size() / 3);
            for (std::size_t i = 0; i + 2 < stored.size(); i += 3)
                vectors.emplace_back(roundToFloat(double(stored[i])),
                                     roundToFloat(double(stored[i + 1])),
                                     roundToFloat(double(stored[i + 2])));
        }
    };
    std::visit(convert, value.data);
    return vectors;
}

} // namespace penumbra
