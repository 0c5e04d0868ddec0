#include "radiosity/schedule/ViewPriority.h"

#include "base/Bits.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/schedule/KernelEstimate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace penumbra {

ViewPriority::ViewPriority(const PatchSet& patches, const RayScene& rays, Light light)
    : ViewPriority(patches, rays, std::move(light), VertexClusters(patches)) {}

ViewPriority::ViewPriority(const PatchSet& patches, const RayScene& rays, Light light,
                           VertexClusters clusters)
    : ImportancePolicy(clusters.clusterOf()), patches_(patches), rays_(rays),
      light_(std::move(light)), clusters_(std::move(clusters)) {}

void ViewPriority::follow(std::span<const ObjectId> objects) {
    const Bounds before = clusters_.boundsOf(objects);
    clusters_.follow(objects);
    if (!from_) return;
    if (from_->eye()) forgetSeen(objects, before, clusters_.boundsOf(objects));
    setAttention(attention());
}

/// Of the objects themselves, and of all that they may have hidden or may hide now.
void ViewPriority::forgetSeen(std::span<const ObjectId> objects, const Bounds& before,
                              const Bounds& now) {
    const Bounds eye{glm::vec3(*from_->eye()), glm::vec3(*from_->eye())};
    // Beside a thing that stands on them, vertices are lit an element farther out: see Contact.h.
    const Bounds from = grown(before, patches_.elementSize), to = grown(now, patches_.elementSize);
    const auto moved = [&](ObjectId object) {
        return std::find(objects.begin(), objects.end(), object) != objects.end();
    };
    const auto stale = [&](const Bounds& box) {
        return shaftMeets(box, eye, from) || shaftMeets(box, eye, to);
    };
    const std::uint32_t firstPrivate = patches_.firstPrivate / PatchSet::kBlock;
    std::erase_if(seenVertices_, [&](const auto& item) {
        return item.first >= firstPrivate || // are handed out anew
               moved(patches_.vertexBlockObject[item.first]);
    });
    for (auto& [block, sample] : seenVertices_) {
        if (!stale(sample.box)) continue;
        for (const std::size_t r : bitsOf(sample.asked)) {
            const glm::vec3 p = patches_.vertices[block * PatchSet::kBlock + r].receiver.position;
            const std::uint64_t bit = std::uint64_t(1) << r;
            const Bounds point{p, p};
            if (from.contains(p) || to.contains(p) ||
                ((sample.seen & bit) && shaftMeets(point, eye, to)) ||
                ((sample.behind & bit) && shaftMeets(point, eye, from)))
                sample.asked &= ~bit; // what stays hides what it hid
        }
        sample.seen &= sample.asked;
        sample.behind &= sample.asked;
    }
    std::erase_if(clusterPixels_, [&](const auto& item) {
        return moved(clusters_.objectOf(item.first)) || stale(clusters_.known(item.first).box);
    });
}

void ViewPriority::attend(const Attention& attention, double ambient) {
    ambient_ = ambient;
    if (from_ != attention.viewpoint) {
        seenVertices_.clear();
        values_.clear();
        clusterPixels_.clear();
        from_ = attention.viewpoint;
    }
    Attention now = attention;
    if (!(now.adaptation > 0)) now.adaptation = adaptationTo(now.viewpoint);
    setAttention(now);
}

ReceiverCluster ViewPriority::clusterNow(std::uint32_t index) const {
    ReceiverCluster cluster = clusters_.at(index, light_());
    cluster.luminance += cluster.reflectance * float(ambient_ * std::numbers::inv_pi);
    return cluster;
}

/// Geometric mean over what is in the picture, as if nothing were in front of it.
double ViewPriority::adaptationTo(const Viewpoint& viewpoint) const {
    double sum = 0, pixels = 0;
    for (std::uint32_t p = 0; p < clusters_.size(); ++p) {
        const ReceiverCluster& known = clusters_.known(p);
        if (viewpoint.regionOf(known.box) != Viewpoint::Region::picture) continue;
        const double shown = viewpoint.pixelsOf(known.box, known.normal, known.area);
        if (!(shown > 0)) continue;
        sum += shown * std::log(std::max(1e-4, double(clusterNow(p).luminance)));
        pixels += shown;
    }
    return pixels > 0 ? std::exp(sum / pixels) : 1e-4;
}

void ViewPriority::sampleClosely(std::uint32_t block, std::uint64_t which,
                                 std::span<ClusterPriority> values) {
    Values& known = values_[block];
    if (known.view != view()) known.known = 0, known.view = view();
    if (const std::uint64_t unknown = which & ~known.known; unknown != 0)
        evaluate(block, unknown, known);
    std::copy(known.of.begin(), known.of.end(), values.begin());
}

