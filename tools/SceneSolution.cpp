#include "tools/SceneSolution.h"

#include "base/Clock.h"
#include "base/Error.h"
#include "radiosity/query/MemoryWarning.h"
#include "tools/OutputFiles.h"
#include "tools/Statistics.h"
#include "viewer/input/LightSettings.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace penumbra {

namespace {

CLI::Validator number() { // CLI::Range lets nan pass
    return CLI::Validator(
        [](std::string& text) {
            return text.find_first_of("nN") == std::string::npos ? ""
                                                                 : "'" + text + "' is no number";
        },
        "");
}

void addMeshOptions(CLI::App& command, SolveSettings& settings) {
    const auto positive = number() & CLI::Range(1e-6, 1e6);
    command
        .add_option("--patch-size", settings.asked.patchSize,
                    "Longest edge of a patch, which sends light [m]\n"
                    "(default: what the file asks for, or\n"
                    "follows the scene, sqrt(surface area / 1650) up to 0.5 m)")
        ->check(positive);
    command
        .add_option("--element-size", settings.asked.elementSize,
                    "Longest edge of an element, which receives and shows light [m]\n"
                    "(default: an eighth of a patch)")
        ->check(positive);
}

void addLightOptions(CLI::App& command, SolveSettings& settings) {
    command
        .add_option("--samples", settings.solver.samples,
                    "Visibility samples of a light and a point; four times as many in penumbrae")
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    command
        .add_option("--residual", settings.asked.residual,
                    "Relax until the certificate, the bound of what the picture may still be\n"
                    "wrong by, is below this share of the brightest emitter's exitance\n"
                    "(default: until it is below 1 % of the mean radiosity)")
        ->check(number() & CLI::Range(1e-9, 1.0));
    command.add_flag("--direct-only", settings.solver.directOnly,
                     "Light straight from the emitters, no interreflection");
    command
        .add_option("--order", settings.asked.policy,
                    "What is worked on first after an edit: what the viewer gains most from\n"
                    "(importance), sender by sender (plain), or anything (random).\n"
                    "Changes what is right when, not what comes out (default: importance)")
        ->transform(CLI::CheckedTransformer(
                        std::map<std::string, PolicyKind>{{"importance", PolicyKind::importance},
                                                          {"plain", PolicyKind::plain},
                                                          {"random", PolicyKind::random}})
                        .description("{importance,plain,random}"))
        ->type_name("NAME");
}

void addPlayOptions(CLI::App& command, SolveSettings& settings) {
    command
        .add_option("--frame", settings.frame,
                    "Time code of the file's animation to show (default: its start)")
        ->check(number());
    command.add_option("--frames", settings.frames,
                       "Play the file's animation from time code A to B, in steps of one (A:B).\n"
                       "A '#' in the name of a result becomes the number of the frame");
    command.add_flag("--from-scratch", settings.fromScratch,
                     "Forget everything at each frame instead of updating what the edit changes");
}

void addReportOptions(CLI::App& command, SolveSettings& settings) {
    command.add_option("--threads", settings.threads, "Threads to use (default: one a core)")
        ->check(CLI::Range(1u, 1024u));
    addMemoryOption(command, settings.solver.memory);
    command.add_option("--stats", settings.stats, "Write counts and times to this file, as JSON");
    command.add_flag("--allow-outside", settings.allowOutside,
                     "Open what the scene refers to outside of its folder, too");
    command.add_flag("--verbose", settings.verbose, "Say everything that was skipped in the file");
    command.add_flag("--progress", settings.progress,
                     "Show progress even when standard error is no terminal");
    command.add_flag("--quiet", settings.quiet, "Show neither progress, warnings nor a summary");
}

} // namespace

void addMemoryOption(CLI::App& command, std::size_t& bytes) {
    command
        .add_option_function<double>(
            "--memory", [&bytes](double gigabytes) { bytes = std::size_t(gigabytes * 1e9); },
            "Memory to use [GB]: what does not fit into it is computed again when it is\n"
            "needed, which takes longer (default: half of the machine's)")
        ->check(number() & CLI::Range(1e-3, 1e6))
        ->type_name("GB");
}

void addSolveOptions(CLI::App& command, SolveSettings& settings) {
    command
        .add_option("SCENE", settings.scene,
                    "USD file (.usda, .usdc, .usd, .usdz) or model (glTF, OBJ, FBX ...) to light")
        ->required();
    addMeshOptions(command, settings);
    addLightOptions(command, settings);
    addPlayOptions(command, settings);
    addReportOptions(command, settings);
}

RadiosityOptions resolvedOptions(const SolveSettings& settings, const LoadedScene& loaded,
                                 std::optional<double> frame) {
    RadiosityOptions options;
    options.solving = settings.solver;
    return optionsFor(lightSettings(settings.scene, loaded, frame, settings.asked), options);
}

