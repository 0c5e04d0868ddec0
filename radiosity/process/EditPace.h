// How soon the next edit is taken in while edits keep coming.
#pragma once

namespace penumbra {

/// To follow an edit and to find what it concerns takes time. Were each taken in as soon as it
/// comes, as in a drag one a frame, in a large scene all time would go there and none to the light.
/// So an edit waits until what the one before concerns is known, and for as long again: at least
/// half of the time is worked. Where nothing is left to be done it need not wait.
class EditPace {
public:
    /// An edit is about to be followed. \param now of any steady clock [s], as below
    void taken(double now) {
        began_ = now;
        finding_ = true;
    }
    /// Some time was worked. \param found whether all is known that the edit concerns
    void worked(double now, bool found) {
        if (!finding_ || !found) return;
        finding_ = false;
        next_ = now + (now - began_);
    }
    /// Whether the next edit may be taken in, with work left.
    bool mayTake(double now) const { return !finding_ && now >= next_; }

private:
    double began_ = 0, next_ = 0; ///< [s]
    bool finding_ = false;
};

} // namespace penumbra
