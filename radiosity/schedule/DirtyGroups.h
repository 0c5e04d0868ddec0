// Dirty groups of receivers.
#pragma once

#include "base/BoundsTree.h"
#include "radiosity/mesh/PatchSet.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// Which groups of kSize consecutive receivers have to find again what they see, and because of
/// what. Found by the boxes around all that their rays cross, and worked on in the order in which
/// they were found.
class DirtyGroups {
public:
    static constexpr std::uint32_t kSize = 16;
    static constexpr std::uint32_t kAll = (1u << kSize) - 1;

    struct Dirty {
        std::vector<std::uint32_t> moved; ///< objects that may be or have been in its rays' ways
        std::uint32_t anew = 0;           ///< bits: receivers of which nothing is known
        bool judge = false;               ///< even if all of them see what they saw
    };

    /// New groups are wholly dirty.
    void resize(std::size_t receivers) {
        for (std::size_t g = groups_.size(); g < receivers / kSize; ++g) {
            groups_.emplace_back();
            queued_.push_back(0);
            ways_.append({});
            add(std::uint32_t(g), kAll);
        }
    }
    std::size_t size() const { return groups_.size(); }
    /// Nothing is dirty any more: all is known from elsewhere.
    /// \param ways one a group: around all that its rays cross
    void takeOver(std::vector<Bounds> ways) {
        ways_.assign(std::move(ways));
        groups_.assign(groups_.size(), {});
        queued_.assign(queued_.size(), 0);
        queue_.clear();
        next_ = 0;
    }
    const Bounds& ways(std::uint32_t group) const { return ways_[group]; }

    void add(std::uint32_t group, std::uint32_t anew) {
        groups_[group].anew |= anew;
        groups_[group].judge = true;
        enqueue(group);
    }
    void addAll(Range receivers) {
        for (std::uint32_t g = receivers.first / kSize; g * kSize < receivers.end(); ++g)
            add(g, kAll);
    }
    /// An object has been in one box and is in another [m, world].
    void addMoved(std::uint32_t object, const Bounds& before, const Bounds& now) {
        find(before, now, [&](std::uint32_t group) {
            auto& moved = groups_[group].moved;
            if (std::find(moved.begin(), moved.end(), object) == moved.end())
                moved.push_back(object);
            enqueue(group);
        });
    }
    void addRegion(const Bounds& region) {
        find(region, region, [&](std::uint32_t group) { add(group, kAll); });
    }

    bool done() const { return next_ == queue_.size(); }
    std::size_t left() const { return queue_.size() - next_; }
    bool isDirty(std::uint32_t group) const { return queued_[group] != 0; }
    const Dirty& operator[](std::uint32_t group) const { return groups_[group]; }
    /// The next groups, of about `effort` rays. Valid until something is added.
    /// \param rays that a receiver of which nothing is known takes, about
    std::span<const std::uint32_t> next(std::size_t effort, std::size_t rays) const {
        std::size_t count = 0;
        for (std::size_t sum = 0; sum < effort && next_ + count < queue_.size(); ++count) {
            const Dirty& dirty = groups_[queue_[next_ + count]];
            sum += 8 + std::size_t(std::popcount(dirty.anew)) * rays + 64 * dirty.moved.size();
        }
        return std::span(queue_).subspan(next_, count);
    }
    /// The first `groups` of these are done.
    /// \param ways one a group: around what was followed
    void clean(std::span<const Bounds> ways) {
        for (const Bounds& way : ways) {
            const std::uint32_t group = queue_[next_++];
            Bounds all = groups_[group].anew == kAll ? Bounds() : ways_[group];
            all.add(way);
            ways_.set(group, all);
            groups_[group] = {};
            queued_[group] = 0;
        }
        if (!done()) return;
        queue_.clear();
        next_ = 0;
    }

private:
    void enqueue(std::uint32_t group) {
        if (!std::exchange(queued_[group], std::uint8_t(1))) queue_.push_back(group);
    }
    template <class Visit>
    void find(const Bounds& a, const Bounds& b, const Visit& visit) const {
        ways_.query(
            [&](std::size_t n) {
                return (!a.empty() && ways_.node(n).overlaps(a)) ||
                       (!b.empty() && ways_.node(n).overlaps(b));
            },
            [&](std::size_t group) { visit(std::uint32_t(group)); });
    }

    BoundsTree ways_;
    std::vector<Dirty> groups_;
    std::vector<std::uint8_t> queued_;
    std::vector<std::uint32_t> queue_;
    std::size_t next_ = 0;
};

} // namespace penumbra
