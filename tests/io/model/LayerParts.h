// What a layer says, for tests.
#pragma once

#include "io/model/ModelImport.h"

#include <string>
#include <vector>

namespace penumbra {

/// The prim at an absolute path; null if there is none.
const UsdPrimSpec* primAt(const UsdLayer& layer, const std::string& path);

/// The number, or the text, of an entry; NaN, or "", if there is none.
double numberIn(const UsdDictionary& metadata, const std::string& name);
std::string textIn(const UsdDictionary& metadata, const std::string& name);

/// All components of an attribute's value; empty if there is none.
std::vector<double> numbersOf(const UsdLayer& layer, const std::string& prim,
                              const std::string& attribute);
std::string textOf(const UsdLayer& layer, const std::string& prim, const std::string& attribute);
std::string interpolationOf(const UsdLayer& layer, const std::string& prim,
                            const std::string& attribute);
/// The only target of a relationship or connection.
std::string targetOf(const UsdLayer& layer, const std::string& prim, const std::string& name);

/// Whether a diagnostic contains this text.
bool says(const ImportedModel& model, const std::string& text);

/// What differs when the layer is written as text and read again; empty: nothing.
std::string differenceAfterWriting(const UsdLayer& layer);

} // namespace penumbra
