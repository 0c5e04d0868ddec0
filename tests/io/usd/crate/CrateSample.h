// A small layer as a crate file, made for tests, and the same as text.
#pragma once

#include <string>
#include <string_view>

namespace penumbra {

/// Two prims, a variant set, attributes of several types, samples, list edits, metadata.
/// \param minor version 0.minor: 0 to 14
std::string sampleCrate(int minor);
extern const std::string_view kSampleText;

} // namespace penumbra
