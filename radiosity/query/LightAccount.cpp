#include "radiosity/query/LightAccount.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace penumbra {

namespace {

/// Share of an entry's samples that each of its blockers takes, by the samples' weights.
std::vector<double> sharesOf(const RowBlock::Entry& entry, const EmitterSender& sender,
                             const Receiver& receiver) {
    std::vector<double> shares(entry.blockers.size());
    std::uint64_t taken = entry.visible;
    for (const Blocker& blocker : entry.blockers) taken |= blocker.samples;
    double total = 0;
    SampleGroup group;
    for (int first = 0; first < sender.allSamples() && !shares.empty(); first += 16) {
        sender.sampleGroup(receiver, first, group);
        for (int i = 0; i < 16; ++i) {
            if (!(group.rays.used >> i & 1) || !(taken >> (first + i) & 1)) continue;
            total += double(group.weight[i]);
            for (std::size_t b = 0; b < shares.size(); ++b)
                if (entry.blockers[b].samples >> (first + i) & 1)
                    shares[b] += double(group.weight[i]);
        }
    }
    for (double& share : shares) share = total > 0 ? share / total : 0;
    return shares;
}

/// An account in the making, as factors of one emitter's exitance.
struct Factors {
    double unoccluded = 0, arrives = 0;
    std::map<std::uint32_t, double> losses; ///< by object
};

/// Adds what is on record of a receiver. \param factor unoccluded, times weight
void addReceiver(const PatchSet& patches, const DirectLight& light, std::size_t emitter,
                 std::uint32_t v, double factor, Factors& sum) {
    const RowBlock::Entry entry =
        light.rows()[emitter][v / PatchSet::kBlock].entry(int(v % PatchSet::kBlock));
    if (!entry.present) {
        const ObjectId wall = light.wallBefore(std::uint32_t(emitter), v);
        if (!patches.objects[patches.emitters[emitter].object.value].present || !wall.valid())
            return;
        sum.unoccluded += factor;
        sum.losses[wall.value] += factor;
        return;
    }
    sum.unoccluded += factor;
    sum.arrives += factor * double(entry.visibility);
    const std::vector<double> shares =
        sharesOf(entry, light.senders()[emitter], patches.vertices[v].receiver);
    for (std::size_t b = 0; b < shares.size(); ++b)
        sum.losses[entry.blockers[b].object] += factor * shares[b];
}

Factors factorsOf(const PatchSet& patches, const DirectLight& light, std::size_t emitter,
                  const DrawnHit& at) {
    Factors sum;
    const auto formFactor = [&](std::uint32_t v) {
        return double(light.senders()[emitter].formFactor(patches.vertices[v].receiver));
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const double factor = double(at.weights[k]) * formFactor(at.vertices[k]);
        double known = 0; // by receivers of which any of the emitter is above the horizon
        patches.forEachReceiver(at.vertices[k], [&](std::uint32_t v, float weight) {
            if (formFactor(v) > 0) known += double(weight);
        });
        patches.forEachReceiver(at.vertices[k], [&](std::uint32_t v, float weight) {
            if (formFactor(v) > 0)
                addReceiver(patches, light, emitter, v, double(weight) / known * factor, sum);
        });
    }
    return sum;
}

void add(EmitterAccount& light, const Factors& factors, Rgb exitance) {
    light.unoccluded += float(factors.unoccluded) * exitance;
    light.arrives += float(factors.arrives) * exitance;
    for (const auto& [taker, factor] : factors.losses) {
        const ObjectId object{taker};
        auto loss = std::find_if(light.losses.begin(), light.losses.end(),
                                 [&](const LightLoss& l) { return l.object == object; });
        if (loss == light.losses.end()) loss = light.losses.insert(loss, LightLoss{object, Rgb()});
        loss->lux += float(factor) * exitance;
    }
}

} // namespace

std::vector<EmitterAccount> accountForLight(const PatchSet& patches, const DirectLight& light,
                                            const DrawnHit& at) {
    std::map<std::string, EmitterAccount> byPath;
    for (std::size_t e = 0; e < patches.emitters.size(); ++e) {
        const Emitter& emitter = patches.emitters[e];
        EmitterAccount& account = byPath[emitter.path];
        account.path = emitter.path;
        add(account, factorsOf(patches, light, e, at), emitter.exitance);
    }
    std::vector<EmitterAccount> accounts;
    for (auto& [path, account] : byPath) {
        std::stable_sort(account.losses.begin(), account.losses.end(),
                         [](const LightLoss& a, const LightLoss& b) {
                             return luminance(a.lux) > luminance(b.lux);
                         });
        accounts.push_back(std::move(account));
    }
    std::stable_sort(accounts.begin(), accounts.end(),
                     [](const EmitterAccount& a, const EmitterAccount& b) {
                         return std::tuple(luminance(a.lost()), luminance(a.arrives)) >
                                std::tuple(luminance(b.lost()), luminance(b.arrives));
                     });
    return accounts;
}

} // namespace penumbra
