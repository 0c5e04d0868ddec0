#include "bench/LeastRays.h"

#include "base/Parallel.h"
#include "bench/BenchScene.h"
#include "radiosity/rows/EmitterSender.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <vector>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr std::size_t kChunk = 512; ///< blocks of rows whose rays are stored at a time

/// Rays of one pair, up to 16 of them.
struct Packet {
    ShadowRays rays;
    bool alone; ///< against the moved object only
};

/// Whether a segment of a packet meets a box.
bool meets(const ShadowRays& rays, int i, const Bounds& box) {
    const double origin[] = {rays.originX[i], rays.originY[i], rays.originZ[i]};
    const double direction[] = {rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
    double first = 0, last = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = double(box.lower[axis]) - origin[axis];
        const double high = double(box.upper[axis]) - origin[axis];
        if (direction[axis] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        const double a = low / direction[axis], b = high / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

class Counter {
public:
    Counter(const PatchSet& set, int samples, const SceneChange& change)
        : set_(set), object_(change.objects.front()), box_(boundsOf(set, object_)),
          own_(set.objects.size()) {
        for (const ObjectId object : change.objects) own_[object.value] = 1;
        const int base = std::min(samples, RowBlock::kSize);
        for (const Emitter& emitter : set.emitters)
            senders_.emplace_back(emitter, base, std::min(4 * base, RowBlock::kSize));
        for (std::uint32_t v : change.vertices)
            elsewhere_[v / kBlock] |= std::uint64_t(1) << v % kBlock;
    }

    /// Counts one block of one row, and lists its rays.
    void count(std::size_t row, std::uint32_t block, const RowBlock& before, const RowBlock& after,
               LeastRays& sum, std::vector<Packet>& packets) const {
        if (before.entryCount() + after.entryCount() == 0) return;
        std::vector<RowBlock::Draft> was(kBlock), is(kBlock);
        before.decode(was);
        after.decode(is);
        const ObjectId from = set_.emitters[row].object, at = set_.vertexBlockObject[block];
        const bool self = own_[from.value] && from == at;
        const bool own = own_[from.value] || own_[at.value];
        const auto found = elsewhere_.find(block);
        const std::uint64_t elsewhere = found == elsewhere_.end() ? 0 : found->second;
        for (std::uint32_t r = 0; r < kBlock; ++r) {
            if (!(is[r].formFactor > 0)) continue;
            const Pair pair{senders_[row], set_.vertices[block * kBlock + r].receiver, was[r],
                            is[r]};
            if (self) {
                ++sum.selfEntries;
                sum.selfRays += takeAll(pair, 0, nullptr);
            } else if (own) {
                ++sum.ownEntries;
                sum.own += takeAll(pair, 0, &packets);
            } else if (elsewhere >> r & 1 || !(was[r].formFactor > 0)) {
                sum.uncovered += takeAll(pair, 0, &packets);
            } else {
                takeShadows(pair, sum, packets);
            }
        }
    }

private:
    struct Pair {
        const EmitterSender& sender;
        const Receiver& receiver;
        const RowBlock::Draft &was, &is;
    };

    /// How many samples a pair has, by RowBuilder's rules.
    static int taken(const EmitterSender& sender, const RowBlock::Draft& draft) {
        const bool disagree = draft.visible != 0 && draft.blockerCount != 0;
        return disagree || draft.formFactor > 0.15f ? sender.allSamples() : sender.baseSamples();
    }

    static std::uint64_t takeAll(const Pair& pair, int from, std::vector<Packet>* packets) {
        std::uint64_t rays = 0;
        for (int first = from; first < taken(pair.sender, pair.is); first += 16) {
            SampleGroup group;
            pair.sender.sampleGroup(pair.receiver, first, group);
            rays += unsigned(std::popcount(group.rays.used));
            if (packets && group.rays.used != 0) packets->push_back({group.rays, false});
        }
        return rays;
    }

    void takeShadows(const Pair& pair, LeastRays& sum, std::vector<Packet>& packets) const {
        std::uint64_t blocked = 0; // by the object
        for (int b = 0; b < pair.was.blockerCount; ++b)
            if (pair.was.blockers[std::size_t(b)].object == object_.value)
                blocked = pair.was.blockers[std::size_t(b)].samples;
        const int count = taken(pair.sender, pair.was);
        for (int first = 0; first < count && (blocked | pair.was.visible) != 0; first += 16) {
            SampleGroup group;
            pair.sender.sampleGroup(pair.receiver, first, group);
            const std::uint32_t used = group.rays.used;
            std::uint32_t met = 0;
            for (int i = 0; i < 16; ++i)
                if (used >> i & 1 && pair.was.visible >> (first + i) & 1 &&
                    meets(group.rays, i, box_))
                    met |= 1u << i;
            const std::uint32_t released = used & std::uint32_t(blocked >> first) & 0xffffu;
            sum.met += unsigned(std::popcount(met));
            sum.released += unsigned(std::popcount(released));
            if (group.rays.used = met; met != 0) packets.push_back({group.rays, true});
            if (group.rays.used = released; released != 0) packets.push_back({group.rays, false});
        }
        sum.refined += takeAll(pair, count, &packets);
    }

    const PatchSet& set_;
    ObjectId object_;
    Bounds box_;
    std::vector<std::uint8_t> own_; ///< by object
    std::vector<EmitterSender> senders_;
    std::unordered_map<std::uint32_t, std::uint64_t> elsewhere_; ///< vertices, block by block
};

LeastRays& operator+=(LeastRays& sum, const LeastRays& other) {
    sum.own += other.own;
    sum.uncovered += other.uncovered;
    sum.released += other.released;
    sum.met += other.met;
    sum.refined += other.refined;
    sum.ownEntries += other.ownEntries;
    sum.selfEntries += other.selfEntries;
    sum.selfRays += other.selfRays;
    return sum;
}

} // namespace

LeastRays leastRays(const PatchSet& set, const RayScene& rays, int samples,
                    const SceneChange& change, std::span<const Row> before,
                    std::span<const Row> after) {
    const Counter counter(set, samples, change);
    const RowBlock none;
    std::vector<LeastRays> counts(kChunk);
    std::vector<std::vector<Packet>> packets(kChunk);
    LeastRays sum;
    const auto trace = [&] {
        std::vector<Packet> all;
        for (auto& some : packets) all.insert(all.end(), some.begin(), some.end()), some.clear();
        const Stopwatch watch;
        parallelFor(all.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                all[i].alone ? rays.occludedBy(change.objects.front(), all[i].rays)
                             : rays.occluded(all[i].rays);
        });
        sum.wall += watch.wall(), sum.cpu += watch.cpu();
    };
    for (std::size_t row = 0; row < after.size(); ++row)
        for (std::size_t base = 0; base < after[row].size(); base += kChunk) {
            const std::size_t count = std::min(kChunk, after[row].size() - base);
            parallelFor(count, 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    const std::size_t b = base + i;
                    counts[i] = {};
                    counter.count(row, std::uint32_t(b),
                                  b < before[row].size() ? before[row][b] : none, after[row][b],
                                  counts[i], packets[i]);
                }
            });
            for (std::size_t i = 0; i < count; ++i) sum += counts[i];
            trace();
        }
    return sum;
}

} // namespace penumbra
