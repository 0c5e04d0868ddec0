// What other programs say.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace penumbra {

/// What a shell command prints, standard error included; empty if it fails.
inline std::string outputOf(const std::string& command) {
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return {};
    std::string output;
    std::array<char, 4096> part;
    while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe))
        output.append(part.data(), size);
    return pclose(pipe) == 0 ? output : std::string();
}

} // namespace penumbra
