#include "radiosity/rows/EmitterSender.h"

#include "base/Frame.h"
#include "radiosity/rows/FormFactor.h"
#include "radiosity/rows/SenderSamples.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

/// As many polygons are gone through one by one.
constexpr std::size_t kFewPolygons = 64;

int roundUp(int samples) {
    return std::max(16, (samples + 15) / 16 * 16);
}

/// The point of a sphere that the receiver sees behind a point of its tangent disk.
glm::vec3 ontoSphere(glm::vec3 from, glm::vec3 onDisk, glm::vec3 centre, float radius) {
    const glm::vec3 d = onDisk - from;
    const glm::vec3 o = from - centre;
    const float a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - radius * radius;
    const float root = std::sqrt(std::max(0.0f, b * b - a * c));
    return from + std::max(0.0f, (-b - root) / a) * d;
}

} // namespace

EmitterSender::EmitterSender(const Emitter& emitter, int baseSamples, int allSamples)
    : emitter_(&emitter), base_(roundUp(baseSamples)), all_(std::max(base_, roundUp(allSamples))),
      box_(boundsOf(emitter)) {
    if (emitter.polygons.size() > kFewPolygons) many_.emplace(emitter.polygons);
    const EmitterSamples samples = sampleEmitter(emitter, std::size_t(all_));
    for (const EmitterSamples::Point& point : samples.points) {
        x_.push_back(point.position.x), y_.push_back(point.position.y),
            z_.push_back(point.position.z);
        nx_.push_back(point.normal.x), ny_.push_back(point.normal.y), nz_.push_back(point.normal.z);
    }
}

float EmitterSender::formFactor(const Receiver& receiver) const {
    const glm::vec3 p = receiver.position, n = receiver.normal;
    switch (emitter_->kind) {
    case Emitter::Kind::disk:
        return diskFormFactor(p, n, emitter_->centre, emitter_->axis, emitter_->radius);
    case Emitter::Kind::sphere:
        return sphereFormFactor(p, n, emitter_->centre, emitter_->radius);
    case Emitter::Kind::polygons:
        break;
    }
    if (many_) return std::min(many_->formFactor(p, n), 1.0f);
    float sum = 0;
    for (const auto& polygon : emitter_->polygons) sum += polygonFormFactor(p, n, polygon);
    return std::min(sum, 1.0f);
}

void EmitterSender::sampleGroup(const Receiver& receiver, int first, SampleGroup& group) const {
    if (emitter_->kind == Emitter::Kind::sphere) return sphereGroup(receiver, first, group);
    const glm::vec3 p = receiver.position, n = receiver.normal;
    const float *x = x_.data() + first, *y = y_.data() + first, *z = z_.data() + first;
    const float *nx = nx_.data() + first, *ny = ny_.data() + first, *nz = nz_.data() + first;
    ShadowRays& rays = group.rays;
    for (int i = 0; i < 16; ++i) {
        const float dx = x[i] - p.x, dy = y[i] - p.y, dz = z[i] - p.z;
        const float d2 = dx * dx + dy * dy + dz * dz;
        const float here = n.x * dx + n.y * dy + n.z * dz;
        const float there = -(nx[i] * dx + ny[i] * dy + nz[i] * dz);
        group.weight[i] = facing(here, there, d2) / (d2 * d2);
        rays.originX[i] = p.x, rays.originY[i] = p.y, rays.originZ[i] = p.z;
        rays.directionX[i] = dx, rays.directionY[i] = dy, rays.directionZ[i] = dz;
    }
    rays.used = 0;
    for (int i = 0; i < 16; ++i) rays.used |= std::uint32_t(group.weight[i] > 0) << i;
}

void EmitterSender::sphereGroup(const Receiver& receiver, int first, SampleGroup& group) const {
    const glm::vec3 p = receiver.position;
    const TangentDisk disk = tangentDisk(p, emitter_->centre, emitter_->radius);
    const glm::vec3 u = disk.radius * Frame(disk.axis).u;
    const glm::vec3 v = glm::cross(disk.axis, u);
    group.rays.used = 0;
    for (int i = 0; i < 16; ++i) {
        const std::size_t k = std::size_t(first) + std::size_t(i);
        const glm::vec3 q = disk.centre + x_[k] * u + y_[k] * v;
        const glm::vec3 d = q - p;
        const float d2 = glm::dot(d, d);
        group.weight[i] =
            facing(glm::dot(receiver.normal, d), -glm::dot(disk.axis, d), d2) / (d2 * d2);
        if (group.weight[i] > 0)
            group.rays.set(i, p, ontoSphere(p, q, emitter_->centre, emitter_->radius));
    }
}

void SampleGroup::add(float& total, float& seen) const {
    for (int i = 0; i < 16; ++i) {
        if (!(rays.used >> i & 1)) continue;
        total += weight[i];
        if (rays.blocker[i] == ObjectId::kNone) seen += weight[i];
    }
}

float EmitterSender::visibility(const RayScene& rays, const Receiver& receiver, int first,
                                int count) const {
    float total = 0, seen = 0;
    SampleGroup group;
    for (int at = first; at < first + count; at += 16) {
        sampleGroup(receiver, at, group);
        rays.occluded(group.rays);
        group.add(total, seen);
    }
    return total > 0 ? seen / total : 0.0f;
}

} // namespace penumbra
