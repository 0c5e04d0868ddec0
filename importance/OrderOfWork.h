// Ways of ordering open work.
#pragma once

#include "importance/PlaceClusters.h"
#include "importance/WorkQueue.h"
#include "importance/WorkValue.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

/// A block of receivers in the row of one sender, with work to be done on it.
struct BlockOfWork {
    std::uint32_t row = 0, block = 0;
    double bound = 0; ///< of the change in what it reflects [lm/m^2]
    double cost = 1;  ///< about [rays]
};

/// What decides which block of open work comes first. Changes the order, never the answer.
class OrderOfWork {
public:
    virtual ~OrderOfWork() = default;

    /// How a block is ranked: its place, which stays, and what the work there is worth.
    virtual WorkQueue::Task rank(const BlockOfWork& work) const = 0;
    /// Whether a block is looked at, before it is worked on, to know what to expect of each of its
    /// receivers; those that are worth it are then worked on before the others.
    virtual bool looks() const { return false; }
    /// What is gained at each receiver of a block that was looked at, in the unit of value().
    /// \param change how far what it reflects is expected to change [lm/m^2]
    virtual void gains(const BlockOfWork& work, std::span<const float> change,
                       std::span<float> gains) const;
    /// Another number whenever gains() may be others.
    virtual std::uint32_t view() const { return 0; }
    /// What all work at a place is worth now; asked for again whenever the view changes.
    virtual PlaceValue value(std::uint32_t place) const = 0;
};

/// Sender by sender, and for each block by block: the original method, and the yardstick.
class PlainOrder : public OrderOfWork {
public:
    WorkQueue::Task rank(const BlockOfWork& work) const override;
    PlaceValue value(std::uint32_t place) const override;
};

/// What may change most per cost, seen or not.
class BoundOrder : public OrderOfWork {
public:
    WorkQueue::Task rank(const BlockOfWork& work) const override;
    PlaceValue value(std::uint32_t place) const override;
};

/// Any order, the same for the same seed.
class RandomOrder : public OrderOfWork {
public:
    explicit RandomOrder(std::uint32_t seed) : seed_(seed) {}
    WorkQueue::Task rank(const BlockOfWork& work) const override;
    PlaceValue value(std::uint32_t place) const override;

private:
    std::uint32_t seed_;
};

/// What the viewer gains most from per cost, see WorkValue.h.
class ImportanceOrder : public OrderOfWork {
public:
    /// What is known of a place when it is asked for: what shows there now, and how many pixels of
    /// it are seen, if that is known.
    struct Sight {
        WorkPlace place;
        std::optional<float> seen;
    };
    using Look = std::function<Sight(std::uint32_t place)>;
    /// The same for some receivers (bits) of a block, and what it comes to.
    using CloseLook =
        std::function<void(std::uint32_t block, std::uint64_t which, std::span<PlaceValue> values)>;

    /// \param placeOf one a block; blocks that have none count as an average one in the picture
    /// \param closeLook without it no block is looked at
    ImportanceOrder(std::vector<std::uint32_t> placeOf, Look look, CloseLook closeLook = {})
        : placeOf_(std::move(placeOf)), look_(std::move(look)), closeLook_(std::move(closeLook)) {}

    /// The viewer has moved, looks elsewhere, is adapted to another luminance. Until the first
    /// time, nobody looks.
    void attend(const Attention& attention) {
        attention_ = attention;
        ++view_;
    }
    /// \pre attend() was called
    const Attention& attention() const { return *attention_; }

    bool looks() const override {
        return closeLook_ && attention_ && attention_->factors.change && attention_->factors.look;
    }
    void gains(const BlockOfWork& work, std::span<const float> change,
               std::span<float> gains) const override;
    std::uint32_t view() const override { return view_; }
    WorkQueue::Task rank(const BlockOfWork& work) const override;
    PlaceValue value(std::uint32_t place) const override;

private:
    PlaceValue averageValue() const;

    std::vector<std::uint32_t> placeOf_;
    Look look_;
    CloseLook closeLook_;
    std::optional<Attention> attention_;
    std::uint32_t view_ = 0;
};

} // namespace penumbra
