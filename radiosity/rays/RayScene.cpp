#include "radiosity/rays/RayScene.h"

#include "base/Bits.h"
#include "base/Error.h"
#include "base/MemoryError.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/rays/Traceable.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

/// What our filters want to know of a query.
struct QueryContext {
    RTCIntersectContext context;      // first, so that Embree's pointer is ours
    std::uint32_t* blocker = nullptr; // where to note who is in the way, one a ray
    std::uint32_t doubts = 0;         // bits: rays to which a triangle was offered that they miss
    NearestHit* nearest = nullptr;    // who judges what is met, one a ray
    RayScene::Faces faces = RayScene::Faces::both;
    std::vector<RayHit>* all = nullptr; // where to note every hit; none ends the ray

    QueryContext() {
        rtcInitIntersectContext(&context);
    } // incoherent: COHERENT is slower everywhere
};

using Corners = std::array<std::uint32_t, 3>;

/// The triangles of a geometry; it has a pointer to this.
struct Triangles {
    const glm::vec3* vertices = nullptr;
    Corners* corners = nullptr;
    std::size_t count = 0;
    std::vector<std::uint8_t> lit; ///< see RayMesh
    std::uint64_t key = 0;
    std::vector<std::pair<std::uint32_t, Corners>> leftOut; ///< triangles that can't be traced

    std::array<glm::vec3, 3> of(const Corners& triangle) const {
        return {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
    }
    std::array<glm::vec3, 3> at(std::uint32_t triangle) const { return of(corners[triangle]); }
    std::uint8_t sides(std::uint32_t triangle, RayScene::Faces faces) const {
        if (faces == RayScene::Faces::front) return kFront;
        if (faces == RayScene::Faces::both || lit.empty()) return kBothSides;
        return lit[triangle];
    }

    /// Leaves out triangles that have shrunk to a point, and takes back those that are none any
    /// more: Embree passes over a triangle whose corners lie beyond the last vertex, and the others
    /// keep their numbers. \return whether any corners have changed
    bool sift() {
        constexpr Corners kBeyond{0xffffffffu, 0xffffffffu, 0xffffffffu};
        bool changed = std::erase_if(leftOut, [&](const auto& triangle) {
            if (!isTraceable(of(triangle.second))) return false;
            corners[triangle.first] = triangle.second;
            return true;
        });
        for (std::uint32_t i = 0; i < count; ++i) {
            if (corners[i] == kBeyond || isTraceable(at(i))) continue;
            leftOut.emplace_back(i, std::exchange(corners[i], kBeyond));
            changed = true;
        }
        return changed;
    }
};

void requireThatTheyCanBeTraced(std::span<const glm::vec3> vertices) {
    if (!std::all_of(vertices.begin(), vertices.end(), canBeTraced))
        throw Error("ray tracing: part of an object is more than 1e12 m away, or nowhere "
                    "(look for a transform or points out of range)");
}

/// Whether Embree's i-th ray passes through the triangle that it reports. By rounding it may
/// pass beside it, and whether it is tried at all then depends on the hierarchy.
bool reallyPasses(const RTCFilterFunctionNArguments* args, unsigned i) {
    constexpr float kSure = 1e-3f; // farther from every edge than rounding gets
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    if (u > kSure && v > kSure && u + v < 1 - kSure) return true;
    const Triangles& of = *static_cast<const Triangles*>(args->geometryUserPtr);
    return passes({RTCRayN_org_x(args->ray, args->N, i), RTCRayN_org_y(args->ray, args->N, i),
                   RTCRayN_org_z(args->ray, args->N, i)},
                  {RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                   RTCRayN_dir_z(args->ray, args->N, i)},
                  of.at(RTCHitN_primID(args->hit, args->N, i)));
}

/// Notes the object of the hit that ends each ray, or that it is in doubt and goes on.
void noteBlocker(const RTCFilterFunctionNArguments* args) {
    auto& context = *reinterpret_cast<QueryContext*>(args->context);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const unsigned ray = RTCRayN_id(args->ray, args->N, i);
        if (reallyPasses(args, i)) {
            context.blocker[ray] = RTCHitN_geomID(args->hit, args->N, i);
        } else {
            args->valid[i] = 0;
            context.doubts |= 1u << ray;
        }
    }
}

/// What Embree's i-th ray is offered.
RayHit hitOf(const RTCFilterFunctionNArguments* args, unsigned i) {
    const unsigned n = args->N;
    RayHit hit;
    hit.distance = RTCRayN_tfar(args->ray, n, i);
    hit.object.value = RTCHitN_geomID(args->hit, n, i);
    hit.triangle = RTCHitN_primID(args->hit, n, i);
    hit.key = static_cast<const Triangles*>(args->geometryUserPtr)->key;
    hit.u = RTCHitN_u(args->hit, n, i);
    hit.v = RTCHitN_v(args->hit, n, i);
    hit.normal = {RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i),
                  RTCHitN_Ng_z(args->hit, n, i)};
    return hit;
}

