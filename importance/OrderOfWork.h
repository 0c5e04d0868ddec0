// Ways of ordering open work.
#pragma once

#include "importance/PlaceClusters.h"
#include "importance/WorkQueue.h"
#include "importance/WorkValue.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace penumbra {

/// What a look at a block said of the work on it.
struct ExpectedChange {
    double change = 0; ///< of what the receivers that change reflect, on average [lm/m^2]
    double share = 1;  ///< of the receivers that change, in (0, 1]
};

/// A block of receivers in the row of one sender, with work to be done on it.
struct BlockOfWork {
    std::uint32_t row = 0, block = 0;
    double bound = 0;                         ///< of the change in what it reflects [lm/m^2]
    double cost = 1;                          ///< about [rays]
    std::optional<ExpectedChange> expected{}; ///< if it was looked at
};

/// What decides which block of open work comes first. Changes the order, never the answer.
class OrderOfWork {
public:
    virtual ~OrderOfWork() = default;

    /// How a block is ranked: its place, which stays, and what the work there is worth.
    virtual WorkQueue::Task rank(const BlockOfWork& work) const = 0;
    /// Whether a block is looked at, before it is worked on, to know what to expect of it.
    virtual bool looks() const { return false; }
    /// Whether what came of a block is taken as a hint of what is beside it.
    virtual bool learns() const { return false; }
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

    /// \param placeOf one a block; blocks that have none count as an average one in the picture
    ImportanceOrder(std::vector<std::uint32_t> placeOf, Look look)
        : placeOf_(std::move(placeOf)), look_(std::move(look)) {}

    /// The viewer has moved, looks elsewhere, is adapted to another luminance. Until the first
    /// time, nobody looks.
    void attend(const Attention& attention) { attention_ = attention; }
    /// \pre attend() was called
    const Attention& attention() const { return *attention_; }

    bool looks() const override {
        return attention_ && attention_->factors.change && attention_->factors.look;
    }
    bool learns() const override { return looks() && attention_->factors.feedback; }
    WorkQueue::Task rank(const BlockOfWork& work) const override;
    PlaceValue value(std::uint32_t place) const override;

private:
    PlaceValue averageValue() const;

    std::vector<std::uint32_t> placeOf_;
    Look look_;
    std::optional<Attention> attention_;
};

} // namespace penumbra
