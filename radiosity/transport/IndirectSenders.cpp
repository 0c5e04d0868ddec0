#include "radiosity/transport/IndirectSenders.h"

#include "base/PairHash.h"
#include "base/Parallel.h"
#include "radiosity/rows/SenderSamples.h"

#include <algorithm>
#include <numbers>
#include <unordered_map>

namespace penumbra {

namespace {

/// How many times its own size a cluster must be away to represent its patches.
constexpr float kFar = 3.5f;
/// Patches of less than this share of a whole one's area meet in clusters whichever way they face.
constexpr float kSmallShare = 0.125f;

/// Of what an emitter sends: on whom more may fall may light a room alone, or does very likely.
constexpr float kBrightShare = 1e-3f, kGlaringShare = 0.3f;
/// Of a cluster's area: where patches that glare are more it does, too.
constexpr float kGlaringPart = 0.125f;

static_assert(Clusters::kParts == kPatchSamples && kSenderCells == kPatchSamples);

/// Square of the distance between two boxes [m^2]. Rounding never makes a box nearer than one
/// around it.
float squaredGap(const Bounds& a, const Bounds& b) {
    const glm::vec3 gap = glm::max(glm::max(a.lower - b.upper, b.lower - a.upper), glm::vec3(0));
    return gap.x * gap.x + gap.y * gap.y + gap.z * gap.z;
}

} // namespace

IndirectSenders::IndirectSenders(const PatchSet& set, bool clusters)
    : set_(set), clusters_(clusters) {
    const std::size_t patches = set.patches.size();
    boxes_.resize(patches), parents_.assign(patches, Clusters::kNone), areas_.resize(patches);
    keys_.resize(patches), objects_.resize(patches), samples_.resize(patches * kPatchSamples);
    listFaceClusters({0, patchCount()});
    parallelFor(patches, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) placePatch(std::uint32_t(p));
    });
    // What is of one element and stays so sends evenly. What is not there yet may come to be of
    // any.
    const auto isEven = [&](std::uint32_t p) {
        return set.patches[p].elementCount == 1 && p < set.parts.firstPatch &&
               !set.room.patches.contains(p);
    };
    for (std::uint32_t p = 0; p < patches; ++p)
        cells_.push_back({cellCount(), isEven(p) ? 1u : std::uint32_t(kPatchSamples)});
    for (std::uint32_t o = 0; o < set.objects.size(); ++o) addObject({o});
    const std::size_t meshed = set.parts.used.empty() ? patches : set.parts.firstPatch;
    for (std::size_t p = meshed; p < patches; ++p) placePatch(std::uint32_t(p)); // with parents
    listChildren();
    placeEmitters();
    findBright();
}

void IndirectSenders::add(ObjectId object) {
    const Range patches = set_.objects[object.value].patches;
    listFaceClusters(patches);
    for (std::uint32_t p = patches.first; p < patches.end(); ++p) placePatch(p);
    addObject(object);
    listChildren();
    findBright(patches.first, patches.end());
    findBrightClusters(object);
}

/// Makes room for the parts of those patches that are clusters of faces.
void IndirectSenders::listFaceClusters(Range patches) {
    faces_.resize(patchCount(), Clusters::kNone);
    std::uint32_t count = std::uint32_t(faceParts_.size());
    for (std::uint32_t p = patches.first; p < patches.end(); ++p)
        if (set_.patches[p].cluster) faces_[p] = count++;
    faceParts_.resize(count);
}

void IndirectSenders::addObject(ObjectId object) {
    const ObjectPart& part = set_.objects[object.value];
    std::vector<ClusterPatch> own;
    for (std::uint32_t i = 0; i < part.patches.count && clusters_; ++i)
        own.push_back({part.patches.first + i, part.shape.patches[i].position,
                       part.shape.patches[i].normal, areas_[part.patches.first + i]});
    const std::uint32_t first = count();
    addFamily(own);
    clusterRanges_.push_back({first, count() - first});
}

