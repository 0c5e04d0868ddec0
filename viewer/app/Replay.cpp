#include "viewer/app/Replay.h"

#include "viewer/input/Walkthrough.h"

#include <algorithm>

namespace penumbra {

Replay::Replay(const Walkthrough& walk, bool playing)
    : code_(walk.scene().startTimeCode), playing_(playing) {}

void Replay::toggle(const Walkthrough& walk) {
    playing_ = !playing_;
    if (playing_ && code_ >= walk.scene().endTimeCode) code_ = walk.scene().startTimeCode;
}

void Replay::advance(Walkthrough& walk, double seconds) {
    if (!playing_) return;
    const Scene& scene = walk.scene();
    code_ = std::min(scene.endTimeCode, code_ + seconds * scene.timeCodesPerSecond);
    const bool looksThrough =
        !walk.bookmarks().empty() && walk.rig().pose() == walk.bookmarks().front().pose;
    walk.loaded().animation->setTime(code_);
    walk.followScene();
    if (looksThrough) {
        const Bookmark& camera = walk.bookmarks().front();
        walk.rig().put(camera.pose, camera.lens);
    }
    if (code_ >= scene.endTimeCode) playing_ = false;
}

} // namespace penumbra
