// Curves as an SVG drawing.
#pragma once

#include "comparison/ErrorCurve.h"

#include <string>
#include <vector>

namespace penumbra {

/// One curve of a chart. Colour and dashes follow from its index in the list.
struct ChartSeries {
    std::string name;
    std::vector<CurvePoint> points; ///< drawn as steps: each value holds until the next point
};

struct ChartOptions {
    std::string title;
    std::string xLabel, yLabel;    ///< with their units
    double lastX = 0;              ///< the axis ends here at least; 0: with the last point
    int width = 760, height = 360; ///< higher if the legend needs it
};

/// A chart with a logarithmic x axis, a linear y axis from 0, a grid, and a legend beside
/// it. Self-contained:
/// an <svg> element that needs no style sheet, script or font but what any browser has. Curves
/// differ in dashes as well as in colour.
std::string lineChart(const std::vector<ChartSeries>& series, const ChartOptions& options);

/// The colour of the series at an index, as #rrggbb: of eight that people of any colour vision tell
/// apart (Okabe & Ito 2008).
std::string seriesColour(std::size_t index);

/// Text with what means something in HTML and SVG made harmless.
std::string escaped(const std::string& text);

/// A number for people: three digits, with k, M or G for large ones.
std::string figure(double value);

} // namespace penumbra
