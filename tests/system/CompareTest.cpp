// penumbra compare: the report as files, and as a browser shows it (Debian: chromium).
#include "Program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace penumbra {

namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::string kScene = PENUMBRA_SOURCE_DIR "/scenes/chamber-move.usda";

/// Three frames of the chamber, coarse.
Outcome compare(const Workplace& work, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"compare", kScene, "--frames", "1:3",
                                       "--width", "96",   "-o",       work.path("report.html"),
                                       "--quiet"};
    for (const std::string& argument : coarse()) arguments.push_back(argument);
    for (std::string& argument : more) arguments.push_back(std::move(argument));
    return runPenumbra(arguments);
}

TEST(Compare, WritesAReportAndItsFigures) {
    const Workplace work;
    const Outcome outcome = compare(work);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(work.files(), ElementsAre("report.html", "report.json"));
    const auto json = nlohmann::json::parse(readFile(work.path("report.json")));
    ASSERT_FALSE(json["orders"].empty());
    EXPECT_EQ(json["orders"][0]["order"], "plain");
    ASSERT_EQ(json["orders"][0]["edits"].size(), 2u);
    const auto& samples = json["orders"][0]["edits"][0]["samples"];
    ASSERT_GT(samples.size(), 3u);
    EXPECT_GT(samples.front()["mean_jnd"], 0);
    EXPECT_LT(samples.back()["mean_jnd"], 0.1 * samples.front()["mean_jnd"].get<double>());
    EXPECT_TRUE(json["machine"].contains("hardware threads"));
}

TEST(Compare, TellsWhatIsWrongWithTheCommandLine) {
    const Workplace work;
    const std::string report = work.path("report.html");
    EXPECT_THAT(runPenumbra({"compare", kScene, "-o", report}).err, HasSubstr("--frames"));
    const Outcome single = runPenumbra({"compare", kScene, "--frames", "3", "-o", report});
    EXPECT_EQ(single.exitCode, 2);
    EXPECT_THAT(single.err, HasSubstr("two frames"));
    const Outcome film = compare(work, {"--film", "7"});
    EXPECT_EQ(film.exitCode, 2);
    EXPECT_THAT(film.err, HasSubstr("7 is no frame from 2 to 3"));
    const Outcome still = runPenumbra(
        {"compare", work.write("room.usda", smallRoom()), "--frames", "1:2", "-o", report});
    EXPECT_EQ(still.exitCode, 1);
    EXPECT_THAT(still.err, HasSubstr("room.usda: error: nothing moves"));
    EXPECT_THAT(work.files(), ElementsAre("room.usda"));
    EXPECT_EQ(compare(work, {"--dirty", "spotless"}).exitCode, 2);
    const Outcome both = compare(work, {"--pan", "20", "--cut-from", "/World/Camera"});
    EXPECT_EQ(both.exitCode, 2);
    EXPECT_THAT(both.err, HasSubstr("--cut-from"));
}

TEST(Compare, SaysHowTheViewerMovedAndWhatWasWorkedOn) {
    const Workplace work;
    const Outcome outcome =
        compare(work, {"--pan", "20", "--dirty", "perfect", "--orders", "plain,importance"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto settings = nlohmann::json::parse(readFile(work.path("report.json")))["settings"];
    EXPECT_THAT(settings["the viewer"].get<std::string>(), HasSubstr("20 degrees"));
    EXPECT_THAT(settings["dirty set"].get<std::string>(), HasSubstr("perfect"));
}

/// Mean error as a share of what it was at first, until so much work is done.
double areaUnder(const nlohmann::json& samples, double work) {
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double from = samples[i]["work"];
        const double to = i + 1 < samples.size() ? samples[i + 1]["work"].get<double>() : work;
        sum += std::max(0.0, std::min(to, work) - from) * samples[i]["mean_jnd"].get<double>();
    }
    return sum / (samples[0]["mean_jnd"].get<double>() * work);
}

TEST(Compare, ImportanceIsNoLaterThanPlainWhereASeatMovesByCentimetres) {
    const Workplace work;
    const Outcome outcome =
        runPenumbra({"compare", PENUMBRA_SOURCE_DIR "/scenes/office-seat.usda", "--frames", "20:24",
                     "--element-size", "0.1", "--direct-only", "--orders", "plain,importance",
                     "--width", "320", "-o", work.path("report.html"), "--quiet"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(readFile(work.path("report.json")));
    const auto &plain = json["orders"][0]["edits"], &importance = json["orders"][1]["edits"];
    ASSERT_EQ(plain.size(), 4u);
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const double all = plain[i]["samples"].back()["work"];
        EXPECT_LT(areaUnder(importance[i]["samples"], all),
                  1.05 * areaUnder(plain[i]["samples"], all))
            << "edit " << i + 1;
    }
}

/// What Chromium prints; it finds no network and keeps its own files in `work`.
std::string chromium(const Workplace& work, const std::string& options, const std::string& page) {
    const std::string command = "chromium --headless --no-sandbox --disable-gpu --no-first-run "
                                "--host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir='" +
                                work.path("profile") + "' " + options + " 'file://" + page +
                                "' 2>/dev/null";
    std::string output;
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (!pipe) return {};
    std::array<char, 4096> part;
    while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe))
        output.append(part.data(), size);
    pclose(pipe);
    return output;
}

TEST(Compare, ReportIsShownByABrowserWithoutANetwork) {
    if (std::system("command -v chromium >/dev/null") != 0)
        GTEST_SKIP() << "no chromium in PATH (Debian: chromium, 410 MB)";
    const Workplace work;
    ASSERT_EQ(compare(work).exitCode, 0);
    const std::string page = readFile(work.path("report.html"));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    // The browser itself is asked what it made of the page.
    const std::string asked = work.write("asked.html", page + R"(<script>
        const loaded = [...document.images].filter(i => i.complete && i.naturalWidth > 0).length;
        const drawn = [...document.querySelectorAll('svg path')].filter(p => p.getTotalLength() > 50);
        const wide = document.documentElement.scrollWidth > window.innerWidth;
        document.body.dataset.found = `images ${loaded},
            missing ${document.images.length - loaded},
            curves ${drawn.length}, rows ${document.querySelectorAll('tbody tr').length},
            from elsewhere ${performance.getEntriesByType('resource')
                .filter(e => !e.name.startsWith('data:')).length}, too wide ${wide}`;
        </script>)");
    for (const std::string size : {"1200,900", "500,900"}) {
        const std::string dom = chromium(work, "--window-size=" + size + " --dump-dom", asked);
        const std::size_t at = dom.find("data-found=\"");
        ASSERT_NE(at, std::string::npos) << size << ": chromium did not show the page";
        const std::string found = dom.substr(at, 300);
        EXPECT_THAT(found, ContainsRegex("images [1-9]"));
        EXPECT_THAT(found, HasSubstr("missing 0"));
        EXPECT_THAT(found, ContainsRegex("curves [1-9]"));
        EXPECT_THAT(found, HasSubstr("from elsewhere 0"));
        EXPECT_THAT(found, HasSubstr("too wide false"));
    }
    chromium(work, "--window-size=1200,900 --screenshot='" + work.path("shot.png") + "'",
             work.path("report.html"));
    EXPECT_GT(std::filesystem::file_size(work.path("shot.png")), 20'000u);
}

} // namespace

} // namespace penumbra