/// Asks for the triangles on one ray, up to `far` times the length of its direction.
void intersect(RTCScene scene, QueryContext& context, glm::vec3 origin, glm::vec3 direction,
               float far) {
    if (!isTraceable(origin, direction) || std::isnan(far)) return;
    RTCRayHit query{};
    query.ray = {origin.x,    origin.y, origin.z, 0,           direction.x, direction.y,
                 direction.z, 0,        far,      0xffffffffu, 0,           0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context.context, &query);
}

/// Hands hits to whom they concern.
void chooseHits(const RTCFilterFunctionNArguments* args) {
    auto& context = *reinterpret_cast<QueryContext*>(args->context);
    const Triangles& of = *static_cast<const Triangles*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const RayHit hit = hitOf(args, i);
        if (context.all) {
            context.all->push_back(hit);
            args->valid[i] = 0;
            continue;
        }
        NearestHit& nearest = context.nearest[RTCRayN_id(args->ray, args->N, i)];
        if (nearest.take(of.at(hit.triangle), hit, of.sides(hit.triangle, context.faces)))
            RTCRayN_tfar(args->ray, args->N, i) = nearest.searchEnd();
        else
            args->valid[i] = 0;
    }
}

} // namespace

bool canBeTraced(glm::vec3 p) {
    constexpr float kFarthest = 1e12f; // from the origin [m]
    return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
}

struct RayScene::Impl {
    /// An object's geometry is part of the whole scene and of one of its own, made on demand.
    struct Member {
        RTCGeometry geometry = nullptr;
        Triangles triangles;
        RTCScene alone = nullptr;
        bool moved = false, shown = true;
        Bounds solid; ///< around it, if it has solid triangles [m]
    };
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    bool broken = false;
    std::deque<Member> members; // one an object; geometries point to them

    Impl() {
        // Embree builds on oneTBB's threads. A number of threads given here would limit the whole
        // process.
#ifdef PENUMBRA_STD_THREADS
        device = rtcNewDevice("threads=1"); // oneTBB stays out of a build for ThreadSanitizer
#else
        device = rtcNewDevice(nullptr);
#endif
        if (!device && rtcGetDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU)
            throw Error("ray tracing: Embree can't start on this processor (SSE2 is needed)");
        if (!device) throw MemoryError("for ray tracing");
        scene = newScene();
    }
    RTCScene newScene() const {
        RTCScene made = rtcNewScene(device);
        // Robust: no ray slips through an edge that two triangles share, which costs a seventh.
        rtcSetSceneFlags(made, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(made, RTC_BUILD_QUALITY_LOW);
        return made;
    }
    /// Embree says that something went wrong, and what it holds is half built. Its release would
    /// end the program where memory is short (it allocates, and throws in destructors): so it is
    /// left to the end of the process.
    [[noreturn]] void fail() {
        broken = true;
        throw MemoryError("for ray tracing");
    }
    ~Impl() {
        if (broken) return;
        for (const Member& member : members) {
            if (member.alone) rtcReleaseScene(member.alone);
            if (member.geometry) rtcReleaseGeometry(member.geometry);
        }
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void add(const RayMesh& mesh, unsigned id) {
        requireThatTheyCanBeTraced(mesh.vertices);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(glm::vec3), mesh.vertices.size());
        void* indices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), mesh.triangles.size());
        if (!vertices || !indices) fail();
        std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(glm::vec3));
        std::memcpy(indices, mesh.triangles.data(),
                    mesh.triangles.size() * 3 * sizeof(std::uint32_t));
        rtcSetGeometryOccludedFilterFunction(geometry, noteBlocker);
        rtcSetGeometryIntersectFilterFunction(geometry, chooseHits);
        members[id].triangles = {static_cast<const glm::vec3*>(vertices),
                                 static_cast<Corners*>(indices),
                                 mesh.triangles.size(),
                                 mesh.lit,
                                 mesh.key,
                                 {}};
        members[id].triangles.sift();
        rtcSetGeometryUserData(geometry, &members[id].triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        members[id].geometry = geometry;
    }
};

RayScene::RayScene(std::span<const RayMesh> objects, float skin)
    : impl_(std::make_unique<Impl>()), skin_(skin) {
    for (const RayMesh& object : objects) add(object);
    commit();
}

void RayScene::add(const RayMesh& object) {
    const auto id = unsigned(impl_->members.size());
    impl_->members.emplace_back();
    solids_.append({});
    if (std::ranges::count(object.solid, 1) > 0) placeSolid({id}, object.vertices);
    if (!object.triangles.empty()) impl_->add(object, id);
}

