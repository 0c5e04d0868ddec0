// The one parallel loop. Everything that runs on several threads runs through it.
#pragma once

#include <cstddef>
#include <functional>

namespace penumbra {

/// Calls `body(first, last)` for consecutive ranges of about `grain` that together make [0, count),
/// on several threads, and returns when all are done. Ranges must not depend on one another. Their
/// borders depend on `count` and `grain` alone, so results do not depend on the number of threads.
/// An exception of the body is rethrown here. FTZ and DAZ are set while the body runs, as Embree
/// advises.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t first, std::size_t last)>& body);

/// While it lives, parallel loops use at most `threads` threads (0: as many as there are cores).
class ThreadLimit {
public:
    explicit ThreadLimit(unsigned threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    void* control_;
};

} // namespace penumbra
