#include "tests/support/LitDifference.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace penumbra {

namespace {

struct Comparison {
    const PatchSet& a;
    const PatchSet& b;
    std::ostringstream said;
    int differences = 0;

    template <class... Text>
    bool expect(bool same, const Text&... text) {
        if (same) return true;
        if (++differences <= 5) ((said << text), ..., (said << "\n"));
        return false;
    }
};

bool sameVisibility(const RowBlock::Entry& a, const RowBlock::Entry& b) {
    return a.present == b.present && a.formFactor == b.formFactor && a.visible == b.visible &&
           a.visibility == b.visibility;
}

RowBlock::Entry entryOf(const Row& row, std::uint32_t receiver) {
    const RowBlock* const block = row.find(receiver / PatchSet::kBlock);
    return block ? block->entry(int(receiver % PatchSet::kBlock)) : RowBlock::Entry();
}

void compareDirect(Comparison& with, const Row& a, const Row& b, const ObjectPart& pa,
                   const ObjectPart& pb, const std::string& emitter) {
    for (std::uint32_t i = 0; i < pa.elements.count; ++i) {
        const std::uint32_t ea = pa.elements.first + i, eb = pb.elements.first + i;
        if (!with.expect(with.a.receives(ea) == with.b.receives(eb), pa.path, " element ", i,
                         " covered in one only"))
            continue;
        if (!with.a.receives(ea)) continue;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t va = with.a.elements[ea].vertices[k];
            const std::uint32_t vb = with.b.elements[eb].vertices[k];
            const glm::vec3 one = with.a.vertices[va].receiver.position,
                            other = with.b.vertices[vb].receiver.position;
            with.expect(one == other, pa.path, " element ", i, " corner ", k, " is lit at ", one.x,
                        " ", one.y, " ", one.z, " against ", other.x, " ", other.y, " ", other.z);
            const auto seenA = entryOf(a, va), seenB = entryOf(b, vb);
            with.expect(sameVisibility(seenA, seenB), emitter, " onto ", pa.path, " element ", i,
                        " corner ", k, ": ", seenA.formFactor, " ", std::hex, seenA.visible,
                        " against ", seenB.formFactor, " ", seenB.visible, std::dec);
        }
    }
}

/// Things of one object in both scenes.
struct Pair {
    std::uint32_t a = 0, b = 0;
};

/// The nodes of an object: those of its mesh, then those that were handed out, by address.
std::vector<Pair> nodePairs(Comparison& with, const ObjectPart& pa, const ObjectPart& pb) {
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < pa.nodes.count; ++i)
        pairs.push_back({pa.nodes.first + i, pb.nodes.first + i});
    const auto handedOut = [](const PatchSet& set, const ObjectPart& part) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> nodes;
        for (std::uint32_t i = 0; i < set.parts.nodePatch.size(); ++i)
            if (const std::uint32_t whole = set.parts.nodePatch[i]; part.patches.contains(whole))
                nodes[{whole - part.patches.first, set.parts.nodeAddress[i]}] =
                    set.parts.firstNode + i;
        return nodes;
    };
    const auto ofA = handedOut(with.a, pa), ofB = handedOut(with.b, pb);
    with.expect(ofA.size() == ofB.size(), pa.path, " has ", ofA.size(),
                " nodes of its own against ", ofB.size());
    for (const auto& [key, node] : ofA) {
        const auto other = ofB.find(key);
        if (with.expect(other != ofB.end(), pa.path, " patch ", key.first,
                        " has another node of its own"))
            pairs.push_back({node, other->second});
    }
    return pairs;
}

/// The patches of an object, and the parts of those that are parted.
std::vector<Pair> patchPairs(Comparison& with, const ObjectPart& pa, const ObjectPart& pb) {
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < pa.patches.count; ++i) {
        std::vector<std::uint32_t> ofA, ofB;
        with.a.forEachPart(pa.patches.first + i, [&](std::uint32_t p) { ofA.push_back(p); });
        with.b.forEachPart(pb.patches.first + i, [&](std::uint32_t p) { ofB.push_back(p); });
        if (!with.expect(ofA.size() == ofB.size(), pa.path, " patch ", i, " has ", ofA.size(),
                         " parts against ", ofB.size()))
            continue;
        for (std::size_t k = 0; k < ofA.size(); ++k) {
            const Patch &a = with.a.patches[ofA[k]], &b = with.b.patches[ofB[k]];
            with.expect(a.centre == b.centre && a.area == b.area &&
                            a.elementCount == b.elementCount &&
                            a.hasCornerNodes == b.hasCornerNodes,
                        pa.path, " patch ", i, " part ", k, " is another");
            pairs.push_back({ofA[k], ofB[k]});
        }
    }
    return pairs;
}

