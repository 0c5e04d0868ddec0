#include "tools/SensorFile.h"

#include "base/Error.h"
#include "base/SystemError.h"
#include "io/image/AtomicFile.h"
#include "tools/OutputFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string_view>

namespace penumbra {

namespace {

constexpr std::array<std::string_view, 6> kColumns{"x", "y", "z", "nx", "ny", "nz"};

std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = line.find(',');
        std::string_view cell = line.substr(0, comma);
        while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t'))
            cell.remove_prefix(1);
        while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\r')) cell.remove_suffix(1);
        cells.push_back(cell);
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

float number(std::string_view cell, const SourceLocation& where) {
    float value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        throw SceneFileError(where, fmt::format("'{}' is not a number", cell.substr(0, 40)));
    return value;
}

} // namespace

std::vector<Receiver> readSensors(const std::string& path) {
    const std::string unreadable = whyUnreadable(path);
    if (!unreadable.empty()) throw SceneFileError({path}, "can't read: " + unreadable);
    errno = 0;
    std::ifstream file(path);
    if (!file) failToUse(path, errno ? errno : EIO, FileUse::read);
    std::string line;
    std::getline(file, line);
    if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3); // what some spreadsheets begin with
    std::array<std::size_t, 6> column;
    const auto header = cells(line);
    for (std::size_t i = 0; i < 6; ++i) {
        column[i] =
            std::size_t(std::find(header.begin(), header.end(), kColumns[i]) - header.begin());
        if (column[i] == header.size())
            throw SceneFileError({path, 1},
                                 fmt::format("no column '{}' (the header of a sensor list is "
                                             "x,y,z,nx,ny,nz)",
                                             kColumns[i]));
    }
    std::vector<Receiver> sensors;
    for (std::size_t row = 2; std::getline(file, line); ++row) {
        if (line.empty() || line == "\r") continue;
        const auto fields = cells(line);
        std::array<float, 6> v;
        for (std::size_t i = 0; i < 6; ++i) {
            if (column[i] >= fields.size())
                throw SceneFileError({path, row},
                                     fmt::format("too few values: no '{}'", kColumns[i]));
            v[i] = number(fields[column[i]], {path, row});
        }
        if (std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}) > 1e7f)
            throw SceneFileError({path, row}, "the sensor is more than 10,000 km away");
        const glm::vec3 normal(v[3], v[4], v[5]);
        if (!(glm::length(normal) > 0)) throw SceneFileError({path, row}, "the normal is zero");
        sensors.push_back({{v[0], v[1], v[2]}, glm::normalize(normal)});
    }
    return sensors;
}

void writeValues(const std::string& path, std::span<const Receiver> sensors,
                 std::span<const Rgb> values) {
    std::string text = "x,y,z,nx,ny,nz,r,g,b\n";
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const auto& [p, n] = sensors[i];
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", p.x, p.y, p.z, n.x, n.y, n.z,
                            values[i].r, values[i].g, values[i].b);
    }
    if (path == "-") {
        std::fwrite(text.data(), 1, text.size(), stdout);
        return finishStandardOutput();
    }
    writeFileAtomically(path, text);
}

} // namespace penumbra