void ViewPriority::evaluate(std::uint32_t block, std::uint64_t which, Values& values) {
    const bool probes = attention().factors.occlusion && attention().viewpoint.eye();
    const SeenVertices sample = probes ? seenVerticesOf(block, which) : SeenVertices();
    const std::size_t first = std::size_t(block) * PatchSet::kBlock;
    std::array<Receiver, PatchSet::kBlock> receivers;
    for (std::size_t r = 0; r < receivers.size(); ++r)
        receivers[r] = patches_.vertices[first + r].receiver;
    const KernelEstimate share(receivers);
    values.known |= which;
    for (const std::size_t r : bitsOf(which)) {
        ReceiverCluster cluster = clusters_.atVertex(first + r, light_()[first + r]);
        cluster.luminance += cluster.reflectance * float(ambient_ * std::numbers::inv_pi);
        std::optional<float> pixels;
        if (probes) { // what is drawn around a hidden vertex may be seen
            const float seen =
                0.5f * float(sample.seen >> r & 1) + 0.5f * share.at(r, sample.asked, sample.seen);
            pixels = seen * float(attention().viewpoint.pixelsOf(cluster.box, cluster.normal,
                                                                 cluster.area));
        }
        values.of[r] =
            cluster.box.empty() ? ClusterPriority() : clusterPriority(cluster, attention(), pixels);
    }
}

/// What is known of a block once some of its vertices were asked for.
const ViewPriority::SeenVertices& ViewPriority::seenVerticesOf(std::uint32_t block,
                                                               std::uint64_t which) {
    SeenVertices& sample = seenVertices_[block];
    which &= ~sample.asked;
    sample.asked |= which;
    ask(block, which, sample);
    for (const std::size_t r : bitsOf(which)) {
        sample.box.add(
            patches_.vertices[std::size_t(block) * PatchSet::kBlock + r].receiver.position);
    }
    return sample;
}

/// Finds which of some vertices of a block face the eye, are in the picture, and not hidden.
void ViewPriority::ask(std::uint32_t block, std::uint64_t which, SeenVertices& sample) {
    const glm::vec3 eye(*attention().viewpoint.eye());
    ShadowRays rays;
    std::array<std::uint32_t, ShadowRays::kMost> of{};
    int count = 0;
    const auto trace = [&] {
        if (count == 0) return;
        rays_.occluded(rays);
        rayCount_ += std::uint64_t(count);
        for (int i = 0; i < count; ++i) {
            const std::uint64_t bit = std::uint64_t(1) << of[std::size_t(i)];
            if (rays.blocker[i] == ObjectId::kNone)
                sample.seen |= bit;
            else
                sample.behind |= bit;
        }
        rays.used = 0;
        count = 0;
    };
    for (const std::uint32_t r : bitsOf(which)) {
        const Receiver& receiver =
            patches_.vertices[std::size_t(block) * PatchSet::kBlock + r].receiver;
        const Bounds point{receiver.position, receiver.position};
        if (glm::dot(eye - receiver.position, receiver.normal) <= 0) continue; // also padding
        if (attention().viewpoint.regionOf(point) != Viewpoint::Region::picture) continue;
        of[std::size_t(count)] = r;
        rays.set(count++, receiver.position, eye);
        if (count == ShadowRays::kMost) trace();
    }
    trace();
}

ImportancePolicy::ViewSample ViewPriority::sample(std::uint32_t index) {
    const Viewpoint& viewpoint = attention().viewpoint;
    ViewSample sample{clusterNow(index), {}};
    const ReceiverCluster& cluster = sample.cluster;
    if (!attention().factors.occlusion || !viewpoint.eye() ||
        viewpoint.regionOf(cluster.box) != Viewpoint::Region::picture)
        return sample;
    const auto [known, fresh] = clusterPixels_.try_emplace(index, 0.0f);
    if (fresh) known->second = pixelsSeen(index);
    sample.seen = known->second;
    return sample;
}

/// How many pixels an average block of a cluster covers, by vertices spread over it.
float ViewPriority::pixelsSeen(std::uint32_t cluster) {
    const Viewpoint& viewpoint = attention().viewpoint;
    const std::vector<std::size_t> vertices = clusters_.spread(cluster);
    float pixels = 0;
    for (const std::size_t v : vertices) {
        const std::uint64_t bit = std::uint64_t(1) << v % PatchSet::kBlock;
        if (!(seenVerticesOf(std::uint32_t(v / PatchSet::kBlock), bit).seen & bit)) continue;
        const Receiver& receiver = patches_.vertices[v].receiver;
        pixels += float(viewpoint.pixelsOf({receiver.position, receiver.position}, receiver.normal,
                                           clusters_.known(cluster).area));
    }
    return vertices.empty() ? 0 : pixels / float(vertices.size());
}

} // namespace penumbra
