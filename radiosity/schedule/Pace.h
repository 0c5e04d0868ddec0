// How large pieces of work are to be.
#pragma once

#include "base/Clock.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace penumbra {

/// Sizes pieces of work so that each takes about as long as is wanted, by how long pieces of its
/// kind took before. Efforts are in rays, but a ray's worth of one kind of work takes longer than
/// that of another, and on another day.
class Pace {
public:
    enum Kind { direct, sums, nodes, rows, completion, relaxation, detail, sweeps, kKinds };

    /// Pieces of one size. \param effort [rays]
    explicit Pace(std::size_t effort) : most_(effort), least_(effort) {}
    using Clock = double (*)(); ///< [s]
    /// Pieces that follow the time.
    explicit Pace(Clock clock = &steadySeconds) : clock_(clock) { perRay_.fill(kFirstGuess); }

    /// How long pieces should take from now on [s], and how large they may be at most [rays].
    void aim(double seconds, std::size_t most) {
        aim_ = seconds;
        most_ = most;
    }

    /// Does a piece of work of a kind; `piece(effort)` returns whether there was anything to do,
    /// and so does this.
    template <class Piece>
    bool work(Kind kind, const Piece& piece) {
        const std::size_t effort = effortOf(kind);
        const double start = clock_();
        const bool any = piece(effort);
        learn(kind, any ? (clock_() - start) / double(effort) : 0);
        return any;
    }

    /// How long a ray's worth of a kind of work takes [s].
    double secondsPerRay(Kind kind) const { return perRay_[kind]; }

private:
    static constexpr double kFirstGuess = 1e-6; ///< [s/ray]

    std::size_t effortOf(Kind kind) const {
        const double wanted = perRay_[kind] > 0 ? aim_ / perRay_[kind] : 0;
        return std::size_t(std::clamp(wanted, double(least_), double(most_)));
    }
    /// Slower pieces count at once, unless one was held up for once; faster ones little by little,
    /// and when another has come after them: the last of its kind is fast for it had little to do.
    /// \param perRay 0: there was nothing to do
    void learn(Kind kind, double perRay) {
        double& known = perRay_[kind];
        const double before = std::exchange(faster_[kind], 0);
        if (perRay > 0 && before > 0) known = 0.75 * known + 0.25 * before;
        if (perRay > known)
            known = std::min(perRay, 2 * known);
        else
            faster_[kind] = perRay;
    }

    std::array<double, kKinds> perRay_{}; ///< [s]
    std::array<double, kKinds> faster_{}; ///< than known: the piece before, if it was
    Clock clock_ = &steadySeconds;
    double aim_ = 0;
    std::size_t most_ = 0, least_ = 128;
};

} // namespace penumbra
