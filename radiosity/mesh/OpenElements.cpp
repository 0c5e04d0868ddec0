#include "radiosity/mesh/OpenElements.h"

#include "base/Parallel.h"
#include "radiosity/surface/UnionFind.h"

#include <algorithm>
#include <array>
#include <functional>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = Element::kNone;

/// Traces segments in packets and notes which of some numbered things any of theirs is blocked of.
class Segments {
public:
    Segments(const RayScene& rays, std::vector<std::uint8_t>& blocked)
        : rays_(rays), blocked_(blocked) {}

    void add(std::uint32_t of, glm::vec3 from, glm::vec3 to) {
        of_[std::size_t(count_)] = of;
        packet_.set(count_, from, to);
        if (++count_ == ShadowRays::kMost) trace();
    }
    void trace() {
        if (count_ == 0) return;
        rays_.occluded(packet_);
        for (int i = 0; i < count_; ++i)
            if (packet_.blocker[i] != ObjectId::kNone) blocked_[of_[std::size_t(i)]] = 1;
        packet_.used = 0;
        count_ = 0;
    }

private:
    const RayScene& rays_;
    std::vector<std::uint8_t>& blocked_;
    ShadowRays packet_;
    std::array<std::uint32_t, ShadowRays::kMost> of_{};
    int count_ = 0;
};

/// A point farther on than `to` [m]: segments are tested up to a hair before their end, but what is
/// to be found may be nearer to it.
glm::vec3 beyond(glm::vec3 from, glm::vec3 to, float by) {
    const float length = glm::distance(from, to);
    return length > 0 ? to + by / length * (to - from) : to;
}

/// Two corners, number of the element * 4 + corner, at one vertex.
struct CornerPair {
    std::uint32_t a = 0, b = 0;
};

class OpenElements {
public:
    OpenElements(const RayScene& rays, const ContactResolver& resolver,
                 const std::vector<Element>& all, std::span<const std::uint32_t> which)
        : rays_(rays), resolver_(resolver), all_(all), which_(which), near_(which.size()),
          held_(which.size()), cover_(which.size()) {}

    /// Looks for what covers corners and middles, and for what stands between them.
    void look() {
        parallelFor(which_.size(), 256, [&](std::size_t first, std::size_t last) {
            Segments segments(rays_, near_);
            std::vector<ContactResolver::Places> places;
            for (std::size_t i = first; i < last; ++i) {
                places.push_back(resolver_.placesOf(all_[which_[i]]));
                const ContactResolver::Places& at = places.back();
                const glm::vec3 up = 2 * at.cover * leaving(at.normal);
                segments.add(std::uint32_t(i), at.middle, at.middle + up);
                for (std::size_t k = 0; k < at.count; ++k)
                    segments.add(std::uint32_t(i), at.corner[k], at.corner[k] + up);
                cover_[i] = at.cover;
                held_[i] = rays_.solidsEnd(at.middle, leaving(at.normal)) > 0;
            }
            segments.trace();
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t k = 0; near_[i] == 0 && k < places[i - first].count; ++k)
                    segments.add(std::uint32_t(i), places[i - first].corner[k],
                                 beyond(places[i - first].corner[k], places[i - first].middle,
                                        places[i - first].cover));
            segments.trace();
        });
    }

    /// Asks one for all that hang together whether it is inside of a solid.
    void askWhetherBuried(const Fans& fans, std::span<const RayMesh> meshes) {
        const std::vector<CornerPair> pairs = pairsAtVertices(fans);
        std::vector<std::uint8_t> parted(pairs.size());
        parallelFor(pairs.size(), 1024, [&](std::size_t first, std::size_t last) {
            Segments segments(rays_, parted);
            for (std::size_t i = first; i < last; ++i)
                segments.add(
                    std::uint32_t(i), cornerOf(pairs[i].a),
                    beyond(cornerOf(pairs[i].a), cornerOf(pairs[i].b), cover_[pairs[i].b / 4]));
            segments.trace();
        });
        UnionFind sets(which_.size());
        for (std::size_t i = 0; i < pairs.size(); ++i)
            if (parted[i] == 0) sets.join(pairs[i].a / 4, pairs[i].b / 4);
        std::vector<Some> some(which_.size());
        std::vector<std::uint32_t> named, buried;
        for (std::uint32_t i = 0; i < which_.size(); ++i) {
            if (!concerned(i)) continue;
            Some& of = some[sets.find(i)];
            if (of.count == 0) named.push_back(i);
            if (of.count < of.members.size()) of.members[of.count++] = i;
        }
        parallelFor(named.size(), 16, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                some[named[i]].buried = areBuried(some[named[i]], meshes);
        });
        for (std::uint32_t i = 0; i < which_.size(); ++i)
            if (concerned(i) && some[sets.find(i)].buried) buried.push_back(i);
        for (const std::uint32_t i : buried) near_[i] = 1;
    }

    std::vector<std::uint8_t> take() {
        for (std::uint8_t& each : near_) each = each == 0;
        return std::move(near_);
    }

