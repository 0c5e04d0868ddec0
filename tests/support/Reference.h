// The reference data in tests/data, and the error by which solutions are judged.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace penumbra {

inline std::string dataFile(const std::string& name) {
    return PENUMBRA_SOURCE_DIR "/tests/data/" + name;
}

/// A table of text: one map a row, from column to cell. Cells may be in quotes.
using Table = std::vector<std::map<std::string, std::string>>;

inline std::vector<std::string> csvCells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else if (c != '\r')
            cells.back() += c;
    }
    return cells;
}

inline Table readCsv(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("can't read " + path);
    const std::vector<std::string> header = csvCells(line);
    Table table;
    while (std::getline(file, line)) {
        const std::vector<std::string> cells = csvCells(line);
        auto& row = table.emplace_back();
        for (std::size_t i = 0; i < std::min(header.size(), cells.size()); ++i)
            row[header[i]] = cells[i];
    }
    return table;
}

/// A sensor and what it must read.
struct TruthSensor {
    Receiver receiver;
    Rgb all, direct; ///< [lux]
    std::string object;
};

inline std::vector<TruthSensor> readTruth(const std::string& name) {
    std::vector<TruthSensor> sensors;
    for (const auto& row : readCsv(dataFile(name))) {
        const auto number = [&](const char* column) { return std::stof(row.at(column)); };
        sensors.push_back(
            {{{number("x"), number("y"), number("z")}, {number("nx"), number("ny"), number("nz")}},
             {number("r"), number("g"), number("b")},
             {number("direct_r"), number("direct_g"), number("direct_b")},
             row.at("object")});
    }
    return sensors;
}

/// How far values are from the truth: |ours - truth| / max(truth, 5 % of the median truth), and the
/// bias sum(ours) / sum(truth) - 1, all on luminance.
struct SensorErrors {
    double mean = 0, percentile95 = 0, bias = 0;
};

inline SensorErrors sensorErrors(const std::vector<Rgb>& ours, const std::vector<Rgb>& truth) {
    std::vector<double> sorted;
    for (Rgb value : truth) sorted.push_back(luminance(value));
    std::sort(sorted.begin(), sorted.end());
    const double least = 0.05 * sorted[sorted.size() / 2];
    SensorErrors result;
    std::vector<double> errors;
    double sumOurs = 0, sumTruth = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const double a = luminance(ours[i]), b = luminance(truth[i]);
        errors.push_back(std::abs(a - b) / std::max(b, least));
        result.mean += errors.back() / double(ours.size());
        sumOurs += a, sumTruth += b;
    }
    std::sort(errors.begin(), errors.end());
    result.percentile95 = errors[std::size_t(0.95 * double(errors.size() - 1))];
    result.bias = sumOurs / sumTruth - 1;
    return result;
}

} // namespace penumbra