void RayScene::move(ObjectId object, std::span<const glm::vec3> vertices) {
    Impl::Member& member = impl_->members[object.value];
    if (!member.geometry) return;
    requireThatTheyCanBeTraced(vertices);
    std::memcpy(rtcGetGeometryBufferData(member.geometry, RTC_BUFFER_TYPE_VERTEX, 0),
                vertices.data(), vertices.size_bytes());
    rtcUpdateGeometryBuffer(member.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    if (member.triangles.sift()) rtcUpdateGeometryBuffer(member.geometry, RTC_BUFFER_TYPE_INDEX, 0);
    rtcCommitGeometry(member.geometry);
    if (!member.solid.empty()) placeSolid(object, vertices);
    setAlone(object);
}

void RayScene::placeSolid(ObjectId object, std::span<const glm::vec3> vertices) {
    Bounds box;
    for (const glm::vec3 vertex : vertices) box.add(vertex);
    Impl::Member& member = impl_->members[object.value];
    member.solid = grown(box, clearanceAt(skin_, magnitude(box)));
    solids_.set(object.value, member.shown ? member.solid : Bounds());
}

void RayScene::show(ObjectId object, bool visible) {
    Impl::Member& member = impl_->members[object.value];
    if (!member.geometry) return;
    if (visible)
        rtcEnableGeometry(member.geometry);
    else
        rtcDisableGeometry(member.geometry);
    rtcCommitGeometry(member.geometry);
    member.shown = visible;
    solids_.set(object.value, visible ? member.solid : Bounds());
    setAlone(object);
}

void RayScene::setAlone(ObjectId object) {
    Impl::Member& member = impl_->members[object.value];
    if (!member.geometry) return;
    if (!member.alone) {
        member.alone = impl_->newScene();
        rtcAttachGeometryByID(member.alone, member.geometry, object.value);
    }
    member.moved = true;
}

void RayScene::commit() {
    rtcCommitScene(impl_->scene);
    for (Impl::Member& member : impl_->members) {
        if (!member.moved) continue;
        rtcCommitScene(member.alone);
        member.moved = false;
    }
    if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) impl_->fail();
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

float RayScene::reach(glm::vec3 origin, glm::vec3 direction) const {
    const float far = std::max(magnitude(origin), magnitude(origin + direction));
    const float length = std::max(glm::length(direction), 1e-30f);
    return 1 - std::max(1e-4f, clearanceAt(skin_, far) / length);
}

void RayScene::occluded(ShadowRays& rays) const {
    trace(impl_->scene, rays);
}

void RayScene::occludedBy(ObjectId object, ShadowRays& rays) const {
    const Impl::Member& member = impl_->members[object.value];
    if (member.geometry) {    // else it has no triangle
        assert(member.alone); // it has been moved or shown
        trace(member.alone, rays);
        return;
    }
    std::fill_n(rays.blocker, ShadowRays::kMost, ObjectId::kNone);
}

void RayScene::trace(void* scene, ShadowRays& rays) const {
    static_assert(ShadowRays::kMost == 16);
    alignas(64) int valid[16];
    alignas(64) RTCRay16 packet;
    float reaches[16];
    for (int i = 0; i < 16; ++i) {
        const bool used = (rays.used >> i & 1) != 0 &&
                          isTraceable({rays.originX[i], rays.originY[i], rays.originZ[i]},
                                      {rays.directionX[i], rays.directionY[i], rays.directionZ[i]});
        valid[i] = used ? -1 : 0;
        rays.blocker[i] = ObjectId::kNone;
        packet.org_x[i] = used ? rays.originX[i] : 0;
        packet.org_y[i] = used ? rays.originY[i] : 0;
        packet.org_z[i] = used ? rays.originZ[i] : 0;
        packet.dir_x[i] = used ? rays.directionX[i] : 0;
        packet.dir_y[i] = used ? rays.directionY[i] : 0;
        packet.dir_z[i] = used ? rays.directionZ[i] : 1;
        // Where the processor has no 16 lanes Embree does not ask which are valid.
        packet.tnear[i] = used ? 0.0f : 1.0f;
        packet.tfar[i] = reaches[i] =
            used ? reach({packet.org_x[i], packet.org_y[i], packet.org_z[i]},
                         {packet.dir_x[i], packet.dir_y[i], packet.dir_z[i]})
                 : 0.0f;
        packet.time[i] = 0;
        packet.mask[i] = 0xffffffffu;
        packet.id[i] = unsigned(i);
        packet.flags[i] = 0;
    }
    QueryContext context;
    context.blocker = rays.blocker;
    rtcOccluded16(valid, static_cast<RTCScene>(scene), &context.context, &packet);
    for (const int i : bitsOf(context.doubts)) {
        if (rays.blocker[i] != ObjectId::kNone) continue;
        const RayHit hit = nearestIn(scene, {rays.originX[i], rays.originY[i], rays.originZ[i]},
                                     {rays.directionX[i], rays.directionY[i], rays.directionZ[i]},
                                     reaches[i], Faces::both);
        rays.blocker[i] = hit.object.value;
    }
}

bool RayScene::occluded(glm::vec3 origin, glm::vec3 target) const {
    const glm::vec3 d = target - origin;
    if (!isTraceable(origin, d)) return false;
    const float far = reach(origin, d);
    RTCRay ray{origin.x, origin.y, origin.z, 0, d.x, d.y, d.z, 0, far, 0xffffffffu, 0, 0};
    std::uint32_t blocker = ObjectId::kNone;
    QueryContext context;
    context.blocker = &blocker;
    rtcOccluded1(impl_->scene, &context.context, &ray);
    if (blocker == ObjectId::kNone && context.doubts != 0)
        return nearestIn(impl_->scene, origin, d, far, Faces::both).met();
    return blocker != ObjectId::kNone;
}

void RayScene::all(glm::vec3 origin, glm::vec3 direction, float reach,
                   std::vector<RayHit>& hits) const {
    hits.clear();
    QueryContext context;
    context.all = &hits;
    intersect(impl_->scene, context, origin, direction, reach);
}

float RayScene::solidsEnd(glm::vec3 origin, glm::vec3 direction) const {
    float end = 0;
    solids_.query([&](std::size_t n) { return solids_.node(n).contains(origin); },
                  [&](std::size_t object) {
                      float least = std::numeric_limits<float>::infinity();
                      for (int k = 0; k < 3; ++k) {
                          const Bounds& box = solids_[object];
                          const float side = direction[k] > 0 ? box.upper[k] : box.lower[k];
                          if (direction[k] != 0)
                              least = std::min(least, (side - origin[k]) / direction[k]);
                      }
                      end = std::max(end, least);
                  });
    return end;
}

RayHit RayScene::nearest(glm::vec3 origin, glm::vec3 direction, float reach, Faces faces) const {
    return nearestIn(impl_->scene, origin, direction, reach, faces);
}

void RayScene::nearest(glm::vec3 origin, std::span<const glm::vec3> directions, float reach,
                       Faces faces, std::span<RayHit> hits) const {
    assert(directions.size() <= ShadowRays::kMost && hits.size() == directions.size());
    constexpr std::size_t kFew = 4; // a packet costs more than one by one
    if (directions.size() < kFew || std::isnan(reach)) {
        for (std::size_t i = 0; i < directions.size(); ++i)
            hits[i] = nearest(origin, directions[i], reach, faces);
        return;
    }
    alignas(64) int valid[16]{};
    alignas(64) RTCRayHit16 packet{};
    std::ranges::fill(packet.ray.dir_z, 1.0f);
    std::ranges::fill(packet.ray.tnear, 1.0f); // of those that are not used, see trace()
    std::vector<NearestHit> nearest;
    nearest.reserve(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::vec3 to = directions[i];
        nearest.emplace_back(origin, to);
        if (!isTraceable(origin, to)) continue;
        valid[i] = -1;
        packet.ray.org_x[i] = origin.x, packet.ray.dir_x[i] = to.x;
        packet.ray.org_y[i] = origin.y, packet.ray.dir_y[i] = to.y;
        packet.ray.org_z[i] = origin.z, packet.ray.dir_z[i] = to.z;
        packet.ray.tnear[i] = 0, packet.ray.tfar[i] = reach;
        packet.ray.mask[i] = 0xffffffffu;
        packet.ray.id[i] = unsigned(i);
        packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    QueryContext context;
    context.nearest = nearest.data();
    context.faces = faces;
    rtcIntersect16(valid, impl_->scene, &context.context, &packet);
    for (std::size_t i = 0; i < directions.size(); ++i)
        hits[i] = nearest[i].inDoubt() ? this->nearest(origin, directions[i], reach, faces)
                                       : nearest[i].hit();
}

RayHit RayScene::nearestIn(void* scene, glm::vec3 origin, glm::vec3 direction, float reach,
                           Faces faces) const {
    constexpr int kTimes = 4; // corners may need several
    for (int time = 1;; ++time) {
        NearestHit nearest(origin, direction);
        const auto offer = [&](glm::vec3 from) {
            QueryContext context;
            context.nearest = &nearest;
            context.faces = faces;
            intersect(static_cast<RTCScene>(scene), context, from, direction, reach);
        };
        offer(origin);
        if (!nearest.inDoubt()) return nearest.hit();
        const float hair = nearest.hair();
        for (int i = 0; i < NearestHit::kAround; ++i) offer(origin + nearest.beside(hair, i));
        if (!nearest.inDoubt()) return nearest.hit();
        if (time == kTimes) return nearest.doubt();
        origin += nearest.aside(nearest.hair());
    }
}

} // namespace penumbra