void compareIndirect(Comparison& with, std::span<const Row> rowsA, std::span<const Row> rowsB,
                     std::span<const Pair> senders, std::span<const Pair> nodes,
                     const std::string& sender, const std::string& receiver) {
    for (const Pair& s : senders) {
        const Row &a = rowsA[s.a], &b = rowsB[s.b];
        if (a.empty() || b.empty()) continue;
        for (const Pair& node : nodes) {
            const auto ea = entryOf(a, node.a), eb = entryOf(b, node.b);
            with.expect(sameVisibility(ea, eb), sender, " ", s.a, " onto ", receiver, " node ",
                        node.a, ": ", ea.formFactor, " ", std::hex, ea.visible, " against ",
                        eb.formFactor, " ", eb.visible, std::dec);
        }
    }
}

std::vector<Pair> pairsOf(Range a, Range b) {
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < std::min(a.count, b.count); ++i)
        pairs.push_back({a.first + i, b.first + i});
    return pairs;
}

/// What the elements of one scene are in the other; their indices, Element::kNone if in none.
std::vector<std::uint32_t> elementsIn(const Comparison& with,
                                      const std::map<std::string, const ObjectPart*>& parts) {
    std::vector<std::uint32_t> elements(with.a.elements.size(), Element::kNone);
    for (const ObjectPart& part : with.a.objects) {
        if (parts.count(part.path) == 0) continue;
        for (std::uint32_t i = 0; i < part.elements.count; ++i)
            elements[part.elements.first + i] = parts.at(part.path)->elements.first + i;
    }
    return elements;
}

bool sameHits(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
              const std::vector<std::uint32_t>& elements) {
    constexpr std::uint32_t kAcross = DetailRays::kAcross;
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](auto one, auto other) {
        if (one == Element::kNone || other == Element::kNone) return one == other;
        return elements[one & ~kAcross] == (other & ~kAcross) &&
               (one & kAcross) == (other & kAcross);
    });
}

/// What is seen from the nodes of an object, and whether light gets there.
void compareNodes(Comparison& with, const Solver& a, const Solver& b, const std::string& path,
                  std::span<const Pair> nodes, const std::vector<std::uint32_t>& elements) {
    const NodeHits &hitsA = *a.nodeHits(), &hitsB = *b.nodeHits();
    for (const auto& [na, nb] : nodes) {
        with.expect(with.a.nodes[na].position == with.b.nodes[nb].position &&
                        with.a.nodes[na].normal == with.b.nodes[nb].normal,
                    path, " node ", na, " lies elsewhere");
        if (isPadding(with.a.nodes[na])) continue; // nobody asks what it saw
        with.expect(hitsA.openness(na) == hitsB.openness(nb) &&
                        sameHits(hitsA.hits(na), hitsB.hits(nb), elements),
                    path, " node ", na, " sees other things: ", hitsA.openness(na), " against ",
                    hitsB.openness(nb));
        with.expect(a.indirect().reached(na) == b.indirect().reached(nb), path, " node ", na,
                    " is reached in one only");
    }
}

void compareDetail(Comparison& with, const DetailHits& a, const DetailHits& b, const ObjectPart& pa,
                   const ObjectPart& pb, const std::vector<std::uint32_t>& elements) {
    const auto groupOf = [](std::uint32_t vertex) { return vertex / DetailHits::kGroup; };
    for (std::uint32_t i = 0; i < pa.elements.count; ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t va = with.a.elements[pa.elements.first + i].vertices[k];
            const std::uint32_t vb = with.b.elements[pb.elements.first + i].vertices[k];
            const auto* const one = a.gatherer(va);
            const auto* const other = b.gatherer(vb);
            const bool same = !one || !other
                                  ? one == other
                                  : one->detail == other->detail && one->shut == other->shut &&
                                        one->slit == other->slit && one->near == other->near &&
                                        one->inside == other->inside &&
                                        sameHits(a.hits(groupOf(va), *one),
                                                 b.hits(groupOf(vb), *other), elements);
            with.expect(same, pa.path, " element ", i, " corner ", k,
                        " gathers other indirect light");
        }
}

/// What is drawn of one object's direct light [lux], at blended vertices too.
void compareDrawnDirect(Comparison& with, const Lighting& a, const Lighting& b,
                        const ObjectPart& pa, const ObjectPart& pb) {
    for (std::uint32_t i = 0; i < pa.elements.count; ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const Rgb one = a.direct[with.a.elements[pa.elements.first + i].vertices[k]];
            const Rgb other = b.direct[with.b.elements[pb.elements.first + i].vertices[k]];
            with.expect(maxChannel(absolute(one - other)) <= 1e-5f * (1 + maxChannel(one)), pa.path,
                        " element ", i, " corner ", k, " is lit directly by ", one.g, " against ",
                        other.g);
        }
}

