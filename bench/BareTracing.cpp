#include "bench/BareTracing.h"

#include "base/Parallel.h"
#include "bench/BenchScene.h"
#include "radiosity/rows/Row.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace penumbra {

namespace {

constexpr std::size_t kChunk = 64; ///< blocks of receivers whose rays are stored at a time

/// A packet as Embree takes it.
struct EmbreePacket {
    alignas(64) int valid[16];
    alignas(64) RTCRay16 rays;
};

} // namespace

struct BareTracing::EmbreeScene {
    // Not "threads=1": Embree on TBB then limits every parallel loop of the process to one thread.
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    float margin = 0; ///< segments end this much before their target [m], as RayScene's do

    explicit EmbreeScene(const PatchSet& set) : margin(2e-5f * set.bounds.diagonal()) {
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
        for (const RayMesh& mesh : set.rayMeshes) {
            if (mesh.triangles.empty()) continue;
            RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
            void* vertices =
                rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        sizeof(glm::vec3), mesh.vertices.size());
            void* triangles =
                rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        3 * sizeof(std::uint32_t), mesh.triangles.size());
            std::ranges::copy(mesh.vertices, static_cast<glm::vec3*>(vertices));
            std::ranges::copy(mesh.triangles,
                              static_cast<std::array<std::uint32_t, 3>*>(triangles));
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcReleaseGeometry(geometry);
        }
        rtcCommitScene(scene);
    }
    ~EmbreeScene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    EmbreePacket packet(const ShadowRays& rays) const {
        EmbreePacket out{};
        for (unsigned i = 0; i < 16; ++i) {
            const bool used = rays.used >> i & 1;
            out.valid[i] = used ? -1 : 0;
            if (!used) continue;
            const glm::vec3 d(rays.directionX[i], rays.directionY[i], rays.directionZ[i]);
            out.rays.org_x[i] = rays.originX[i];
            out.rays.org_y[i] = rays.originY[i];
            out.rays.org_z[i] = rays.originZ[i];
            out.rays.dir_x[i] = d.x, out.rays.dir_y[i] = d.y, out.rays.dir_z[i] = d.z;
            out.rays.tfar[i] = 1 - std::max(1e-4f, margin / std::max(glm::length(d), 1e-30f));
            out.rays.mask[i] = 0xffffffffu;
            out.rays.id[i] = i;
        }
        return out;
    }
};

BareTracing::BareTracing(const PatchSet& patches, const RayScene& rays,
                         const SolverOptions& options)
    : set_(patches), rays_(rays), walls_(patches), embree_(std::make_unique<EmbreeScene>(patches)) {
    const int base = std::min(options.samples, RowBlock::kSize);
    for (const Emitter& emitter : set_.emitters)
        senders_.emplace_back(emitter, base, std::min(4 * base, RowBlock::kSize));
}

BareTracing::~BareTracing() = default;

/// The rays that EmitterRowBuilder decides to take, by the same rules.
BareTracing::Packets BareTracing::packetsOf(std::size_t firstReceiver,
                                            std::size_t lastReceiver) const {
    Packets packets;
    SampleGroup group;
    Bounds box;
    if (set_.isBlended(std::uint32_t(firstReceiver / RowBlock::kSize))) return packets;
    for (std::size_t r = firstReceiver; r < lastReceiver; ++r)
        if (!isPadding(set_.vertices[r].receiver)) box.add(set_.vertices[r].receiver.position);
    for (const EmitterSender& sender : senders_) {
        if (walls_.between(sender.box(), box).valid()) continue;
        const std::vector<std::uint32_t> walls = walls_.beside(sender.box(), box);
        for (std::size_t r = firstReceiver; r < lastReceiver; ++r) {
            const Receiver& receiver = set_.vertices[r].receiver;
            if (std::ranges::any_of(walls, [&](std::uint32_t wall) {
                    return walls_.isHidden(wall, sender.box(), receiver.position);
                }))
                continue;
            const float factor = sender.formFactor(receiver);
            if (!(factor > 0)) continue;
            const int base = factor > 0.15f ? sender.allSamples() : sender.baseSamples();
            bool seen = false, blocked = false;
            for (int first = 0, count = base; first < count; first += 16) {
                sender.sampleGroup(receiver, first, group);
                if (group.rays.used == 0) continue;
                packets.push_back(group.rays);
                rays_.occluded(group.rays);
                for (int i = 0; i < 16; ++i)
                    if (group.rays.used >> i & 1)
                        (group.rays.blocker[i] == ObjectId::kNone ? seen : blocked) = true;
                if (first + 16 == base && seen && blocked) count = sender.allSamples();
            }
        }
    }
    return packets;
}

BareTracing::Seconds BareTracing::measure() const {
    Seconds sum;
    const std::size_t receivers = set_.vertices.size(), size = RowBlock::kSize;
    const std::size_t blocks = (receivers + size - 1) / size;
    std::vector<Packets> chunk(kChunk);
    std::vector<std::vector<EmbreePacket>> bare(kChunk);
    for (std::size_t base = 0; base < blocks; base += kChunk) {
        const std::size_t count = std::min(kChunk, blocks - base);
        const auto inParallel = [&](auto work) {
            const Stopwatch watch;
            parallelFor(count, 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t b = first; b < last; ++b) work(b);
            });
            return std::pair(watch.wall(), watch.cpu());
        };
        inParallel([&](std::size_t b) {
            const std::size_t first = (base + b) * size;
            chunk[b] = packetsOf(first, std::min(receivers, first + size));
            bare[b].clear();
            for (const ShadowRays& rays : chunk[b]) bare[b].push_back(embree_->packet(rays));
        });
        for (std::size_t b = 0; b < count; ++b)
            for (const ShadowRays& rays : chunk[b]) sum.rays += unsigned(std::popcount(rays.used));

        const auto [wall, cpu] = inParallel([&](std::size_t b) {
            for (ShadowRays& rays : chunk[b]) rays_.occluded(rays);
        });
        sum.rayScene += wall, sum.rayCpu += cpu;
        const auto [bareWall, bareCpu] = inParallel([&](std::size_t b) {
            for (EmbreePacket& packet : bare[b]) {
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                rtcOccluded16(packet.valid, embree_->scene, &context, &packet.rays);
            }
        });
        sum.embree += bareWall, sum.embreeCpu += bareCpu;
    }
    return sum;
}

} // namespace penumbra
