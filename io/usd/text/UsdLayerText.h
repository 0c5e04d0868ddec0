// Writing a layer of opinions about the prims of other layers.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace penumbra {

/// The text of a value as USD has it, in the fewest digits that read back as the same number.
std::string usdText(double value);
std::string usdText(float value);
std::string usdText(glm::dvec3 value);
std::string usdText(glm::vec2 value);
std::string usdText(glm::vec3 value);
std::string usdText(glm::dvec4 value);        ///< four components, e.g. of a quaternion: w first
std::string usdText(const glm::dmat4& value); ///< of column vectors: USD's rows are our columns
std::string usdQuoted(std::string_view text); ///< a string, with what must be escaped

/// A layer in the making: metadata, then nested prims with their lines.
class UsdLayerText {
public:
    /// One line of the layer's metadata, e.g. `upAxis = "Z"`.
    void metadata(std::string line) { metadata_.push_back(std::move(line)); }

    /// One line about the prim at a path, e.g. `double radius = 2`. The prim is an `over` unless it
    /// was defined.
    void add(const std::string& prim, std::string line);
    /// `def Type`, with the prims above it as they are, or else overs.
    void define(const std::string& prim, std::string type);

    std::string text() const;

private:
    struct Prim {
        std::string name;
        std::string specifier = "over";
        std::vector<std::string> lines;
        std::vector<Prim> children; ///< in the order of their first mention
    };
    Prim& at(const std::string& path);
    static void write(std::string& out, const Prim& prim, std::size_t depth);

    std::vector<std::string> metadata_;
    Prim root_;
};

/// `type name = value` of a value that never changes, or `type name.timeSamples = { ... }`.
/// \param samples time codes and values as text, in the order of time, at least one
std::string usdAttribute(std::string_view type, std::string_view name,
                         const std::vector<std::pair<double, std::string>>& samples);

} // namespace penumbra
