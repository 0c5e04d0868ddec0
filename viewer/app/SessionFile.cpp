#include "viewer/app/SessionFile.h"

#include "base/Error.h"
#include "viewer/input/Walkthrough.h"

#include <cstdio>
#include <utility>

namespace penumbra {

SessionFile::SessionFile(const Walkthrough& walk, const std::string& scene, std::string layer)
    : recording_(walk.loaded(), scene), layer_(std::move(layer)), start_(walk.time()),
      tried_(walk.time()) {
    sample(walk);
    recording_.write(layer_);
    unsaved_ = false;
}

SessionFile::~SessionFile() {
    for (const std::string& name : recording_.missed())
        std::fprintf(stderr, "%s: warning: what was done to '%s' can't be recorded\n",
                     layer_.c_str(), name.c_str());
    try {
        finish();
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
}

void SessionFile::sample(const Walkthrough& walk) {
    recording_.follow(walk.loaded().addresses);
    recording_.sample(walk.time() - start_, walk.rig().toWorld(), walk.rig().lens());
    unsaved_ = true;
}

std::optional<std::string> SessionFile::take(const Walkthrough& walk) {
    sample(walk);
    if (walk.time() - tried_ < kSaveSeconds) return std::nullopt;
    tried_ = walk.time();
    try {
        recording_.write(layer_);
    } catch (const Error& error) {
        return error.what();
    }
    unsaved_ = false;
    return std::nullopt;
}

void SessionFile::finish() {
    if (std::exchange(unsaved_, false)) recording_.write(layer_);
}

} // namespace penumbra