private:
    /// Of elements that hang together.
    struct Some {
        std::array<std::uint32_t, 3> members{};
        std::size_t count = 0;
        bool buried = false;
    };
    /// What a ray counts along edges may be wrong: the first that says so needs another.
    bool areBuried(const Some& some, std::span<const RayMesh> meshes) const {
        std::size_t buried = 0;
        for (std::size_t i = 0; i < some.count; ++i) {
            const auto at = resolver_.placesOf(all_[which_[some.members[i]]]);
            if (lieOf(rays_, meshes, at.middle, at.normal, at.cover) == Lie::buried) ++buried;
            if (buried == 0) return false;
        }
        return 2 * buried > some.count;
    }
    bool concerned(std::uint32_t i) const { return held_[i] != 0 && near_[i] == 0; }
    glm::vec3 cornerOf(std::uint32_t corner) const {
        return resolver_.cornerOf(all_[which_[corner / 4]], corner % 4);
    }

    /// Corners at one vertex, each with the first one there. An element's own hang together.
    std::vector<CornerPair> pairsAtVertices(const Fans& fans) const {
        std::vector<CornerPair> pairs;
        for (std::uint32_t i = 0; i < which_.size(); ++i) {
            if (!concerned(i)) continue;
            const Element& element = all_[which_[i]];
            for (std::uint32_t k = 0; k < (element.isTriangle() ? 3u : 4u); ++k) {
                const std::uint32_t first = firstAt(fans.at(element.vertices[k]));
                if (first / 4 != i) pairs.push_back({first, 4 * i + k});
            }
        }
        return pairs;
    }
    std::uint32_t firstAt(std::span<const std::uint32_t> fan) const {
        for (const std::uint32_t corner : fan) {
            const auto at = std::ranges::lower_bound(which_, corner / 4);
            if (at == which_.end() || *at != corner / 4) continue;
            const auto i = std::uint32_t(at - which_.begin());
            if (concerned(i)) return 4 * i + corner % 4;
        }
        return kNone; // never: who asks is one
    }

    const RayScene& rays_;
    const ContactResolver& resolver_;
    const std::vector<Element>& all_;
    std::span<const std::uint32_t> which_;
    std::vector<std::uint8_t> near_; ///< 1: something is, or it is buried
    std::vector<std::uint8_t> held_; ///< 1: in the box of something solid
    std::vector<float> cover_;       ///< see coverDistance()
};

} // namespace

std::vector<std::uint8_t> findOpen(const RayScene& rays, std::span<const RayMesh> meshes,
                                   const ContactResolver& resolver, const std::vector<Element>& all,
                                   const Fans& fans, std::span<const std::uint32_t> which) {
    OpenElements elements(rays, resolver, all, which);
    elements.look();
    elements.askWhetherBuried(fans, meshes);
    return elements.take();
}

} // namespace penumbra
