// Something is dragged and let go, as the walkthrough shows it, frame by frame.
#pragma once

#include "PopFigures.h"

#include "viewer/preview/LightBlend.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace penumbra {

/// What is done, at 60 frames a second.
struct DragScript {
    std::string scene;  ///< one of scenes/*.usda, without its ending
    std::string camera; ///< path of a camera; empty: the first
    std::string object; ///< path of the prim that is dragged
    glm::dvec3 way{0};  ///< how far [m]
    int idle = 8;       ///< frames before it is taken hold of
    int held = 2;       ///< frames in the hand before it moves
    int walk = 12;      ///< frames in which the camera turns, for their time alone
    int drag = 12;      ///< frames in motion
    int after = 40;     ///< frames after it is let go
};

struct DragOptions {
    BlendOptions blend;
    float elementSize = 0; ///< [m]; 0: the scene's
    bool indirect = true;  ///< else direct light alone, in black surroundings
    std::size_t named = 0; ///< worst pixels to be reported, see DragResult::worst
    bool motion = false;   ///< what should be seen while it moves is worked out as well
    glm::ivec2 size{640, 360};
};

/// A pixel with a step that can be seen, and what is there.
struct NamedStep {
    PixelStep step; ///< frames counted from the first of DragResult::frames
    std::string object;
    glm::dvec3 position{0}; ///< [m, world]
};

/// What frames of a kind took, from what has changed to a picture that is drawn; reading it back is
/// not counted.
struct FrameTimes {
    std::size_t frames = 0;
    double clock = 0, longest = 0; ///< of all together and of the longest [s]
    /// Of processors, of all threads and all frames [s]: counts when other work keeps the machine
    /// busy.
    double work = 0;

    void add(double seconds, double worked) {
        ++frames;
        clock += seconds;
        longest = std::max(longest, seconds);
        work += worked;
    }
    double mean() const { return frames ? clock / double(frames) : 0; }
    double meanWork() const { return frames ? work / double(frames) : 0; }
};

/// What came of it.
struct DragResult {
    std::vector<FramePair> frames;                    ///< exact: empty where it was not asked for
    std::size_t grabbed = 0, moved = 0, released = 0; ///< first frames of each
    double toDisplay = 1;                             ///< see popFigures()
    double realSeconds = 0;                           ///< that the frames after the release took
    double readySeconds = 0;   ///< of the clock, from the release until no vertex waits
    double settledSeconds = 0; ///< until all light is settled, shown, and at rest
    std::string card;          ///< what drew, as OpenGL calls it
    std::size_t elements = 0;
    std::size_t lights = 0;           ///< previewed
    FrameTimes idle, turning, motion; ///< when nothing moves, when the camera turns, in motion
    /// Bytes of light that are copied to the graphics card: a frame in motion, and in total from
    /// the release on.
    double dragBytes = 0, bytesAfter = 0;
    /// The worst of the first frames in motion, of all of them if that is known, and of the release
    /// and what comes after.
    std::vector<NamedStep> worstAtStart, worstInMotion, worstAtHandOver;
    /// The last picture, at rest, against that of a solution from scratch of the scene as it is:
    /// the largest difference as displayed, in steps of 8 bits, and the share of pixels beyond one.
    int fromScratchMost = 0;
    double fromScratchBeyond = 0;
};

/// Plays it with the renderer off-screen, the blend by the script's clock, and the light in a
/// thread of its own which has as much time a frame as drawing takes, but at least a sixtieth of a
/// second. Then the same once more, settled at each pose, at rest: what should have been seen.
DragResult runDrag(const DragScript& script, const DragOptions& options);

} // namespace penumbra
