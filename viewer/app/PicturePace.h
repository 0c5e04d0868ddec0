// When the walkthrough draws its next picture.
#pragma once

#include <algorithm>

namespace penumbra {

/// A window that nothing happens in is not drawn again. What people do is shown at once. News that
/// come by themselves, such as light, are drawn at once by a graphics card; where the processor
/// draws, it is left to those who compute the light most of the time, unless something was done
/// just now: then people wait for it. Times are of any steady clock [s].
class PicturePace {
public:
    /// \param software the processor draws
    explicit PicturePace(bool software) : software_(software) {}

    /// Something was done, by a hand.
    void touched(double now) {
        stale_ = kAfterglow;
        touched_ = now;
    }
    /// The picture is another one, for another reason.
    void changed() { stale_ = kAfterglow; }
    /// Something that nobody waits for has come. \param pictures that it changes
    void news(int pictures = kAfterglow) { news_ = std::max(news_, pictures); }

    /// Something fades. Of what was done this is shown smoothly; of what comes by itself it is
    /// news.
    void fades(double now) {
        if (now < touched_ + kFade)
            stale_ = std::max(stale_, 1);
        else
            news(1);
    }

    bool due(double now) const { return stale_ > 0 || (news_ > 0 && !rests(now)); }

    /// Whether it matters how long the next picture takes: to wait for it takes time itself.
    bool measures(double now) const { return software_ && isAlone(now); }
    /// A picture was drawn, in so long.
    void drawn(double now, double took) {
        stale_ = std::max(0, stale_ - 1);
        news_ = std::max(0, news_ - 1);
        if (software_) restsUntil_ = now + kRest * took;
    }

private:
    static constexpr int kAfterglow = 3; ///< pictures that follow the last event: panels need some
    static constexpr double kAttention = 2; ///< after the last event people wait for something
    static constexpr double kFade = 10;     ///< what fades by then comes of it
    static constexpr double kRest = 5;      ///< as many times what a picture takes

    bool isAlone(double now) const { return now > touched_ + kAttention; }
    bool rests(double now) const { return isAlone(now) && now < restsUntil_; }

    bool software_;
    int stale_ = kAfterglow, news_ = 0; ///< pictures to be drawn
    double touched_ = -kFade, restsUntil_ = 0;
};

} // namespace penumbra
