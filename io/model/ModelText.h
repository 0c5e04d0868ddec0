// Text on which Assimp would hang or run out of stack or memory.
#pragma once

#include "io/model/ModelFormat.h"

#include <filesystem>
#include <string_view>

namespace penumbra {

/// Refuses it before Assimp 5.2 reads it. Throws SceneFileError.
///
/// - Collada, FBX as text: elements nested so deeply that recursion overflows the stack.
/// - Collada: something else than numbers in a list of indices, on which it takes in zeros
///   without an end.
/// - PLY: a header without an end, which it reads for ever, and more elements than the file has
///   bytes.
/// \param text all of the file
void checkModelText(const std::filesystem::path& file, ModelFormat format, std::string_view text);

} // namespace penumbra
