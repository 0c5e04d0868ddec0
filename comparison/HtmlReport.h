// The comparison as a page that people read.
#pragma once

#include "comparison/ComparePolicies.h"

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

/// Edits (indices) of which something is seen, so that policies differ in it: where
/// the error is visible at first, 1e-3 JND in the mean.
std::vector<std::size_t> seenEdits(const ComparisonResult& result);
/// Of which edits nothing is seen, for people; empty if something is of each.
std::string whatIsNotSeen(const ComparisonResult& result);

/// Figures of one policy over all edits that are seen, each a mean of the curves (see
/// ErrorCurve.h). If none is there are no figures but those of work and time, over all edits.
struct PolicyFigures {
    std::string name;
    /// Under error over work, up to where the slowest policy is settled; -1: nothing is seen.
    double area = -1;
    double work10 = -1, work1 = -1;       ///< until 10 % and 1 % of the error are left; -1: never
    double seconds10 = -1, seconds1 = -1; ///< likewise [s]
    double work = 0, seconds = 0;         ///< to the settled light, mean of these edits
    double differsFromTruth = 0;          ///< [JND]
};
std::vector<PolicyFigures> figuresOf(const ComparisonResult& result);

/// A page in HTML 5 that needs no network, no script and no other file.
std::string htmlReport(const ComparisonResult& result, const ReportOptions& options);

} // namespace penumbra
