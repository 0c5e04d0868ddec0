// What vertices see of an emitter that take that from receivers around them.
#pragma once

namespace penumbra {

/// A weighted mean of how much receivers see of an emitter, of what is above their horizon: those
/// with nothing of it above theirs do not count.
class SeenShare {
public:
    /// \param share in [0, 1]; negative: nothing of the emitter is above the receiver's horizon
    void add(float weight, float share) {
        if (share < 0) return;
        weights_ += weight;
        seen_ += weight * share;
    }
    /// 0 where no receiver counts; not a number if the share of one of them is none.
    float mean() const { return weights_ > 0 ? seen_ / weights_ : 0; }

private:
    float weights_ = 0, seen_ = 0;
};

} // namespace penumbra
