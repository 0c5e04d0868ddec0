// Playing the animation of a file in real time.
#pragma once

namespace penumbra {

class Walkthrough;

/// Plays what a file moves: its things, its lights, and its first camera. Who looks through that
/// camera is taken along; who has moved away from it is not.
class Replay {
public:
    /// \param walk has an animation
    Replay(const Walkthrough& walk, bool playing);

    bool playing() const { return playing_; }
    /// Pauses, goes on, or begins anew after the end.
    void toggle(const Walkthrough& walk);
    /// Lets time pass.
    void advance(Walkthrough& walk, double seconds);

    double timeCode() const { return code_; }

private:
    double code_ = 0;
    bool playing_ = false;
};

} // namespace penumbra
