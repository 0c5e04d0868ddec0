#include "tools/RefusedCommandLine.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace penumbra {

namespace {

/// Letters that have to be put in, taken out or changed: V. I. Levenshtein, "Binary codes capable
/// of correcting deletions, insertions, and reversals", Soviet Physics Doklady 10(8), 1966.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1); // from the letters of a so far to those of b
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

/// The name that a mistyped word is nearest to; empty if none is near.
std::string nearestName(const std::string& word, const std::vector<std::string>& names) {
    std::string nearest;
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t distance = editDistance(word, name);
        if (distance >= least || distance >= name.size()) continue;
        least = distance;
        nearest = name;
    }
    return nearest;
}

std::string hint(const std::string& word, const std::vector<std::string>& names) {
    const std::string nearest = nearestName(word, names);
    return nearest.empty() ? std::string() : fmt::format("; did you mean '{}'?", nearest);
}

bool isOption(const std::string& word) {
    return word.size() > 1 && word.front() == '-';
}

std::vector<std::string> optionsOf(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::string aboutCommand(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return fmt::format("penumbra: error: unknown command '{}'{} (there are: {})", word,
                       hint(word, names), fmt::join(names, ", "));
}

std::string aboutWord(const CLI::App& command, const std::string& called, const std::string& word) {
    const std::string option = word.substr(0, word.find('='));
    if (isOption(word))
        return fmt::format("{}: error: unknown option '{}'{} ({} --help lists all)", called, option,
                           hint(option, optionsOf(command)), called);
    return fmt::format("{}: error: '{}' is one word too many ({} --help says what it takes)",
                       called, word, called);
}

/// Empty: they are all known.
std::string aboutUnknownWords(const CLI::App& app, std::span<const char* const> words) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    if (chosen.empty()) {
        const auto first = std::find_if(words.begin(), words.end(),
                                        [](const char* word) { return !isOption(word); });
        if (first != words.end()) return aboutCommand(app, *first);
        return words.empty() ? std::string() : aboutWord(app, "penumbra", words.front());
    }
    const CLI::App& command = *chosen.front();
    const std::vector<std::string> unknown = command.remaining();
    const std::string called = "penumbra " + command.get_name();
    for (const bool options : {true, false}) // a mistyped option leaves its value over as well
        for (const std::string word : words)
            if (isOption(word) == options &&
                std::find(unknown.begin(), unknown.end(), word) != unknown.end())
                return aboutWord(command, called, word);
    return {};
}

/// What CLI11 says of a value that it can't read: "Could not convert: --frame = abc".
std::string plainWords(const std::string& said) {
    constexpr std::string_view kUnread = "Could not convert: ", kIs = " = ";
    const std::size_t is = said.find(kIs);
    if (!said.starts_with(kUnread) || is == std::string::npos) return said;
    return fmt::format("{}: '{}' is not a number", said.substr(kUnread.size(), is - kUnread.size()),
                       said.substr(is + kIs.size()));
}

} // namespace

std::string aboutRefusal(const CLI::App& app, std::span<const char* const> words,
                         const CLI::ParseError& error) {
    std::string unknown = aboutUnknownWords(app, words);
    if (!unknown.empty()) return unknown;
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const std::string called =
        chosen.empty() ? "penumbra" : "penumbra " + chosen.front()->get_name();
    return fmt::format("{}: error: {} ({} --help says what it takes)", called,
                       plainWords(error.what()), called);
}

} // namespace penumbra
