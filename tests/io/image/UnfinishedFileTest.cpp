// Signals: what was not written to its end is gone when the process has ended.
#include "io/image/UnfinishedFile.h"

#include "io/image/AtomicFile.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>

#include <csignal>
#include <functional>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace penumbra {

namespace {

/// A process that does something until a signal ends it.
class Child {
public:
    explicit Child(const std::function<void()>& body) {
        if (pipe(ready_) != 0) throw std::runtime_error("no pipe");
        id_ = fork();
        if (id_ != 0) return;
        removeUnfinishedFilesOnSignals();
        body();
        if (write(ready_[1], "x", 1) != 1) _exit(1);
        for (;;) pause();
    }
    ~Child() {
        close(ready_[0]);
        close(ready_[1]);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Waits until the body has returned.
    void awaitBody() const {
        char byte = 0;
        ASSERT_EQ(read(ready_[0], &byte, 1), 1);
    }
    void send(int signal) const { kill(id_, signal); }
    /// Sends a signal. \return the one that ended the process; 0: none did
    int endBy(int signal) const {
        send(signal);
        int status = 0;
        waitpid(id_, &status, 0);
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

private:
    int ready_[2];
    pid_t id_ = 0;
};

TEST(UnfinishedFile, IsGoneWhenASignalHasEndedTheProcess) {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        const TemporaryFolder folder;
        const Child child([&] {
            static const UnfinishedFile one(folder.path().string()), two(folder.path().string());
            if (write(one.descriptor(), "half of it", 10) != 10) _exit(1);
        });
        child.awaitBody();
        EXPECT_EQ(folder.fileCount(), 2);
        EXPECT_EQ(child.endBy(signal), signal); // who waits for it sees what it was
        EXPECT_EQ(folder.fileCount(), 0);
    }
}

TEST(UnfinishedFile, IsGoneWheneverTheSignalComes) {
    // Two threads write files as fast as they can; many moments, among them those between a file's
    // creation and its name's being noted, and between its renaming and its name's being forgotten.
    for (int moment = 0; moment < 60; ++moment) {
        const TemporaryFolder folder;
        const Child child([&] {
            for (const char* name : {"a", "b"})
                std::thread([path = folder.file(name)] {
                    for (;;) writeFileAtomically(path, "whole");
                }).detach();
        });
        child.awaitBody();
        std::this_thread::sleep_for(std::chrono::microseconds(37 * moment));
        EXPECT_EQ(child.endBy(SIGTERM), SIGTERM);
        for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
            EXPECT_THAT(file.path().filename().string(), testing::AnyOf("a", "b"));
            EXPECT_EQ(std::filesystem::file_size(file), 5u);
        }
    }
}

TEST(UnfinishedFile, OfASignalThatIsIgnoredStays) {
    const TemporaryFolder folder;
    std::signal(SIGHUP, SIG_IGN); // as nohup does
    const Child child([&] { static const UnfinishedFile one(folder.path().string()); });
    std::signal(SIGHUP, SIG_DFL);
    child.awaitBody();
    child.send(SIGHUP);
    EXPECT_EQ(folder.fileCount(), 1);
    EXPECT_EQ(child.endBy(SIGTERM), SIGTERM); // and not by the one before
    EXPECT_EQ(folder.fileCount(), 0);
}

TEST(UnfinishedFile, IsRemovedUnlessItGotItsName) {
    const TemporaryFolder folder;
    {
        UnfinishedFile kept(folder.path().string());
        const UnfinishedFile dropped(folder.path().string());
        EXPECT_EQ(folder.fileCount(), 2);
        EXPECT_TRUE(kept.close() && kept.renameTo(folder.file("kept")));
    }
    EXPECT_EQ(folder.fileCount(), 1);
    EXPECT_TRUE(std::filesystem::exists(folder.file("kept")));
}

} // namespace

} // namespace penumbra
