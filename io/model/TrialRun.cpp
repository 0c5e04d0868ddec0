#include "io/model/TrialRun.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace penumbra {

namespace {

// What it says when it breaks down is nobody's business, nor is its memory.
void becomeQuiet(unsigned seconds, unsigned byTheClock) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL); // who waits for it may be killed
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) std::signal(signal, SIG_DFL);
    ::alarm(byTheClock);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
    }
    const rlimit none{0, 0}, time{seconds, seconds};
    ::setrlimit(RLIMIT_CORE, &none);
    ::setrlimit(RLIMIT_CPU, &time);
}

} // namespace

bool survivesTrial(const std::function<void()>& work, unsigned seconds, unsigned byTheClock) {
    const pid_t copy = ::fork();
    if (copy < 0) return true;
    if (copy == 0) {
        becomeQuiet(seconds, byTheClock);
        try {
            work();
        } catch (...) { // the same will be thrown where it is seen
        }
        ::_exit(0);
    }
    int status = 0;
    while (::waitpid(copy, &status, 0) < 0)
        if (errno != EINTR) return true;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace penumbra
