// What render and solve have in common: options, and the way from a file to a solution.
#pragma once

#include "base/LightRequest.h"
#include "io/usd/scene/UsdScene.h"
#include "radiosity/process/RadiosityOptions.h"
#include "radiosity/transport/LitScene.h"
#include "scenegraph/Objects.h"
#include "tools/ProgressBar.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace penumbra {

inline constexpr int kMostFrames = 100'000;          ///< more than an hour, 25 a second
inline constexpr int kFarthestFrame = 1'000'000'000; ///< frames are counted in int

/// Frames to play, in steps of one.
struct FrameRange {
    int first = 0, last = 0;
};

/// Options shared by the commands that solve.
struct SolveSettings {
    std::string scene;
    std::optional<double> frame;
    std::string frames; ///< as it was given; empty: one frame
    bool fromScratch = false;
    LightRequest asked;   ///< see lightSettings()
    SolverOptions solver; ///< but for what is in `asked`
    unsigned threads = 0;
    std::string stats;
    std::vector<std::string> outputs; ///< names of all results: none may be a layer of the scene
    bool verbose = false;
    bool allowOutside = false; ///< what the scene names is opened wherever it lies
    bool progress = false;
    bool quiet = false;
};

/// Adds `--memory`. \param bytes see SolverOptions; must outlive the parsing
void addMemoryOption(CLI::App& command, std::size_t& bytes);

/// Adds the shared options to a command; `settings` must outlive the parsing.
void addSolveOptions(CLI::App& command, SolveSettings& settings);

/// What is asked for, else what the file asks for, else the defaults: see lightSettings().
RadiosityOptions resolvedOptions(const SolveSettings& settings, const LoadedScene& loaded,
                                 std::optional<double> frame);

/// As `--progress` and `--quiet` say.
ProgressBar::When whenToShowProgress(const SolveSettings& settings);

/// Sizes to mesh a scene with: those, but where there is no light and sizes are not asked for,
/// coarse ones. What stands in for lights then throws no shadow and is smooth.
MeshingOptions sizesToLight(const MeshingOptions& meshing, const PlacedScene& placed);

/// Reads "A:B" or "A": at most kMostFrames, none farther from 0 than kFarthestFrame. \throws
/// CLI::ValidationError
FrameRange frameRange(const std::string& text);
/// Replaces the last run of '#' in a file name by a frame's number.
std::string numberedPath(const std::string& pattern, int frame);
/// Refuses a name that would be written again and again. \throws CLI::ValidationError
void checkNumbered(const std::string& pattern, const std::string& frames);

/// Of a scene, for people.
inline constexpr std::string_view kNoLights = "nothing in it gives light that is understood";

/// Prints to standard error what the reader had to say: one summary line, or every line.
void reportDiagnostics(const std::vector<Diagnostic>& diagnostics, bool verbose);

/// What one frame of an animation cost.
struct FrameCost {
    double frame = 0;
    std::size_t edits = 0; ///< objects, lights and colours that are not as in the frame before
    bool rebuilt = false;  ///< the scene was meshed anew
    std::uint64_t shots = 0;
    double certificate = 0; ///< [lm/m^2]
    double seconds = 0;     ///< from the edit to its light, exact
    SolutionState state = SolutionState::working;
    WorkCount direct, indirect, detail;
};

/// A scene, read, meshed and lit, and what its animation makes of it.
class SceneSolution {
public:
    /// Lights the frame that is asked for, or the first one.
    explicit SceneSolution(const SolveSettings& settings);

    /// Goes to a frame: incrementally, unless `--from-scratch` was given.
    void show(double frame);

    const Scene& scene() const { return *loaded_.scene; }
    const PlacedScene& placed() const { return placed_; }
    const PatchSet& patches() const { return lit_->patches(); }
    const RayScene& rays() const { return lit_->rays(); }
    const Solver& solver() const { return lit_->solver(); }
    /// The solver's, with what all frames cost, also those after which it began anew.
    SolveStatistics statistics() const;
    const Lighting& lighting() const { return lighting_; }
    const std::vector<FrameCost>& frames() const { return frames_; } ///< if frames are played
    ProgressBar& progress() { return progress_; }
    /// Says on standard error what makes the solution unreliable, unless it is to be quiet.
    void warn() const;

    /// Runs `work` and adds its time to the phase of that name.
    template <class Work>
    auto timed(const std::string& phase, Work work) {
        const PhaseTimer timer(phases_[phase]);
        return work();
    }
    const std::map<std::string, double>& phases() const { return phases_; } ///< [s]

private:
    /// Adds the time of a block to a sum.
    class PhaseTimer {
    public:
        explicit PhaseTimer(double& sum);
        ~PhaseTimer();

    private:
        double& sum_;
        double start_;
    };

    void mesh(const MeshingOptions& meshing);
    void sayWarnings();
    LitScene::Followed follow();
    void light();
    void warnOfMemory();

    const SolveSettings& settings_;
    SolverOptions solving_;
    ProgressBar progress_;
    std::map<std::string, double> phases_;
    LoadedScene loaded_;
    PlacedScene placed_;
    std::unique_ptr<LitScene> lit_;
    Lighting lighting_;
    bool memoryWarned_ = false;  ///< once, whatever is played
    std::set<std::string> said_; ///< warnings, likewise
    SolveStatistics earlier_;    ///< costs alone: of solvers that were given up
    std::vector<FrameCost> frames_;
};

} // namespace penumbra
