// What pieces of the scheduler's work cost, in the time of a visibility ray:
// radiosity/schedule/WorkCosts.h.
#include "bench/BenchScene.h"
#include "radiosity/rows/RowBuilder.h"
#include "radiosity/schedule/ChangeProbe.h"
#include "radiosity/schedule/DirtySet.h"
#include "radiosity/schedule/WorkCosts.h"
#include "radiosity/transport/IndirectSenders.h"

#include <benchmark/benchmark.h>

#include <bit>
#include <string>
#include <vector>

namespace penumbra {

namespace {

constexpr std::uint64_t kAll = ~std::uint64_t(0);
constexpr std::size_t kStride = 7; ///< of blocks and patches: one of so many is worked on

/// A room with its rays, and the blocks of its vertices and nodes.
struct Room {
    PatchSet set;
    RayScene rays;
    std::vector<EmitterSender> emitters;
    std::vector<Receiver> vertices;
    std::vector<std::uint32_t> nodeKeys;
    IndirectSenders patches;
    std::vector<MovedObject> moved; ///< a thing that may be moved, where it is

    Room(const std::string& scene, float elementSize)
        : set(BenchScene(scene).mesh(elementSize).patches), rays(set.rayMeshes, set.skin),
          patches(set, 0) {
        for (const Emitter& emitter : set.emitters) emitters.emplace_back(emitter, 16, 64);
        for (const Vertex& vertex : set.vertices) vertices.push_back(vertex.receiver);
        for (std::uint32_t n = 0; n < set.nodes.size(); ++n)
            nodeKeys.push_back(addressOfNode(set, n));
        for (std::uint32_t o = 0; o < set.objects.size() && moved.empty(); ++o) {
            if (boundsOf(set.rayMeshes[o]).diagonal() > 0.5f * set.bounds.diagonal()) continue;
            moved.push_back({o, true, boundsOf(set.rayMeshes[o])});
            rays.move(ObjectId{o}, set.rayMeshes[o].vertices); // to where it is: from now on
            rays.commit();                                     // it can be traced alone
        }
    }
    static Bounds boundsOf(const RayMesh& mesh) {
        Bounds bounds;
        for (glm::vec3 vertex : mesh.vertices) bounds.add(vertex);
        return bounds;
    }
    ReceiverBlock vertexBlock(std::size_t block) const {
        return {std::span(vertices).subspan(block * PatchSet::kBlock, PatchSet::kBlock), kAll};
    }
    ReceiverBlock nodeBlock(std::size_t block) const {
        return {std::span(set.nodes).subspan(block * PatchSet::kBlock, PatchSet::kBlock), kAll,
                std::span(nodeKeys).subspan(block * PatchSet::kBlock, PatchSet::kBlock)};
    }
};

/// Times calls of work(i) for i from 0 to `count`. \return each [s]
template <class Work>
double timed(std::size_t count, Work work) {
    const Stopwatch watch;
    for (std::size_t i = 0; i < count; ++i) work(i);
    return watch.cpu() / double(std::max<std::size_t>(count, 1));
}

/// A visibility ray, of those that emitters and vertices take [s].
double raySeconds(const Room& room) {
    std::size_t count = 0;
    SampleGroup group;
    const Stopwatch watch;
    for (std::size_t v = 0; v < room.vertices.size(); v += kStride)
        for (const EmitterSender& emitter : room.emitters) {
            if (isPadding(room.vertices[v])) continue;
            emitter.sampleGroup(room.vertices[v], 0, group);
            count += std::size_t(std::popcount(group.rays.used));
            room.rays.occluded(group.rays);
        }
    return watch.cpu() / double(std::max<std::size_t>(count, 1));
}

/// Costs as counters, each beside the constant that represents it.
class Costs {
public:
    Costs(const Room& room, benchmark::UserCounters& counters)
        : room_(room), counters_(counters), ray_(raySeconds(room)), builder_(room.rays) {
        counters_["ray_ns"] = 1e9 * ray_;
    }

