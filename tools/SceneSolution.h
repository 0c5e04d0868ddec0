// What render and solve have in common: options, and the way from a file to a solution.
#pragma once

#include "io/UsdScene.h"
#include "radiosity/BuildPatches.h"
#include "radiosity/LitSurface.h"
#include "radiosity/RayScene.h"
#include "radiosity/Solver.h"
#include "scenegraph/Objects.h"
#include "tools/ProgressBar.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace penumbra {

/// Options shared by the commands that solve.
struct SolveSettings {
    std::string scene;
    std::optional<double> frame;
    MeshingOptions meshing;
    SolverOptions solver;
    unsigned threads = 0;
    std::string stats;
    bool verbose = false;
    bool progress = false;
    bool quiet = false;
};

/// Adds the shared options to a command; `settings` must outlive the parsing.
void addSolveOptions(CLI::App& command, SolveSettings& settings);

/// Fails before the work when a result could not be written after it: no such folder, a folder in
/// its place; or when it would take the place of the scene or of another result (a wrong command
/// line). \param outputs paths, empty ones are left out \throws Error, CLI::ValidationError
void checkOutputs(const std::string& scene, const std::vector<std::string>& outputs);

/// Prints to standard error what the reader had to say: one summary line, or every line.
void reportDiagnostics(const std::vector<Diagnostic>& diagnostics, bool verbose);

/// A scene, read, meshed and solved.
class SceneSolution {
public:
    explicit SceneSolution(const SolveSettings& settings);

    const Scene& scene() const { return *loaded_.scene; }
    const PlacedScene& placed() const { return placed_; }
    const PatchSet& patches() const { return built_.patches; }
    const RayScene& rays() const { return *rays_; }
    const Solver& solver() const { return *solver_; }
    const Lighting& lighting() const { return lighting_; }
    ProgressBar& progress() { return progress_; }

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

    ProgressBar progress_;
    std::map<std::string, double> phases_;
    LoadedScene loaded_;
    PlacedScene placed_;
    BuiltPatches built_;
    std::unique_ptr<RayScene> rays_;
    std::unique_ptr<Solver> solver_;
    Lighting lighting_;
};

} // namespace penumbra
