#include "viewer/app/Signals.h"

#include "base/Error.h"

#include <sys/signalfd.h>
#include <unistd.h>

namespace penumbra {

Signals::Signals() {
    sigset_t ends;
    sigemptyset(&ends);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, number);
    pthread_sigmask(SIG_BLOCK, &ends, &before_);
    descriptor_ = signalfd(-1, &ends, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ >= 0) return;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    throw Error("can't listen to signals (too many open files?)");
}

Signals::~Signals() {
    close(descriptor_);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool Signals::endWanted() {
    signalfd_siginfo info;
    while (read(descriptor_, &info, sizeof info) == ssize_t(sizeof info)) wanted_ = true;
    return wanted_;
}

} // namespace penumbra