/// What clusters are made of, and all that is in none.
void IndirectSenders::listChildren() {
    const std::uint32_t patches = patchCount();
    const std::uint32_t meshed = set_.parts.used.empty() ? patches : set_.parts.firstPatch;
    const auto counts = [&](std::uint32_t s) {
        return s >= patches || (s < meshed && set_.patches[s].elementCount > 0);
    };
    roots_.clear();
    for (std::uint32_t s = 0; s < count(); ++s)
        if (parents_[s] == Clusters::kNone && counts(s)) roots_.push_back(s);
    const auto isChild = [&](std::uint32_t s) {
        return parents_[s] != Clusters::kNone && counts(s);
    };
    firstChild_.assign(count() - patches + 1, 0);
    for (std::uint32_t s = 0; s < count(); ++s)
        if (isChild(s)) ++firstChild_[parents_[s] - patches + 1];
    for (std::size_t c = 1; c < firstChild_.size(); ++c) firstChild_[c] += firstChild_[c - 1];
    children_.resize(firstChild_.back());
    std::vector<std::uint32_t> next(firstChild_.begin(), firstChild_.end() - 1);
    for (std::uint32_t s = 0; s < count(); ++s)
        if (isChild(s)) children_[next[parents_[s] - patches]++] = s;
}

void IndirectSenders::addFamily(std::span<const ClusterPatch> patches) {
    const float smallArea = kSmallShare * set_.patchSize * set_.patchSize;
    families_.push_back({Clusters(patches, smallArea), count()});
    const Family& family = families_.back();
    const auto& clusters = family.clusters.clusters();
    const auto& order = family.clusters.patches();
    for (const Clusters::Cluster& cluster : clusters) {
        double area = 0;
        for (std::uint32_t i = 0; i < cluster.count; ++i)
            area += double(areas_[order[cluster.first + i]]);
        parents_.push_back(cluster.parent == Clusters::kNone ? Clusters::kNone
                                                             : family.first + cluster.parent);
        areas_.push_back(float(area));
        keys_.push_back(pairHash(
            pairHash(keys_[order[cluster.first]], keys_[order[cluster.first + cluster.count - 1]]),
            cluster.count));
        objects_.push_back(objects_[order[cluster.first]]);
        cells_.push_back({cellCount(), std::uint32_t(kClusterCells)});
    }
    for (std::size_t i = 0; i < order.size(); ++i)
        if (const std::uint32_t c = family.clusters.clusterAt(i); c != Clusters::kNone)
            parents_[order[i]] = family.first + c;
    boxes_.resize(parents_.size());
    samples_.resize(parents_.size() * kPatchSamples);
    parts_.resize((parents_.size() - patchCount()) * kPatchSamples);
    places_.resize(parts_.size());
    listQuarters(family);
    placeClusters(family);
}

/// Lists what each quarter of a cluster is made of.
void IndirectSenders::listQuarters(const Family& family) {
    const auto& members = family.clusters.members();
    for (const Clusters::Cluster& cluster : family.clusters.clusters())
        for (std::size_t q = 0; q < 4; ++q) {
            for (const Clusters::Part& part : std::span(cluster.parts).subspan(4 * q, 4)) {
                const float share = part.quarter == Clusters::kWhole ? 1.0f : 0.25f;
                for (std::uint32_t i = part.first; i < part.first + part.count; ++i)
                    terms_.push_back({members[i], share, part.quarter});
            }
            firstTerm_.push_back(std::uint32_t(terms_.size()));
        }
}

/// Of what there is of it. \param values see average()
glm::dvec3 IndirectSenders::meanOfPatch(std::uint32_t patch,
                                        std::span<const glm::dvec3> values) const {
    if (!set_.isParted(patch))
        return meanOf(values.subspan(cells_[patch].first, cells_[patch].count));
    glm::dvec3 sum(0);
    double area = 0;
    for (const std::uint32_t part : set_.parts.of.at(patch)) {
        sum +=
            double(areas_[part]) * meanOf(values.subspan(cells_[part].first, cells_[part].count));
        area += double(areas_[part]);
    }
    return sum / area;
}

void IndirectSenders::average(std::span<glm::dvec3> values) const {
    parallelFor(clusterRanges_.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t o = first; o < last; ++o) average({std::uint32_t(o)}, values);
    });
}