/// What is drawn of one object's indirect light [lux].
void compareDrawn(Comparison& with, const Lighting& a, const Lighting& b, const ObjectPart& pa,
                  const ObjectPart& pb, double allowed) {
    for (std::uint32_t i = 0; i < pa.elements.count; ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const Rgb one = a.indirect[with.a.elements[pa.elements.first + i].vertices[k]];
            const Rgb other = b.indirect[with.b.elements[pb.elements.first + i].vertices[k]];
            with.expect(maxChannel(absolute(one - other)) <= allowed, pa.path, " element ", i,
                        " corner ", k, " receives ", one.r, " ", one.g, " ", one.b, " against ",
                        other.r, " ", other.g, " ", other.b, " of +-", allowed);
        }
}

} // namespace

std::string difference(const LitScene& one, const LitScene& other) {
    Comparison with{one.patches(), other.patches(), {}};
    std::map<std::string, const ObjectPart*> parts;
    for (const ObjectPart& part : with.b.objects)
        if (!part.path.empty()) parts[part.path] = &part;
    for (const ObjectPart& part : with.b.objects)
        with.expect(!part.present ||
                        std::any_of(with.a.objects.begin(), with.a.objects.end(),
                                    [&](const ObjectPart& p) { return p.path == part.path; }),
                    part.path, " is in one only");
    const double allowed =
        one.solver().statistics().certificate + other.solver().statistics().certificate + 1e-4;
    const auto ra = one.solver().radiosity(), rb = other.solver().radiosity();
    const auto rowsA = one.solver().patchRows(), rowsB = other.solver().patchRows();
    // Vertices have as much from nodes, and twice that of the rays that tell them from nodes.
    const double allowedOnVertices = 3 * allowed;
    const Lighting drawnA = one.solver().lighting(), drawnB = other.solver().lighting();
    const std::vector<std::uint32_t> elements = elementsIn(with, parts);
    for (const ObjectPart& pa : with.a.objects) {
        if (parts.count(pa.path) == 0) {
            with.expect(!pa.present, pa.path, " is missing");
            continue;
        }
        const ObjectPart& pb = *parts[pa.path];
        with.expect(pa.present == pb.present, pa.path, " is there in one only");
        if (!with.expect(
                pa.elements.count == pb.elements.count && pa.patches.count == pb.patches.count &&
                    pa.nodes.count == pb.nodes.count && pa.emitters.count == pb.emitters.count,
                pa.path, " is meshed in another way") ||
            !pa.present)
            continue;
        const std::vector<Pair> nodes = nodePairs(with, pa, pb);
        compareDrawnDirect(with, drawnA, drawnB, pa, pb);
        if (one.solver().nodeHits())
            compareNodes(with, one.solver(), other.solver(), pa.path, nodes, elements);
        if (one.solver().detail())
            compareDetail(with, one.solver().detail()->hits(), other.solver().detail()->hits(), pa,
                          pb, elements);
        for (const ObjectPart& sa : with.a.objects) {
            if (!sa.present || parts.count(sa.path) == 0) continue;
            const ObjectPart& sb = *parts[sa.path];
            for (std::uint32_t i = 0; i < sa.emitters.count; ++i)
                compareDirect(with, one.solver().emitterRows()[sa.emitters.first + i],
                              other.solver().emitterRows()[sb.emitters.first + i], pa, pb, sa.path);
            if (rowsA.empty()) continue;
            const IndirectSenders &sendersA = one.solver().indirect().senders(),
                                  &sendersB = other.solver().indirect().senders();
            compareIndirect(with, rowsA, rowsB, patchPairs(with, sa, sb), nodes, sa.path + " patch",
                            pa.path);
            const ObjectId objectA{std::uint32_t(&sa - with.a.objects.data())},
                objectB{std::uint32_t(&sb - with.b.objects.data())};
            compareIndirect(with, rowsA, rowsB,
                            pairsOf(sendersA.clustersOf(objectA), sendersB.clustersOf(objectB)),
                            nodes, sa.path + " cluster", pa.path);
        }
    }
    for (const ObjectPart& pa : with.a.objects) { // what follows from the rest comes last
        if (with.differences > 0 || parts.count(pa.path) == 0) continue;
        const ObjectPart& pb = *parts[pa.path];
        for (const Pair& p : patchPairs(with, pa, pb)) {
            if (with.differences > 0) break;
            const Rgb a = ra[p.a], b = rb[p.b];
            with.expect(maxChannel(absolute(a - b)) <= allowed, pa.path, " patch ", p.a, " sends ",
                        a.g, " against ", b.g, " of +-", allowed);
        }
        if (with.differences == 0 && pa.present)
            compareDrawn(with, drawnA, drawnB, pa, pb, allowedOnVertices);
    }
    if (with.differences > 5) with.said << "and " << with.differences - 5 << " more\n";
    return with.said.str();
}

} // namespace penumbra
