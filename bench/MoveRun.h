// A lit scene in which something is moved, and what each move costs.
#pragma once

#include "bench/MovedScene.h"
#include "radiosity/transport/LitScene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace penumbra {

/// What one move cost, from the edited graph to the settled light.
struct MoveCost {
    double place = 0;          ///< placeScene(): the walk over the graph, wall [s]
    double follow = 0;         ///< LitScene::follow(): diff, placement, refit, coverage, wall [s]
    double certify = 0;        ///< until the state is `certified`, wall [s]
    double settle = 0;         ///< until it is `exact`, that included, wall [s]
    double cpu = 0;            ///< of all of that, processor time [s]
    SolveStatistics certified; ///< when it was; counts are those of the move
    WorkCount direct, indirect;
    std::uint64_t shots = 0;
    SceneChange change;

    double wall() const { return place + follow + settle; }
    double wallToCertified() const { return place + follow + certify; }
};

/// Wall and processor time [s].
struct Seconds {
    double wall = 0, cpu = 0;
};

/// Keeps the scene of a Move lit. It begins with the object `there`.
class MoveRun {
public:
    using Pose = MovedScene::Pose;

    /// \param meshing a patch size of 0 means what the file asks for, or the default
    MoveRun(const Move& move, const MeshingOptions& meshing, const SolverOptions& options,
            int copies = 1);

    /// Moves and settles. \throws Error if the scene was meshed anew
    MoveCost go(Pose place);
    /// Solves the scene as it is anew: same meshes, same rays, empty rows.
    Seconds fromScratch(std::unique_ptr<Solver>& solver) const;

    const LitScene& lit() const { return *lit_; }
    double meshing() const { return meshing_; }        ///< wall [s]
    Seconds firstSolve() const { return solve_; }      ///< from scratch as well
    double firstCertified() const { return certify_; } ///< part of it: until certified, wall [s]
    const SolveStatistics& statistics() const { return statistics_; } ///< now

private:
    MovedScene scene_;
    SolverOptions options_;
    std::unique_ptr<LitScene> lit_;
    double meshing_ = 0, certify_ = 0;
    Seconds solve_;
    SolveStatistics statistics_;
};

/// The middle one; the upper one of two.
double median(std::vector<double> values);

/// Total of some rows.
RowSize sizeOf(std::span<const Row> rows);

/// The first block, row by row, in which two solutions do not see the same, as text; empty: none.
std::string firstDifference(std::span<const Row> a, std::span<const Row> b);

} // namespace penumbra
