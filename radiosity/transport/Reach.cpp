#include "radiosity/transport/Reach.h"

#include "base/Parallel.h"
#include "radiosity/mesh/DrawnSurface.h"
#include "radiosity/rows/HemisphereRays.h"

namespace penumbra {

namespace {

constexpr std::size_t kRays = 16;

} // namespace

Reach::Reach(const PatchSet& set) : set_(&set), seen_(set.nodes.size() * kRays, Element::kNone) {
    const DrawnSurface surface(set);
    const HemisphereRays rays(kRays);
    parallelFor(set.nodes.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            const Receiver& node = set.uncoveredNodes[n];
            if (isPadding(node)) continue;
            for (std::size_t r = 0; r < kRays; ++r) {
                const auto hit =
                    surface.nearest(node.position, rays.direction(int(r), node.normal), 1e30f);
                if (hit.met()) seen_[n * kRays + r] = set.elements[hit.element].patch;
            }
        }
    });
}

std::vector<std::uint64_t> Reach::spread(std::span<const std::uint8_t> lit) const {
    std::vector<std::uint8_t> bright(lit.begin(), lit.end()), reached(set_->nodes.size());
    for (std::size_t n = 0; n < reached.size(); ++n)
        reached[n] = !isPadding(set_->nodes[n]);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t n = 0; n < reached.size(); ++n)
            for (std::size_t r = n * kRays; !reached[n] && r < (n + 1) * kRays; ++r)
                reached[n] = seen_[r] != Element::kNone && bright[seen_[r]];
        for (std::size_t p = 0; p < bright.size(); ++p) {
            const Patch& patch = set_->patches[p];
            bool any = reached[patch.centreNode];
            if (patch.hasCornerNodes)
                for (std::uint32_t node : patch.cornerNodes) any |= reached[node];
            if (!any || bright[p]) continue;
            bright[p] = true;
            changed = true;
        }
    }
    std::vector<std::uint64_t> bits((reached.size() + 63) / 64);
    for (std::size_t n = 0; n < reached.size(); ++n)
        bits[n / 64] |= std::uint64_t(reached[n]) << n % 64;
    return bits;
}

} // namespace penumbra
