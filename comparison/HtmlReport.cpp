#include "comparison/HtmlReport.h"

#include "comparison/Chart.h"
#include "comparison/ReportImages.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace penumbra {

namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.5 sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: 1180px; padding: 0 1em }
h1 { font-size: 1.5em } h2 { font-size: 1.2em; margin-top: 2em; border-bottom: 1px solid #ccc }
table { border-collapse: collapse; margin: 1em 0 }
.wide { overflow-x: auto } th, td { padding: 3px 10px; border-bottom: 1px solid #ddd; text-align: right }
tbody td { white-space: nowrap }
th { font-weight: 600 } th:first-child, td:first-child, .facts td { text-align: left; white-space: nowrap }
.facts td { white-space: normal } .charts { display: flex; flex-wrap: wrap; gap: 8px } .chart { flex: 1 1 520px; min-width: 0; overflow-x: auto }
.chart svg { width: 100%; min-width: 500px } thead th { border-bottom: 2px solid #888 }
figure { display: inline-block; margin: 0 8px 12px 0; vertical-align: top } figcaption { font-size: 12px; color: #444 }
img { display: block; image-rendering: auto; border: 1px solid #bbb } .strip { white-space: nowrap; overflow-x: auto }
.note { color: #555; font-size: 13px; max-width: 60em } .swatch { display: inline-block; width: 1.6em; height: .5em; margin-right: .5em }
.warning { border-left: 4px solid #d55e00; padding-left: .8em } svg { max-width: 100%; height: auto }
)";

using Curves = std::vector<std::vector<CurvePoint>>;

/// Indices of edits.
using Edits = std::vector<std::size_t>;

/// Those that figures and curves are means of.
Edits countedEdits(const ComparisonResult& result) {
    Edits edits = seenEdits(result);
    if (edits.empty())
        for (std::size_t i = 0; i < result.frames.size(); ++i) edits.push_back(i);
    return edits;
}

template <class Over>
Curves curvesOf(const PolicyResult& policy, const Edits& edits, Over over) {
    Curves curves;
    for (std::size_t i : edits) curves.push_back(over(policy.frames[i]));
    return curves;
}

std::vector<CurvePoint> meanOverWork(const PolicyResult& policy, const Edits& edits) {
    return meanOf(curvesOf(policy, edits, errorOverWork));
}
std::vector<CurvePoint> meanOverTime(const PolicyResult& policy, const Edits& edits) {
    return meanOf(curvesOf(policy, edits, errorOverTime));
}

double mean(const std::vector<double>& values, const Edits& edits) {
    double sum = 0;
    for (std::size_t i : edits) sum += values[i];
    return edits.empty() ? 0 : sum / double(edits.size());
}

/// Until where areas are taken: all orders are settled there.
double lastWork(const ComparisonResult& result, const Edits& edits) {
    double last = 0;
    for (const PolicyResult& policy : result.policies)
        for (std::size_t i : edits) last = std::max(last, policy.work[i]);
    return last;
}

std::string orNever(double value, double scale = 1) {
    return value < 0 ? "–" : figure(value * scale);
}

void writeFigures(std::string& page, const ComparisonResult& result) {
    page += "<div class='wide'><table><thead><tr><th>policy</th><th>area under the curve</th>"
            "<th>work to 10 % [rays]</th><th>work to 1 % [rays]</th><th>work in all "
            "[rays]</th><th>time to 10 % [ms]</th>"
            "<th>time to 1 % [ms]</th><th>time in all [ms]</th><th>settled, off by [JND]</th>"
            "</tr></thead><tbody>\n";
    std::size_t index = 0;
    for (const PolicyFigures& f : figuresOf(result))
        fmt::format_to(std::back_inserter(page),
                       "<tr><td><span class='swatch' style='background:{}'></span>{}</td>"
                       "<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
                       "<td>{}</td><td>{:.3f}</td></tr>\n",
                       seriesColour(index++), escaped(f.name),
                       f.area < 0 ? "–" : fmt::format("{:.4f}", f.area), orNever(f.work10),
                       orNever(f.work1), figure(f.work), orNever(f.seconds10, 1e3),
                       orNever(f.seconds1, 1e3), figure(1e3 * f.seconds), f.differsFromTruth);
    page += "</tbody></table></div>\n";
    fmt::format_to(
        std::back_inserter(page),
        "<p class='note'>To 10 % and 1 % of the initial visible error, on the mean curve "
        "of all edits, so that long ones may come late; in all: a mean edit. {} of "
        "{} edits are seen. What is worked on: {}.</p>\n",
        seenEdits(result).size(), result.frames.size(),
        result.dirty == DirtySetKind::perfect
            ? "of direct light only what comes out otherwise, as if that were known"
            : "what bounding shafts find, of which some turns out not to change");
}

void writeCharts(std::string& page, const ComparisonResult& result) {
    const Edits edits = countedEdits(result);
    std::vector<ChartSeries> work, time;
    for (const PolicyResult& policy : result.policies) {
        work.push_back({policy.name, meanOverWork(policy, edits)});
        time.push_back({policy.name, meanOverTime(policy, edits)});
        for (CurvePoint& point : time.back().points) point.x *= 1e3;
    }
    constexpr int kWidth = 600; // two beside one another, or one on a narrow page
    page += "<div class='charts'><div class='chart'>" +
            lineChart(work, {.title = "Visible error over work",
                             .xLabel = "work since the edit [rays], logarithmic",
                             .yLabel = "mean visible error [JND]",
                             .width = kWidth});
    page += "</div><div class='chart'>" +
            lineChart(time, {.title = "Visible error over time",
                             .xLabel = "time since the edit [ms], logarithmic",
                             .yLabel = "mean visible error [JND]",
                             .width = kWidth}) +
            "</div></div>\n";
}

/// One moment of the film: the picture, and below it what is wrong with it.
void writeMoment(std::string& page, const std::string& policy, const FilmPicture& film,
                 const ToneMap& tone) {
    const int width = std::min(film.picture.width, 320);
    const int height = film.picture.height * width / film.picture.width;
    fmt::format_to(std::back_inserter(page),
                   "<figure><img src='{0}' width='{2}' height='{3}' alt='{4}, picture'>"
                   "<img src='{1}' width='{2}' height='{3}' alt='{4}, visible error'>"
                   "<figcaption><b>{5} ms</b>, {6} rays' worth<br>mean {7} JND, 99 % below {8}<br>"
                   "{9:.2f} % of pixels above 1</figcaption></figure>\n",
                   pictureUri(film.picture, tone), differenceUri(film.jnd), width, height,
                   escaped(policy), figure(1e3 * film.seconds), figure(film.work),
                   figure(film.error.mean), figure(film.error.p99), 100 * film.error.visible);
}

void writeFilm(std::string& page, const PolicyResult& policy, const ToneMap& tone) {
    page += "<h3>" + escaped(policy.name) + "</h3>\n<div class='strip'>";
    for (const FilmPicture& film : policy.film) writeMoment(page, policy.name, film, tone);
    page += "</div>\n";
}

void writeFilms(std::string& page, const ComparisonResult& result, int frame) {
    const ToneMap tone = toneFor(result.truth);
    fmt::format_to(
        std::back_inserter(page),
        "<h2>Frame {}, as the viewer sees it</h2>\n<p class='note'>Above, the picture at "
        "the first sample after 0, 1, 2, 4, 8 ... ms of work; below, how visible it is that "
        "it is not yet the settled one.</p>\n{}<div class='strip'>",
        result.frames[std::size_t(frame)], differenceLegend());
    fmt::format_to(
        std::back_inserter(page),
        "<figure><img src='{}' width='{}' height='{}' alt='settled'><figcaption>settled: "
        "what is to come out</figcaption></figure></div>\n",
        pictureUri(result.truth, tone), result.truth.width, result.truth.height);
    for (const PolicyResult& policy : result.policies) writeFilm(page, policy, tone);
}

void writeFacts(std::string& page, const std::string& heading, const Facts& facts) {
    page += "<h2>" + heading + "</h2>\n<table class='facts'><tbody>\n";
    for (const auto& [name, value] : facts)
        page += "<tr><td>" + escaped(name) + "</td><td>" + escaped(value) + "</td></tr>\n";
    page += "</tbody></table>\n";
}

constexpr const char* kReading = R"(<h2>How to read this</h2>
<p class='note'>Each frame is an edit. Before it, the light is settled; after it, the scheduling
policies do the same work in different sequence, and the picture is sampled again and again. The
visible error of a pixel is in just noticeable differences (JND): at 1, an observer who compares it
with the settled picture sees the difference half the time. The curves are means over all pixels and
all edits. The area under the curve is the share of the initial error that is there on average until
the slowest policy is settled (0: right at once, 1: not until the end). Work is what the solver did,
in rays and what costs as much as a ray; it is the same on every machine. Time includes all of it:
finding the work, ordering it, rays and sums; the pictures are not counted.</p>
)";

} // namespace

std::vector<std::size_t> seenEdits(const ComparisonResult& result) {
    constexpr double kSeen = 1e-3; // [JND]
    std::vector<std::size_t> edits;
    for (std::size_t i = 0; i < result.frames.size(); ++i) {
        const bool seen = std::any_of(result.policies.begin(), result.policies.end(),
                                      [&](const PolicyResult& policy) {
                                          return policy.frames[i].front().error.mean >= kSeen;
                                      });
        if (seen) edits.push_back(i);
    }
    return edits;
}

std::string whatIsNotSeen(const ComparisonResult& result) {
    const std::vector<std::size_t> seen = seenEdits(result);
    if (seen.empty() && !result.frames.empty())
        return "nothing of what changes is seen through this camera: orders can't be ranked";
    std::string frames;
    for (std::size_t i = 0; i < result.frames.size(); ++i)
        if (!std::binary_search(seen.begin(), seen.end(), i))
            frames += fmt::format("{}{}", frames.empty() ? "" : ", ", result.frames[i]);
    return frames.empty()
               ? frames
               : "nothing is seen of what changes in frame " + frames + ": left out of the figures";
}

std::vector<PolicyFigures> figuresOf(const ComparisonResult& result) {
    const bool seen = !seenEdits(result).empty();
    const Edits edits = countedEdits(result);
    const double last = lastWork(result, edits);
    std::vector<PolicyFigures> figures;
    for (const PolicyResult& policy : result.policies) {
        PolicyFigures f;
        f.name = policy.name;
        if (seen) {
            const std::vector<CurvePoint> work = meanOverWork(policy, edits);
            const std::vector<CurvePoint> time = meanOverTime(policy, edits);
            f.area = normalisedArea(work, last);
            f.work10 = whenBelow(work, 0.1).value_or(-1);
            f.work1 = whenBelow(work, 0.01).value_or(-1);
            f.seconds10 = whenBelow(time, 0.1).value_or(-1);
            f.seconds1 = whenBelow(time, 0.01).value_or(-1);
        }
        f.work = mean(policy.work, edits);
        f.seconds = mean(policy.seconds, edits);
        f.differsFromTruth = policy.differsFromTruth;
        figures.push_back(f);
    }
    return figures;
}

std::string htmlReport(const ComparisonResult& result, const ReportOptions& options) {
    std::string page = "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>"
                       "<meta name='viewport' content='width=device-width'><title>" +
                       escaped(options.title) + "</title><style>" + kStyle +
                       "</style></head><body>\n<h1>" + escaped(options.title) + "</h1>\n";
    const std::string unseen = whatIsNotSeen(result);
    if (!unseen.empty()) page += "<p class='warning'>Note: " + escaped(unseen) + ".</p>\n";
    writeFigures(page, result);
    writeCharts(page, result);
    writeFilms(page, result, result.filmFrame);
    page += kReading;
    writeFacts(page, "Settings", options.settings);
    writeFacts(page, "Machine", options.machine);
    return page + "</body></html>\n";
}

} // namespace penumbra
