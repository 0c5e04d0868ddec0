#include "viewer/SessionFile.h"

#include "scenegraph/Error.h"
#include "viewer/Walkthrough.h"

#include <cstdio>
#include <utility>

namespace penumbra {

SessionFile::SessionFile(const Walkthrough& walk, const std::string& scene, std::string layer)
    : recording_(walk.loaded(), scene), layer_(std::move(layer)), start_(walk.time()),
      saved_(walk.time()) {
    sample(walk);
    recording_.write(layer_);
    unsaved_ = false;
}

SessionFile::~SessionFile() {
    for (const std::string& name : recording_.missed())
        std::fprintf(stderr, "%s: warning: what was done to '%s' can't be recorded\n",
                     layer_.c_str(), name.c_str());
    if (!unsaved_) return;
    try {
        recording_.write(layer_);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
}

void SessionFile::sample(const Walkthrough& walk) {
    recording_.sample(walk.time() - start_, walk.rig().toWorld(), walk.rig().lens());
    unsaved_ = true;
}

void SessionFile::take(const Walkthrough& walk) {
    sample(walk);
    if (walk.time() - saved_ < kSaveSeconds) return;
    saved_ = walk.time();
    recording_.write(layer_);
    unsaved_ = false;
}

} // namespace penumbra
