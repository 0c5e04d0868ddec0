// Making prims of a layer.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <glm/glm.hpp>

#include <cassert>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

UsdPrimSpec makePrim(std::string_view type, std::string_view name);

/// The prim at an absolute path: an over, as are those above it, unless it is there already. What
/// was returned before may have moved.
UsdPrimSpec& overAt(UsdLayer& layer, std::string_view path);

/// Adds an attribute without a value. \param type as in USD text, e.g. `point3f[]`
UsdProperty& declareAttribute(UsdPrimSpec& spec, std::string_view type, std::string_view name);

/// Adds an attribute. \param components of all its elements, of the C++ type that UsdValue stores
template <class T>
UsdProperty& addAttribute(UsdPrimSpec& spec, std::string_view type, std::string_view name,
                          std::vector<T> components) {
    UsdProperty& property = declareAttribute(spec, type, name);
    assert(property.type.array || components.size() == property.type.components());
    property.value = {property.type, std::move(components)};
    return property;
}
inline UsdProperty& addFloat(UsdPrimSpec& spec, std::string_view name, double value) {
    return addAttribute(spec, "float", name, std::vector{float(value)});
}
inline UsdProperty& addBool(UsdPrimSpec& spec, std::string_view name, bool value) {
    return addAttribute(spec, "bool", name, std::vector<std::uint8_t>{value});
}
/// Of type token, string or asset.
UsdProperty& addText(UsdPrimSpec& spec, std::string_view type, std::string_view name,
                     std::string value);
UsdProperty& addColour(UsdPrimSpec& spec, std::string_view name, glm::dvec3 rgb);

/// Adds an attribute that takes its value from another one. \param source absolute path
void addConnection(UsdPrimSpec& spec, std::string_view type, std::string_view name,
                   std::string source);
void addRelationship(UsdPrimSpec& spec, std::string_view name, std::string target);
void addMetadata(UsdDictionary& metadata, std::string_view name, UsdKind kind, std::string text);
void addMetadata(UsdDictionary& metadata, std::string_view name, double number);
void addMetadata(UsdDictionary& metadata, std::string_view name, bool flag);
void applySchema(UsdPrimSpec& spec, std::string_view schema);

/// Gives the prim a transform of its own, unless it is the identity. \param matrix column vectors
void addTransform(UsdPrimSpec& spec, const glm::dmat4& matrix);

} // namespace penumbra