void IndirectSenders::average(ObjectId object, std::span<glm::dvec3> values) const {
    const Range patches = set_.objects[object.value].patches;
    const Range clusters = clusterRanges_[object.value];
    if (clusters.count == 0) return;
    std::vector<glm::dvec3> mean;
    std::vector<double> areas; // of what is there of a patch
    for (std::uint32_t p = patches.first; p < patches.end(); ++p) {
        mean.push_back(meanOfPatch(p, values));
        areas.push_back(0);
        set_.forEachPart(p, [&](std::uint32_t part) { areas.back() += double(areas_[part]); });
    }
    const auto meanOver = [&](const Term& term) {
        const Range cells = cells_[term.patch];
        if (term.quarter == Clusters::kWhole || cells.count != kSenderCells ||
            set_.isParted(term.patch))
            return mean[term.patch - patches.first];
        return meanOf(values.subspan(cells.first + 4u * term.quarter, 4));
    };
    for (std::uint32_t c = clusters.first; c < clusters.end(); ++c)
        for (std::size_t q = 0; q < 4; ++q) {
            const std::size_t i = 4 * std::size_t(c - patchCount()) + q;
            glm::dvec3 sum(0);
            double area = 0;
            for (std::uint32_t t = firstTerm_[i]; t < firstTerm_[i + 1]; ++t) {
                const double own = double(terms_[t].share) * areas[terms_[t].patch - patches.first];
                if (!(own > 0)) continue;
                sum += own * meanOver(terms_[t]);
                area += own;
            }
            values[cells_[c].first + kSenderCells + q] = area > 0 ? sum / area : glm::dvec3(0);
        }
}

void IndirectSenders::deviate(ObjectId object, std::span<glm::dvec3> direct) const {
    average(object, direct);
    const Range clusters = clustersOf(object);
    for (std::uint32_t c = clusters.first; c < clusters.end(); ++c) deviateCluster(c, direct);
}

/// By how much more leaves the place of each sample of a cluster than its quarter.
void IndirectSenders::deviateCluster(std::uint32_t cluster, std::span<glm::dvec3> direct) const {
    const Place* const places = &places_[(cluster - patchCount()) * kPatchSamples];
    const std::span<glm::dvec3> cells = direct.subspan(cells_[cluster].first, kClusterCells);
    const auto at = [&](Place place) {
        return isUneven(place.patch) && !set_.isParted(place.patch)
                   ? direct[cells_[place.patch].first + place.sample]
                   : meanOfPatch(place.patch, direct);
    };
    std::ranges::fill(cells.first(kSenderCells), glm::dvec3(0));
    for (std::size_t k = 0; k < kPatchSamples; ++k)
        if (places[k].patch != Clusters::kNone)
            cells[k] = at(places[k]) - cells[kSenderCells + k / 4];
}

void IndirectSenders::place(ObjectId object) {
    const Range patches = set_.objects[object.value].patches;
    parallelFor(patches.count, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) placePatch(patches.first + std::uint32_t(i));
    });
    placeClusters(families_[object.value]);
}

void IndirectSenders::placePatch(std::uint32_t p) {
    const Patch& patch = set_.patches[p];
    const std::uint32_t whole = set_.wholeOf(p);
    const bool there = patch.elementCount > 0;
    boxes_[p] = {};
    keys_[p] = there ? addressOfPatch(set_, p) : 0;
    areas_[p] = there ? patch.area : 0;
    objects_[p] = patch.object;
    if (whole != p) parents_[p] = there ? parents_[whole] : Clusters::kNone;
    if (!there) return;
    if (patch.cluster) {
        const ClusterParts own = partsOf(set_, patch);
        std::ranges::copy(own.samples, samples_.begin() + p * kPatchSamples);
        faceParts_[faces_[p]] = own.parts;
    } else {
        samplePatch(set_, patch, samples_.data() + p * kPatchSamples);
    }
    set_.forEachCorner(patch, [&](glm::vec3 corner) { boxes_[p].add(corner); });
    for (std::size_t k = 0; k < kPatchSamples; ++k) boxes_[p].add(samples_[p * kPatchSamples + k]);
}

