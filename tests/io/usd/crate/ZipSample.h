// Packages for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace penumbra {

/// A zip of stored files, each with its data at a multiple of 64 bytes, as packages have it.
inline std::string zipOf(const std::vector<std::pair<std::string, std::string>>& files) {
    std::string out, directory;
    const auto put16 = [](std::string& to, std::size_t value) {
        to += char(value & 255);
        to += char(value >> 8 & 255);
    };
    const auto put32 = [&](std::string& to, std::size_t value) {
        put16(to, value & 0xffff);
        put16(to, value >> 16);
    };
    for (const auto& [name, data] : files) {
        const std::size_t place = out.size();
        const std::size_t padding = (64 - (place + 30 + name.size() + 4) % 64) % 64 + 4;
        std::string common; // flags, method, time, date, checksum, sizes, length of the name
        for (int i = 0; i < 12; ++i) common += '\0';
        put32(common, data.size());
        put32(common, data.size());
        put16(common, name.size());
        out += std::string("PK\3\4\n\0", 6) + common;
        put16(out, padding);
        out += name;
        put16(out, 0x1986);
        put16(out, padding - 4);
        out += std::string(padding - 4, '\0') + data;
        directory += std::string("PK\1\2\n\0\n\0", 8) + common + std::string(12, '\0');
        put32(directory, place);
        directory += name;
    }
    const std::size_t place = out.size();
    out += directory + std::string("PK\5\6\0\0\0\0", 8);
    put16(out, files.size());
    put16(out, files.size());
    put32(out, directory.size());
    put32(out, place);
    put16(out, 0); // no comment
    return out;
}

} // namespace penumbra
