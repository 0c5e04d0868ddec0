#include "comparison/Chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace penumbra {

namespace {

constexpr std::array kColours = {"#000000", "#d55e00", "#0072b2", "#009e73",
                                 "#cc79a7", "#e69f00", "#56b4e9", "#8a8a00"};
constexpr std::array kDashes = {"", "9 3", "3 3", "12 3 3 3", "6 2 2 2", "2 2", "14 4", "8 2 8 6"};
constexpr double kLeft = 62, kRight = 16, kTop = 34, kBottom = 48; ///< margins [pixels]
constexpr double kLegendRow = 18, kLegendGap = 14;

/// From quantities to positions in the drawing.
struct Axes {
    double firstX, lastX, lastY; ///< the x axis is logarithmic
    double left, top, width, height;

    double x(double value) const {
        const double t = std::log(std::max(value, firstX) / firstX) / std::log(lastX / firstX);
        return left + width * std::clamp(t, 0.0, 1.0);
    }
    double y(double value) const {
        return top + height * (1 - std::clamp(value / lastY, 0.0, 1.0));
    }
};

/// 1, 2 or 5 times a power of ten, such that about `count` steps reach `last`.
double niceStep(double last, int count) {
    const double rough = last / count;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    for (double factor : {1.0, 2.0, 5.0})
        if (factor * decade >= rough) return factor * decade;
    return 10 * decade;
}

/// The legend is beside the curves: it would cover some of them.
double legendWidth(const std::vector<ChartSeries>& series) {
    std::size_t longest = 0;
    for (const ChartSeries& one : series) longest = std::max(longest, one.name.size());
    return 52 + 7.2 * double(longest);
}

Axes axesOf(const std::vector<ChartSeries>& series, const ChartOptions& options) {
    double first = INFINITY, last = options.lastX, most = 0;
    for (const ChartSeries& one : series)
        for (const CurvePoint& point : one.points) {
            if (point.x > 0) first = std::min(first, point.x);
            last = std::max(last, point.x);
            most = std::max(most, point.y);
        }
    if (!(first < last)) first = last > 0 ? last / 10 : 0.1, last = last > 0 ? last : 1;
    most = most > 0 ? most : 1;
    const double step = niceStep(most, 5);
    return {first,
            last,
            step * std::ceil(most / step - 1e-9),
            kLeft,
            kTop,
            options.width - kLeft - kLegendGap - legendWidth(series) - kRight,
            options.height - kTop - kBottom};
}

void drawGrid(std::string& svg, const Axes& axes) {
    const double bottom = axes.top + axes.height, right = axes.left + axes.width;
    const auto out = std::back_inserter(svg);
    const double step = niceStep(axes.lastY, 5);
    for (double y = 0; y <= axes.lastY * 1.0001; y += step)
        fmt::format_to(out,
                       "<line x1='{0:.1f}' x2='{1:.1f}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/>"
                       "<text x='{3:.1f}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
                       axes.left, right, axes.y(y), axes.left - 6, axes.y(y) + 4, figure(y));
    const double decades = std::log10(axes.lastX / axes.firstX);
    for (double power = std::floor(std::log10(axes.firstX)); power <= std::log10(axes.lastX);
         power += 1)
        for (double factor : {1.0, 2.0, 5.0}) {
            const double x = factor * std::pow(10.0, power);
            if (x < axes.firstX * 0.999 || x > axes.lastX * 1.001) continue;
            fmt::format_to(
                out, "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}' stroke='{3}'/>\n",
                axes.x(x), axes.top, bottom, factor == 1 ? "#ccc" : "#eee");
            if (factor == 1 || decades < 3)
                fmt::format_to(out, "<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                               axes.x(x), bottom + 16, figure(x));
        }
    fmt::format_to(out,
                   "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='none' "
                   "stroke='#888'/>\n",
                   axes.left, axes.top, axes.width, axes.height);
}

void drawCurve(std::string& svg, const ChartSeries& series, std::size_t index, const Axes& axes) {
    if (series.points.empty()) return;
    const auto out = std::back_inserter(svg);
    fmt::format_to(out, "<path fill='none' stroke='{}' stroke-width='2' stroke-dasharray='{}' d='M",
                   seriesColour(index), kDashes[index % kDashes.size()]);
    double before = series.points.front().y;
    fmt::format_to(out, "{:.1f} {:.1f}", axes.left, axes.y(before));
    for (const CurvePoint& point : series.points) {
        fmt::format_to(out, "L{:.1f} {:.1f}L{:.1f} {:.1f}", axes.x(point.x), axes.y(before),
                       axes.x(point.x), axes.y(point.y));
        before = point.y;
    }
    fmt::format_to(out, "L{:.1f} {:.1f}'><title>{}</title></path>\n", axes.left + axes.width,
                   axes.y(before), escaped(series.name));
}

void drawLegend(std::string& svg, const std::vector<ChartSeries>& series, const Axes& axes) {
    const double left = axes.left + axes.width + kLegendGap - 8, top = axes.top;
    const auto out = std::back_inserter(svg);
    for (std::size_t i = 0; i < series.size(); ++i) {
        const double y = top + 4 + kLegendRow * (double(i) + 0.5);
        fmt::format_to(out,
                       "<line x1='{0:.1f}' x2='{1:.1f}' y1='{2:.1f}' y2='{2:.1f}' stroke='{3}' "
                       "stroke-width='2' stroke-dasharray='{4}'/>"
                       "<text x='{5:.1f}' y='{6:.1f}'>{7}</text>\n",
                       left + 8, left + 38, y, seriesColour(i), kDashes[i % kDashes.size()],
                       left + 44, y + 4, escaped(series[i].name));
    }
}

} // namespace

std::string seriesColour(std::size_t index) {
    return kColours[index % kColours.size()];
}

std::string escaped(const std::string& text) {
    std::string result;
    for (char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\'':
            result += "&#39;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string figure(double value) {
    const double size = std::abs(value);
    if (size >= 1e9) return fmt::format("{:.3g} G", value / 1e9);
    if (size >= 1e6) return fmt::format("{:.3g} M", value / 1e6);
    if (size >= 1e4) return fmt::format("{:.3g} k", value / 1e3);
    if (size >= 1000) return fmt::format("{:.0f}", value);
    return fmt::format("{:.3g}", value);
}

std::string lineChart(const std::vector<ChartSeries>& series, const ChartOptions& options) {
    const double legend = kLegendRow * double(series.size()) + 8;
    ChartOptions fitting = options;
    fitting.height = std::max(options.height, int(kTop + kBottom + legend));
    const Axes axes = axesOf(series, fitting);
    std::string svg = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
        "font-family='sans-serif' font-size='12' role='img' aria-label='{2}'>\n"
        "<rect width='{0}' height='{1}' fill='#fff'/>\n"
        "<text x='{3}' y='20' font-size='14' font-weight='bold'>{2}</text>\n",
        fitting.width, fitting.height, escaped(fitting.title), kLeft);
    drawGrid(svg, axes);
    for (std::size_t i = 0; i < series.size(); ++i) drawCurve(svg, series[i], i, axes);
    drawLegend(svg, series, axes);
    fmt::format_to(std::back_inserter(svg),
                   "<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>\n"
                   "<text transform='translate(16 {:.1f}) rotate(-90)' "
                   "text-anchor='middle'>{}</text>\n</svg>\n",
                   axes.left + axes.width / 2, fitting.height - 10, escaped(fitting.xLabel),
                   axes.top + axes.height / 2, escaped(fitting.yLabel));
    return svg;
}

} // namespace penumbra