ProgressBar::When whenToShowProgress(const SolveSettings& settings) {
    return settings.quiet      ? ProgressBar::When::never
           : settings.progress ? ProgressBar::When::always
                               : ProgressBar::When::terminal;
}

FrameRange frameRange(const std::string& text) {
    FrameRange range;
    const char* const end = text.data() + text.size();
    std::from_chars_result read = std::from_chars(text.data(), end, range.first);
    range.last = range.first;
    if (read.ec == std::errc() && read.ptr != end && *read.ptr == ':')
        read = std::from_chars(read.ptr + 1, end, range.last);
    if (read.ec != std::errc() || read.ptr != end || range.last < range.first)
        throw CLI::ValidationError("--frames", fmt::format("'{}' is not A:B with A <= B", text));
    if (range.first < -kFarthestFrame || range.last > kFarthestFrame ||
        range.last - range.first >= kMostFrames)
        throw CLI::ValidationError("--frames",
                                   fmt::format("'{}': {} frames are played at most, none beyond {}",
                                               text, kMostFrames, kFarthestFrame));
    return range;
}

std::string numberedPath(const std::string& pattern, int frame) {
    const std::size_t last = pattern.rfind('#');
    if (last == std::string::npos) return pattern;
    std::size_t first = last;
    while (first > 0 && pattern[first - 1] == '#') --first;
    return fmt::format("{}{:0{}}{}", pattern.substr(0, first), frame, last - first + 1,
                       pattern.substr(last + 1));
}

void checkNumbered(const std::string& pattern, const std::string& frames) {
    if (pattern.empty() || frames.empty()) return;
    const FrameRange range = frameRange(frames);
    if (range.first != range.last && pattern.find('#') == std::string::npos)
        throw CLI::ValidationError(pattern,
                                   "every frame would overwrite the one before: name it "
                                   "frame.####" +
                                       std::filesystem::path(pattern).extension().string());
}

void reportDiagnostics(const std::vector<Diagnostic>& diagnostics, bool verbose) {
    if (diagnostics.empty()) return;
    if (!verbose) {
        std::fprintf(stderr, "%s (--verbose says all)\n", summary(diagnostics).c_str());
        return;
    }
    for (const Diagnostic& diagnostic : diagnostics)
        std::fprintf(stderr, "%s\n", diagnostic.line().c_str());
}

namespace {

/// In one line: what is in the scene instead, which is warned of last, and what was warned of
/// first.
std::string whyNothingToLight(const std::vector<Diagnostic>& warnings) {
    std::string why = "nothing to light: ";
    why += warnings.empty() ? "no visible mesh that can be read" : warnings.back().text;
    if (warnings.size() > 1) why += "; first warning: " + warnings.front().text;
    return why;
}

void addCosts(SolveStatistics& sum, const SolveStatistics& s) {
    sum.shots += s.shots;
    sum.direct += s.direct;
    sum.indirect += s.indirect;
    sum.detail += s.detail;
}

} // namespace

MeshingOptions sizesToLight(const MeshingOptions& meshing, const PlacedScene& placed) {
    if (hasLights(placed)) return meshing;
    constexpr float kShare = 1.0f / 64; // of the scene
    const float size = kShare * placed.bounds.diagonal();
    return {.patchSize = meshing.patchSize > 0 ? meshing.patchSize : size,
            .elementSize = meshing.elementSize > 0 ? meshing.elementSize : size,
            .backdropArea = meshing.backdropArea};
}

SceneSolution::PhaseTimer::PhaseTimer(double& sum) : sum_(sum), start_(steadySeconds()) {}
SceneSolution::PhaseTimer::~PhaseTimer() {
    sum_ += steadySeconds() - start_;
}

SceneSolution::SceneSolution(const SolveSettings& settings)
    : settings_(settings), progress_(whenToShowProgress(settings)) {
    progress_.show("reading", 0);
    LoadOptions options;
    options.allowOutside = settings.allowOutside;
    options.time = settings.frame;
    if (!settings.frames.empty()) options.time = frameRange(settings.frames).first;
    loaded_ = timed("read", [&] { return loadUsdScene(settings.scene, options); });
    progress_.clear();
    checkOutputs(loaded_.files, settings.outputs);
    placed_ = placeScene(*loaded_.scene);
    if (placed_.meshes.empty() && placed_.lights.empty())
        throw SceneFileError({settings.scene}, whyNothingToLight(loaded_.diagnostics));
    if (!settings.quiet) reportDiagnostics(loaded_.diagnostics, settings.verbose);
    const bool asksTime = settings.frame || !settings.frames.empty();
    if (asksTime && !loaded_.animation && !settings.quiet)
        fmt::print(stderr, "{}: warning: nothing in it moves: its frames are all alike\n",
                   settings.scene);
    const double start = steadySeconds();
    const RadiosityOptions resolved =
        timed("read", [&] { return resolvedOptions(settings, loaded_, options.time); });
    solving_ = resolved.solving;
    // What is played may get lights later.
    mesh(settings.frames.empty() ? sizesToLight(resolved.meshing, placed_) : resolved.meshing);
    light();
    if (settings.frames.empty()) return;
    const SolveStatistics s = solver().statistics();
    frames_.push_back({double(frameRange(settings.frames).first), 0, true, s.shots, s.certificate,
                       steadySeconds() - start, s.state, s.direct, s.indirect, s.detail});
}

