// The queue of work: keying it anew when the camera turns, taking from it, adding to it.
#include "importance/Priority.h"
#include "importance/ReceiverClusters.h"
#include "importance/WorkQueue.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace penumbra {

namespace {

constexpr std::uint32_t kSenders = 8;

/// Blocks on the six sides of a room of 8 x 8 x 4 m, side by side, and a task of some size on
/// each for every sender.
struct Room {
    ReceiverClusters clusters;
    std::vector<WorkQueue::Task> tasks;

    explicit Room(std::size_t count) {
        const std::size_t blocks = (count + kSenders - 1) / kSenders;
        std::vector<ReceiverCluster> receivers;
        std::vector<std::uint32_t> sides;
        const auto perSide = (blocks + 5) / 6;
        const auto width = std::uint32_t(std::ceil(std::sqrt(double(perSide))));
        for (std::uint32_t b = 0; b < blocks; ++b) {
            const auto side = std::uint32_t(b / perSide), at = std::uint32_t(b % perSide);
            receivers.push_back(block(side, at % width, at / width, width));
            sides.push_back(side);
        }
        clusters = clusterBlocks(receivers, sides);
        std::uint32_t random = 1;
        for (std::uint32_t t = 0; t < count; ++t) {
            random = random * 1664525 + 1013904223; // Numerical Recipes
            const float change = float(random >> 8) / float(1 << 24);
            tasks.push_back({clusters.clusterOf[t / kSenders], t, {20 * change * change, 1, 1}, 0});
        }
    }

    static ReceiverCluster block(std::uint32_t side, std::uint32_t x, std::uint32_t y,
                                 std::uint32_t n) {
        const int axis = int(side / 2);
        const float sign = side % 2 == 0 ? -1.0f : 1.0f;
        const glm::vec3 half(4, 4, 2);
        glm::vec3 u(0), v(0), normal(0);
        u[(axis + 1) % 3] = 2 * half[(axis + 1) % 3] / float(n);
        v[(axis + 2) % 3] = 2 * half[(axis + 2) % 3] / float(n);
        normal[axis] = -sign;
        glm::vec3 corner = -half;
        corner[axis] = sign * half[axis];
        ReceiverCluster cluster;
        cluster.box.add(corner + float(x) * u + float(y) * v);
        cluster.box.add(corner + float(x + 1) * u + float(y + 1) * v);
        cluster.normal = normal;
        cluster.area = glm::length(u) * glm::length(v);
        cluster.luminance = 40;
        return cluster;
    }
};

/// From the middle of the room, turned about the vertical [rad].
Attention looking(double turn) {
    glm::dmat4 camera(1.0);
    camera[0] = {std::cos(turn), std::sin(turn), 0, 0};
    camera[1] = {0, 0, 1, 0};
    camera[2] = {std::sin(turn), -std::cos(turn), 0, 0};
    Lens lens;
    lens.clippingRange = {0.1f, 100};
    const View view = makeView(lens, camera, 1280, 720);
    const Viewpoint viewpoint(view, 1280, 720);
    return {viewpoint, Gaze(viewpoint), 40, Bounds{{1, 1, -2}, {2, 2, -1}}, {}};
}

void key(WorkQueue& queue, const Room& room, double turn) {
    const Attention attention = looking(turn);
    queue.rekey(
        [&](std::uint32_t p) { return clusterPriority(room.clusters.clusters[p], attention); });
}

WorkQueue filled(const Room& room) {
    WorkQueue queue;
    for (const WorkQueue::Task& task : room.tasks) queue.add(task);
    key(queue, room, 0);
    return queue;
}

/// A camera that turns: until the first task in the new order is known.
void rekey(benchmark::State& state) {
    const Room room(std::size_t(state.range(0)));
    WorkQueue queue = filled(room);
    double turn = 0;
    for (auto _ : state) {
        key(queue, room, turn += 0.1);
        benchmark::DoNotOptimize(queue.take(0));
    }
    state.counters["places"] = double(room.clusters.clusters.size());
}

/// Adding all tasks, keying them and taking them all: what the order costs in all [a task].
void drain(benchmark::State& state) {
    const Room room(std::size_t(state.range(0)));
    for (auto _ : state) {
        WorkQueue queue = filled(room);
        while (!queue.empty()) benchmark::DoNotOptimize(queue.take(0));
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(rekey)
    ->Name("order/rekey")
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(drain)->Name("order/drain")->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

} // namespace

} // namespace penumbra
