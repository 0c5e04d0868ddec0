// Vertices of PreviewRows that take their light from receivers around them, as radiosity has it
// (DirectLight::factors()): what they see of a light is a mean over these, its form factor is their
// own.
#include "base/Bits.h"
#include "base/Parallel.h"
#include "radiosity/rows/SeenShare.h"
#include "viewer/preview/PreviewRows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra {

/// How much receivers of a blended block see of a light, of what is above their horizon.
class PreviewRows::SeenShares {
public:
    SeenShares(const PreviewRows& rows, const Slot& slot, const Reached& at, std::size_t source)
        : rows_(rows), slot_(slot), object_(at.object), source_(source),
          sources_(rows.surfaces_[at.object].sourcesOf(at.block)), blocks_(sources_.size()) {
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            const std::size_t i = rows.indexOf(object_, sources_[s].block * kBlock);
            blocks_[s].known = slot.found[i * kMostPreviewed + source];
            blocks_[s].shares.fill(kUnasked);
        }
    }

    /// Negative: nothing of the light is above the horizon. Not a number: nothing is known.
    float at(std::uint32_t vertex) {
        const auto from =
            std::ranges::lower_bound(sources_, vertex / std::uint32_t(kBlock), {}, &Source::block);
        Block& block = blocks_[std::size_t(from - sources_.begin())];
        float& share = block.shares[vertex % kBlock];
        if (share == kUnasked) share = ask(*block.known, vertex);
        return share;
    }

private:
    using Source = PreviewSurface::Source;
    static constexpr float kUnasked = -2;
    struct Block {
        const Known* known = nullptr;
        std::array<float, kBlock> shares{};
    };
    float ask(const Known& known, std::uint32_t vertex) const {
        if (!known.of(vertex)) return std::numeric_limits<float>::quiet_NaN();
        const Receiver receiver = rows_.receiver(slot_, object_, vertex);
        const float all = isPadding(receiver) ? 0 : unoccluded(slot_.senders[source_], receiver);
        return all > 0 ? known.factors[vertex % kBlock] / all : -1;
    }

    const PreviewRows& rows_;
    const Slot& slot_;
    std::uint32_t object_;
    std::size_t source_;
    std::span<const Source> sources_;
    std::vector<Block> blocks_;
};

/// Blended vertices are asked of their receivers.
void PreviewRows::addSources() {
    std::vector<Reached> more;
    for (const Reached& at : reached_)
        if (stage_->isBlended(at.object, at.block))
            for (const auto& [block, vertices] : surfaces_[at.object].sourcesOf(at.block))
                more.push_back({at.object, block, at.lights, vertices});
    if (!more.empty()) addReached(std::move(more));
}

/// \pre receivers have been traced, or guessed, as far as there was time
void PreviewRows::blend(Slot& slot) {
    Table& table = &slot == &slots_.front() ? guessed_ : slot.table;
    std::vector<std::pair<std::size_t, Known*>> wanted; // indices as found's
    for (std::size_t i = 0; i < reached_.size(); ++i) {
        const Reached& at = reached_[i];
        if (!stage_->isBlended(at.object, at.block)) continue;
        for (std::size_t l = 0; l < slot.senders.size(); ++l) {
            if (!(at.lights >> l & 1)) continue;
            Known& known = table[keyOf(at, l)];
            slot.found[i * kMostPreviewed + l] = &known;
            if ((at.vertices & ~known.vertices) != 0)
                wanted.emplace_back(i * kMostPreviewed + l, &known);
        }
    }
    parallelFor(wanted.size(), 4, [&](std::size_t first, std::size_t last) {
        for (const auto& [i, known] : std::span(wanted).subspan(first, last - first))
            blend(slot, reached_[i / kMostPreviewed], i % kMostPreviewed, *known);
    });
}

/// What is lit somewhere else than where it is has not the light of its receivers.
void PreviewRows::blend(const Slot& slot, const Reached& at, std::size_t source,
                        Known& known) const {
    SeenShares shares(*this, slot, at, source);
    for (const std::size_t i : bitsOf(at.vertices & ~known.vertices)) {
        const std::size_t vertex = at.block * kBlock + i;
        if (slot.instead.contains(keyOf(at.object, vertex))) continue;
        SeenShare seen;
        stage_->forEachReceiver(at.object, vertex, slot.aside, [&](std::uint32_t v, float weight) {
            seen.add(weight, shares.at(v));
        });
        if (std::isnan(seen.mean())) continue; // a receiver is not known
        known.vertices |= std::uint64_t(1) << i;
        known.factors[i] = 0;
        if (seen.mean() > 0)
            known.factors[i] = seen.mean() * unoccluded(slot.senders[source],
                                                        ownReceiver(slot, at.object, vertex));
    }
}

} // namespace penumbra