void IndirectSenders::placeClusters(const Family& family) {
    const auto& clusters = family.clusters.clusters();
    const auto& order = family.clusters.patches();
    const auto& members = family.clusters.members();
    for (std::uint32_t c = std::uint32_t(clusters.size()); c-- > 0;) {
        const Clusters::Cluster& cluster = clusters[c];
        const std::uint32_t s = family.first + c;
        boxes_[s] = {};
        for (std::uint32_t i = 0; i < cluster.count; ++i)
            boxes_[s].add(boxes_[order[cluster.first + i]]);
        std::uint32_t before = 0; // how many parts
        for (std::uint32_t k = 0; k < kPatchSamples; ++k) {
            const Clusters::Part& part = cluster.parts[k];
            const std::size_t at = std::size_t(s - patchCount()) * kPatchSamples + k;
            if (part.count == 0) { // it faces nobody
                parts_[at] = {};
                places_[at] = {Clusters::kNone, 0};
                samples_[s * kPatchSamples + k] = samples_[s * kPatchSamples];
                continue;
            }
            const bool whole = part.quarter == Clusters::kWhole;
            glm::vec3 centre(0), vector(0);
            float area = 0;
            for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
                const Patch& patch = set_.patches[members[i]];
                area += patch.area;
                centre += patch.area * patch.centre;
                vector += patch.area * patch.normal;
            }
            const std::uint32_t middle = members[part.first + part.count / 2];
            const glm::vec3* const points = &samples_[middle * kPatchSamples];
            const float seen = glm::length(vector);
            SenderPart& out = parts_[at];
            out = {centre / area, vector / seen, seen};
            if (!whole) {
                const glm::vec3* const quarter = points + 4 * part.quarter;
                out.centre = 0.25f * (quarter[0] + quarter[1] + quarter[2] + quarter[3]);
                out.area *= 0.25f;
            }
            const std::uint32_t which = whole ? 5 * before : 4u * part.quarter + before % 4;
            ++before;
            samples_[s * kPatchSamples + k] = points[which % kPatchSamples];
            places_[at] = {middle, std::uint8_t(which % kPatchSamples)};
        }
    }
}

/// \return whether any is elsewhere than before, or hidden, or shown
bool IndirectSenders::placeEmitters() {
    bool changed = false;
    emitterAreas_.resize(set_.emitters.size());
    for (std::size_t e = 0; e < set_.emitters.size(); ++e) {
        const Emitter& emitter = set_.emitters[e];
        const bool present = set_.objects[emitter.object.value].present;
        const Bounds box = present ? boundsOf(emitter) : Bounds();
        if (e == emitters_.size()) emitters_.append({});
        if (emitters_[e] == box && emitterAreas_[e] == emitter.area) continue;
        emitters_.set(e, box);
        emitterAreas_[e] = emitter.area;
        changed = true;
    }
    return changed;
}

/// By the most that can fall on it: A / (pi d^2), and by reciprocity no more than its share of the
/// emitter's area.
IndirectSenders::Brightness IndirectSenders::brightnessOf(std::uint32_t index) const {
    const float area = areas_[index];
    const auto mayCatch = [&](float share, const Bounds& emitter) {
        return squaredGap(boxes_[index], emitter) * std::numbers::pi_v<float> * share <= area;
    };
    Brightness most = Brightness::usual;
    emitters_.query(
        [&](std::size_t n) {
            return most != Brightness::glaring && mayCatch(kBrightShare, emitters_.node(n));
        },
        [&](std::size_t e) {
            const bool glaring = mayCatch(kGlaringShare, emitters_[e]) &&
                                 emitterAreas_[e] * double(kGlaringShare) <= double(area);
            most = std::max(most, glaring ? Brightness::glaring : Brightness::bright);
        });
    return most;
}

void IndirectSenders::findBright() {
    findBright(0, patchCount());
    for (std::uint32_t o = 0; o < clusterRanges_.size(); ++o) findBrightClusters({o});
}

/// Of patches or clusters; but for glare that comes of single patches.
void IndirectSenders::findBright(std::uint32_t first, std::uint32_t end) {
    brightness_.resize(count());
    parallelFor(end - first, 1024, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const std::uint32_t s = first + std::uint32_t(i);
            brightness_[s] = boxes_[s].empty() ? Brightness::usual : brightnessOf(s);
        }
    });
}

/// \pre the patches are
void IndirectSenders::findBrightClusters(ObjectId object) {
    const Range clusters = clustersOf(object);
    findBright(clusters.first, clusters.end());
    std::vector<float> glaring(clusters.count); // [m^2]
    for (std::uint32_t i = clusters.count; i-- > 0;) {
        const std::uint32_t s = clusters.first + i, c = s - patchCount();
        for (std::uint32_t k = firstChild_[c]; k < firstChild_[c + 1]; ++k) {
            if (children_[k] >= patchCount())
                glaring[i] += glaring[children_[k] - clusters.first];
            else
                set_.forEachPart(children_[k], [&](std::uint32_t part) {
                    if (brightness_[part] == Brightness::glaring) glaring[i] += areas_[part];
                });
        }
        const bool glares = glaring[i] > kGlaringPart * areas_[s];
        if (glares || brightness_[s] == Brightness::glaring)
            brightness_[s] = glares ? Brightness::glaring : Brightness::bright;
    }
}

