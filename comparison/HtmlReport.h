// The comparison as a page that people read.
#pragma once

#include "comparison/CompareOrders.h"

#include <string>
#include <utility>
#include <vector>

namespace penumbra {

/// What the page says besides results: name and value, in order.
using Facts = std::vector<std::pair<std::string, std::string>>;

struct ReportOptions {
    std::string title;
    Facts settings, machine;
};

/// Figures of one order over all edits, each a mean of the curves (see ErrorCurve.h).
struct OrderFigures {
    std::string name;
    double area = 0; ///< under error over work, up to where the slowest order is settled
    double work10 = -1, work1 = -1;       ///< until 10 % and 1 % of the error are left; -1: never
    double seconds10 = -1, seconds1 = -1; ///< likewise [s]
    double work = 0, seconds = 0;         ///< to the settled light, mean of the edits
    double differsFromTruth = 0;          ///< [JND]
};
std::vector<OrderFigures> figuresOf(const ComparisonResult& result);

/// A page in HTML 5 that needs no network, no script and no other file.
std::string htmlReport(const ComparisonResult& result, const ReportOptions& options);

} // namespace penumbra
