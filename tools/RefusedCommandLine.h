// Command lines that are refused: words that mean nothing, values that can't be.
#pragma once

#include <span>
#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace penumbra {

/// One line about why CLI11 has refused the command line: about the first word that names no
/// command, no option of its command, and nothing else either, with the name that was probably
/// meant; else about what CLI11 found.
std::string aboutRefusal(const CLI::App& app, std::span<const char* const> words,
                         const CLI::ParseError& error);

} // namespace penumbra
