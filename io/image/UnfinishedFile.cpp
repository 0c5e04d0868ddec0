#include "io/image/UnfinishedFile.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

namespace penumbra {

namespace {

constexpr std::array kEnding{SIGINT, SIGTERM, SIGHUP};

/// A path where the signal handler finds it: it can't allocate, nor wait for a mutex.
struct Slot {
    std::atomic<bool> taken{false};
    std::atomic<bool> filled{false}; ///< the path is whole
    char path[PATH_MAX];
};

// A signal handler sees nothing but globals.
std::array<Slot, 32> slots;        // more than threads write files at one time
std::atomic<bool> ending{false};   // a signal has come
std::atomic<unsigned> creating{0}; // threads between creating a file and noting its path

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<unsigned>::is_always_lock_free);

/// A thread that creates a file and notes its path. The handler waits until it is done, and so must
/// run on another thread: signals are held back on this one.
class Creating {
public:
    Creating() {
        sigset_t ends;
        sigemptyset(&ends);
        for (const int signal : kEnding) sigaddset(&ends, signal);
        pthread_sigmask(SIG_BLOCK, &ends, &before_);
        ++creating;
    }
    ~Creating() {
        --creating;
        const int error = errno;
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        errno = error;
    }
    Creating(const Creating&) = delete;
    Creating& operator=(const Creating&) = delete;

private:
    sigset_t before_;
};

/// \return -1 if there is none left: the file is only removed if all goes well
int takeSlot(const std::string& path) {
    if (path.size() >= PATH_MAX) return -1;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (slots[i].taken.exchange(true)) continue;
        std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
        slots[i].filled = true;
        return int(i);
    }
    return -1;
}

void freeSlot(int slot) {
    if (slot < 0) return;
    slots[std::size_t(slot)].filled = false;
    slots[std::size_t(slot)].taken = false;
}

/// Calls only what may be called from a signal handler: see signal-safety(7).
void removeAndEnd(int signal) {
    const int error = errno;
    ending = true; // from here on no file is created
    const timespec millisecond{0, 1'000'000};
    for (int waited = 0; creating > 0 && waited < 1000; ++waited) nanosleep(&millisecond, nullptr);
    for (const Slot& slot : slots)
        if (slot.filled) unlink(slot.path);
    struct sigaction standard {};
    standard.sa_handler = SIG_DFL;
    sigaction(signal, &standard, nullptr);
    raise(signal); // held back until this returns; then it ends the process
    errno = error;
}

/// Where a signal has come: nothing more is written, nor reported as an error. Its handler, on
/// another thread, ends the process.
void awaitTheEnd() {
    while (ending) pause();
}

/// Creates a file of a name that was free, and says which.
int createIn(const std::string& folder, std::string& path) {
    for (int attempt = 0;; ++attempt) {
        path = folder + "/.penumbra-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) +
               ".tmp";
        const int number = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (number >= 0 || errno != EEXIST) return number;
    }
}

} // namespace

UnfinishedFile::UnfinishedFile(const std::string& folder) {
    {
        const Creating guard;
        if (!ending) descriptor_ = createIn(folder, path_);
        if (descriptor_ >= 0)
            slot_ = takeSlot(path_);
        else
            path_.clear();
    }
    if (descriptor_ < 0) awaitTheEnd();
}

UnfinishedFile::~UnfinishedFile() {
    close();
    if (!path_.empty()) ::unlink(path_.c_str());
    freeSlot(slot_);
}

bool UnfinishedFile::close() {
    return descriptor_ < 0 || ::close(std::exchange(descriptor_, -1)) == 0;
}

bool UnfinishedFile::renameTo(const std::string& path) {
    if (std::rename(path_.c_str(), path.c_str()) != 0) {
        awaitTheEnd(); // of a file that the signal handler has removed
        return false;
    }
    path_.clear();
    freeSlot(std::exchange(slot_, -1));
    return true;
}

void removeUnfinishedFilesOnSignals() {
    struct sigaction action {};
    action.sa_handler = removeAndEnd;
    sigemptyset(&action.sa_mask);
    for (const int signal : kEnding) sigaddset(&action.sa_mask, signal);
    for (const int signal : kEnding) {
        struct sigaction before {};
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(signal, &action, nullptr);
    }
}

} // namespace penumbra