std::vector<std::uint32_t> IndirectSenders::followEmitters(const SceneChange& change) {
    const std::vector<Brightness> before = brightness_;
    if (placeEmitters()) {
        findBright();
    } else {
        std::vector<ObjectId> objects = change.objects;
        for (const ObjectId object : change.objects) {
            const Range own = set_.objects[object.value].patches;
            findBright(own.first, own.end());
        }
        for (const std::uint32_t p : change.senders) findBright(p, p + 1);
        for (const auto* patches : {&change.senders, &change.parted})
            for (const std::uint32_t p : *patches)
                if (objects_[p].valid()) objects.push_back(objects_[p]);
        std::sort(objects.begin(), objects.end());
        objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
        for (const ObjectId object : objects) findBrightClusters(object);
    }
    std::vector<std::uint32_t> changed;
    for (std::uint32_t s = 0; s < count(); ++s)
        if (brightness_[s] != before[s]) changed.push_back(s);
    return changed;
}

PatchSender IndirectSenders::sender(std::uint32_t index) const {
    PatchSender sender;
    sender.least = leastFactor(index);
    sender.allSamples = brightness(index) == Brightness::glaring;
    sender.samples = samples_.data() + std::size_t(index) * kPatchSamples;
    sender.key = keys_[index];
    sender.box = &boxes_[index];
    if (index < patchCount()) {
        const Patch& patch = set_.patches[index];
        sender.patch = &patch;
        sender.cells = isUneven(index);
        if (patch.cluster)
            sender.parts = faceParts_[faces_[index]];
        else
            sender.outline = std::span(set_.corners).subspan(patch.firstCorner, patch.cornerCount);
        return sender;
    }
    sender.parts = std::span(parts_).subspan((index - patchCount()) * kPatchSamples, kPatchSamples);
    return sender;
}

bool IndirectSenders::sendsLike(std::uint32_t index, const IndirectSenders& others,
                                std::uint32_t other) const {
    const PatchSender a = sender(index), b = others.sender(other);
    const auto samePart = [](const SenderPart& x, const SenderPart& y) {
        return x.centre == y.centre && x.normal == y.normal && x.area == y.area;
    };
    const bool samePatch =
        !a.patch == !b.patch &&
        (!a.patch || (a.patch->centre == b.patch->centre && a.patch->normal == b.patch->normal &&
                      a.patch->area == b.patch->area));
    return samePatch && a.cells == b.cells && a.least == b.least && a.allSamples == b.allSamples &&
           std::ranges::equal(a.outline, b.outline) &&
           std::ranges::equal(a.parts, b.parts, samePart) &&
           std::equal(a.samples, a.samples + kPatchSamples, b.samples);
}

std::vector<std::uint32_t> IndirectSenders::matched(const IndirectSenders& others) const {
    std::unordered_multimap<std::uint32_t, std::uint32_t> named;
    for (std::uint32_t s = 0; s < others.count(); ++s) named.emplace(others.keys_[s], s);
    std::vector<std::uint32_t> match(count(), ObjectId::kNone);
    parallelFor(count(), 256, [&](std::size_t first, std::size_t last) {
        for (auto s = std::uint32_t(first); s < last; ++s) {
            if (areas_[s] == 0) continue; // a patch that nobody has
            const auto [from, to] = named.equal_range(keys_[s]);
            const auto found = std::find_if(
                from, to, [&](const auto& o) { return sendsLike(s, others, o.second); });
            if (found != to) match[s] = found->second;
        }
    });
    return match;
}

bool IndirectSenders::isFar(std::uint32_t index, const Bounds& receivers) const {
    const glm::vec3 size = boxes_[index].upper - boxes_[index].lower;
    const float diagonal2 = size.x * size.x + size.y * size.y + size.z * size.z;
    return squaredGap(boxes_[index], receivers) >= kFar * kFar * diagonal2;
}

std::vector<std::uint32_t> IndirectSenders::linkedBlocks(std::uint32_t index,
                                                         const BoundsTree& blocks) const {
    std::vector<std::uint32_t> linked;
    const std::uint32_t up = parents_[index];
    // Where all of a node is far from the larger cluster, that one serves it.
    const auto mayBe = [&](std::size_t n) {
        return up == Clusters::kNone || !isFar(up, blocks.node(n));
    };
    blocks.query(mayBe, [&](std::size_t b) {
        if (isEnough(index, blocks[b])) linked.push_back(std::uint32_t(b));
    });
    return linked;
}

} // namespace penumbra