    /// Entries, visits and probes of one in kStride blocks of all emitters' rows.
    void direct() {
        const std::size_t blocks = room_.vertices.size() / PatchSet::kBlock / kStride;
        std::vector<RowBlock> rows(blocks * room_.emitters.size());
        const auto emitter = [&](std::size_t i) -> const EmitterSender& {
            return room_.emitters[i / blocks];
        };
        const auto block = [&](std::size_t i) { return room_.vertexBlock(i % blocks * kStride); };
        const double entries = timed(rows.size(), [&](std::size_t i) {
            builder_.emitters.update(emitter(i), block(i), kAll, {}, rows[i]);
        });
        note("direct_entry", entries / PatchSet::kBlock, cost::kDirectEntry);
        ChangeProbe probe(room_.rays);
        const double probes = timed(rows.size(), [&](std::size_t i) {
            probe.at(emitter(i), block(i), 0, room_.moved, rows[i]);
        });
        note("probe", probes, cost::kProbe);
        const double visits = timed(rows.size(), [&](std::size_t i) {
            builder_.emitters.update(emitter(i), block(i), 0, room_.moved, rows[i]);
        });
        note("direct_visit", visits, cost::kDirectVisit);
    }

    /// Blocks of one in kStride patches' rows: built, visited, served.
    void indirect() {
        const std::size_t blocks =
            std::min<std::size_t>(16, room_.set.nodes.size() / PatchSet::kBlock);
        std::vector<RowBlock> rows(room_.patches.patchCount() / kStride * blocks);
        const auto sender = [&](std::size_t i) {
            return room_.patches.sender(std::uint32_t(i / blocks * kStride));
        };
        const auto block = [&](std::size_t i) { return room_.nodeBlock(i % blocks); };
        const double built = timed(rows.size(), [&](std::size_t i) {
            builder_.patches.build(sender(i), block(i), rows[i]);
        });
        note("build", built, cost::kBuild);
        note("indirect_entry", built / PatchSet::kBlock, cost::kIndirectEntry);
        const double visits = timed(rows.size(), [&](std::size_t i) {
            builder_.patches.update(sender(i), block(i), 0, room_.moved, rows[i]);
        });
        note("indirect_visit", visits, cost::kIndirectVisit);
        double sum = 0;
        const double served = timed(rows.size(), [&](std::size_t i) {
            rows[i].forEach([&](int, float factor) { sum += double(factor); });
        });
        benchmark::DoNotOptimize(sum);
        note("serve", served, cost::kServe);
    }

    /// Taking all of a dirty set.
    void take() {
        const std::size_t blocks = room_.vertices.size() / PatchSet::kBlock;
        DirtySet dirty(room_.emitters.size(), {cost::kDirectVisit, cost::kDirectEntry});
        dirty.setReceivers(std::vector<DirtySet::Receivers>(blocks));
        std::vector<DirtyBlock> marked;
        for (std::uint32_t b = 0; b < blocks; ++b)
            marked.push_back({.block = b, .factor = 0.1f + 0.001f * float(b % 13)});
        for (std::uint32_t row = 0; row < room_.emitters.size(); ++row) dirty.mark(row, marked);
        std::size_t steps = 2 * dirty.count();
        note("take", timed(dirty.count(), [&](std::size_t) { dirty.take(0, steps); }), cost::kTake);
    }

private:
    void note(const char* name, double seconds, double constant) {
        counters_[name] = seconds / ray_;
        counters_[std::string(name) + "_constant"] = constant;
    }

    const Room& room_;
    benchmark::UserCounters& counters_;
    double ray_; ///< [s]
    RowBuilder builder_;
};

void workCosts(benchmark::State& state, const std::string& scene, float elementSize) {
    const Room room(scene, elementSize);
    for (auto _ : state) {
        Costs costs(room, state.counters);
        costs.direct();
        costs.indirect();
        costs.take();
    }
}

const bool registered = [] {
    for (const auto& [name, scene, size] :
         {std::tuple{"office", "office-seat", 0.06f}, std::tuple{"gallery", "gallery-walk", 0.2f}})
        benchmark::RegisterBenchmark(("work_cost/" + std::string(name)).c_str(), workCosts, scene,
                                     size)
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace

} // namespace penumbra
