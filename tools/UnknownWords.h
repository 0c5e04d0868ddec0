// Words of the command line that mean nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace penumbra {

/// One line about the first word that names no command, no option of its command, and nothing else
/// either, with the name that was probably meant; empty if there is none. To be asked when CLI11
/// has refused the command line.
std::string aboutUnknownWords(const CLI::App& app, std::span<const char* const> words);

/// The name that a mistyped word is nearest to; empty if none is near.
std::string nearestName(const std::string& word, const std::vector<std::string>& names);

} // namespace penumbra
