#include "bench/MoveRun.h"

#include "base/Error.h"
#include "bench/BenchScene.h"

#include <algorithm>

namespace penumbra {

MoveRun::MoveRun(const Move& move, const MeshingOptions& meshing, const SolverOptions& options,
                 int copies)
    : scene_(move, copies), options_(options) {
    scene_.put(Pose::there);
    const PlacedScene placed = scene_.placed();
    MeshingOptions sizes = meshing;
    if (sizes.patchSize == 0) sizes.patchSize = meshingOf(scene_.asked(), 0).patchSize;
    const Stopwatch building;
    lit_ = std::make_unique<LitScene>(placed, sizes, options);
    meshing_ = building.wall();
    const Stopwatch solving;
    lit_->solver().settle(SolutionState::certified);
    certify_ = solving.wall();
    lit_->solver().settle();
    solve_ = {solving.wall(), solving.cpu()};
    statistics_ = lit_->solver().statistics();
}

MoveCost MoveRun::go(Pose place) {
    scene_.put(place);
    MoveCost cost;
    const Stopwatch all;
    const PlacedScene placed = scene_.placed();
    cost.place = all.wall();
    LitScene::Followed followed = lit_->follow(placed);
    cost.follow = all.wall() - cost.place;
    lit_->solver().settle(SolutionState::certified);
    cost.certify = all.wall() - cost.place - cost.follow;
    const double certifiedCpu = all.cpu();
    cost.certified = lit_->solver().statistics();
    cost.certified.direct = cost.certified.direct - statistics_.direct;
    cost.certified.indirect = cost.certified.indirect - statistics_.indirect;
    const Stopwatch rest; // counting is no part of the move
    lit_->solver().settle();
    cost.settle = cost.certify + rest.wall();
    cost.cpu = certifiedCpu + rest.cpu();
    if (followed.rebuilt) throw Error("the move made the scene be meshed anew");
    cost.change = std::move(followed.change);
    const SolveStatistics now = lit_->solver().statistics();
    cost.direct = now.direct - statistics_.direct;
    cost.indirect = now.indirect - statistics_.indirect;
    cost.shots = now.shots - statistics_.shots;
    statistics_ = now;
    return cost;
}

Seconds MoveRun::fromScratch(std::unique_ptr<Solver>& solver) const {
    solver.reset();
    const Stopwatch all;
    solver = std::make_unique<Solver>(lit_->patches(), lit_->rays(), options_);
    solver->settle();
    return {all.wall(), all.cpu()};
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

RowSize sizeOf(std::span<const Row> rows) {
    RowSize sum;
    for (const Row& row : rows) {
        const RowSize size = sizeOf(row);
        sum.entries += size.entries;
        sum.bytes += size.bytes;
    }
    return sum;
}

std::string firstDifference(std::span<const Row> a, std::span<const Row> b) {
    for (std::size_t row = 0; row < a.size(); ++row)
        for (std::size_t block = 0; block < std::min(a[row].size(), b[row].size()); ++block)
            if (!a[row][block].sameMasks(b[row][block]))
                return "row " + std::to_string(row) + ", block " + std::to_string(block);
    return "";
}

} // namespace penumbra
