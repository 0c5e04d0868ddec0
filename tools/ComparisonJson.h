// The comparison for programs.
#pragma once

#include "comparison/HtmlReport.h"

#include <string>

namespace penumbra {

/// All samples of all edits and orders, and the figures of the report, as JSON. Keys may be added,
/// never renamed.
std::string comparisonJson(const ComparisonResult& result, const ReportOptions& report);

} // namespace penumbra