void SceneSolution::mesh(const MeshingOptions& meshing) {
    progress_.show("meshing", 0);
    timed("mesh", [&] {
        try {
            const bool isFollowed = !settings_.frames.empty() && !settings_.fromScratch;
            lit_ = std::make_unique<LitScene>(
                placed_, meshing, solving_, isFollowed,
                [&](const char* phase, double done) { progress_.show(phase, done); });
        } catch (const Error& error) {
            progress_.clear();
            throw SceneFileError({settings_.scene}, error.what());
        }
    });
    progress_.clear();
    sayWarnings();
}

/// What was noticed while meshing: each once, however many frames are played.
void SceneSolution::sayWarnings() {
    for (const std::string& warning : lit_->warnings())
        if (said_.insert(warning).second && !settings_.quiet)
            std::fprintf(stderr, "%s: warning: %s\n", settings_.scene.c_str(), warning.c_str());
}

void SceneSolution::light() {
    double& solving = phases_["solve"];
    const double before = solver().detailSeconds();
    timed("solve", [&] {
        lit_->solver().settle([&](const char* phase, double done) {
            progress_.show(phase, done);
            warnOfMemory();
        });
    });
    const double detailing = solver().detailSeconds() - before;
    solving -= detailing; // a phase of its own
    if (!settings_.solver.directOnly) phases_["detail"] += detailing;
    lighting_ = timed("light", [&] { return solver().lighting(); });
    progress_.clear();
    const SolveStatistics s = solver().statistics();
    if (!settings_.quiet && s.state == SolutionState::working)
        std::fprintf(
            stderr,
            "%s: warning: so many patches (%zu) that relaxation was stopped after %llu shots; an "
            "ambient estimate replaces the rest (--residual goes on to the end)\n",
            settings_.scene.c_str(), patches().patchCount(),
            static_cast<unsigned long long>(s.shots));
}

/// As soon as it is known: what follows takes long.
void SceneSolution::warnOfMemory() {
    if (settings_.quiet || memoryWarned_) return;
    const std::string warning = memoryWarning(solver(), patches());
    memoryWarned_ = !warning.empty();
    if (!memoryWarned_) return;
    progress_.clear();
    fmt::print(stderr, "{}: warning: {}\n", settings_.scene, warning);
}

void SceneSolution::warn() const {
    const std::string warning = certificateWarning(statistics());
    if (!settings_.quiet && !warning.empty())
        fmt::print(stderr, "{}: warning: {}\n", settings_.scene, warning);
}

SolveStatistics SceneSolution::statistics() const {
    SolveStatistics all = solver().statistics();
    addCosts(all, earlier_);
    return all;
}

LitScene::Followed SceneSolution::follow() {
    try {
        LitScene::Followed followed = lit_->follow(placed_);
        sayWarnings();
        return followed;
    } catch (const Error& error) {
        throw SceneFileError({settings_.scene}, error.what());
    }
}

void SceneSolution::show(double frame) {
    if (loaded_.animation) loaded_.animation->setTime(frame);
    placed_ = placeScene(*loaded_.scene);
    const double start = steadySeconds();
    FrameCost cost;
    SolveStatistics before = solver().statistics();
    if (settings_.fromScratch) {
        cost.rebuilt = true;
        mesh(sizesOf(patches()));
    } else {
        const LitScene::Followed followed = follow();
        cost.rebuilt = followed.rebuilt;
        cost.edits = followed.change.objects.size() + followed.change.emitters.size() +
                     followed.change.colours;
    }
    if (cost.rebuilt) {
        addCosts(earlier_, before);
        before = {};
    }
    light();
    const SolveStatistics after = solver().statistics();
    cost.frame = frame;
    cost.seconds = steadySeconds() - start;
    cost.shots = after.shots - before.shots;
    cost.certificate = after.certificate;
    cost.state = after.state;
    cost.direct = after.direct - before.direct;
    cost.indirect = after.indirect - before.indirect;
    cost.detail = after.detail - before.detail;
    frames_.push_back(cost);
}

} // namespace penumbra
