#include "base/Parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <pmmintrin.h>
#include <xmmintrin.h>

#ifndef PENUMBRA_STD_THREADS
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

namespace penumbra {

namespace {

/// Flushes denormals to zero for the time of a block, on this thread.
class FlushDenormals {
public:
    FlushDenormals() : saved_(_mm_getcsr()) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~FlushDenormals() { _mm_setcsr(saved_); }

private:
    unsigned saved_;
};

} // namespace

#ifdef PENUMBRA_STD_THREADS

namespace {
std::atomic<unsigned>& threadLimit() {
    static std::atomic<unsigned> limit{0};
    return limit;
}
} // namespace

void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    const std::size_t ranges = (count + grain - 1) / grain;
    const unsigned wanted =
        threadLimit() ? threadLimit().load() : std::thread::hardware_concurrency();
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex guard;
    const auto work = [&] {
        const FlushDenormals flush;
        for (std::size_t i = next++; i < ranges; i = next++) {
            try {
                body(i * grain, std::min(count, (i + 1) * grain));
            } catch (...) {
                const std::lock_guard lock(guard);
                if (!failure) failure = std::current_exception();
            }
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::min<std::size_t>(wanted, ranges); ++i) threads.emplace_back(work);
    work();
    threads.clear();
    if (failure) std::rethrow_exception(failure);
}

ThreadLimit::ThreadLimit(unsigned threads) : control_(nullptr) {
    threadLimit() = threads;
}
ThreadLimit::~ThreadLimit() {
    threadLimit() = 0;
}

#else

void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    const std::size_t ranges = (count + grain - 1) / grain;
    tbb::parallel_for(std::size_t(0), ranges, [&](std::size_t i) {
        const FlushDenormals flush;
        body(i * grain, std::min(count, (i + 1) * grain));
    });
}

ThreadLimit::ThreadLimit(unsigned threads)
    : control_(threads == 0 ? nullptr
                            : new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                      threads)) {}
ThreadLimit::~ThreadLimit() {
    delete static_cast<tbb::global_control*>(control_);
}

#endif

} // namespace penumbra
