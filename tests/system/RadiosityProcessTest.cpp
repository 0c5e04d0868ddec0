#include "radiosity/process/ProcessLink.h"
#include "tests/support/LitNode.h"
#include "tests/system/Program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace penumbra {

namespace {

using Phase = RadiosityState::Phase;
using namespace std::chrono_literals;

std::unique_ptr<LightingLink> processLink() {
    return makeProcessLink({.program = PENUMBRA_PROGRAM, .byHand = {}});
}

/// Processes that this one has started and not waited for.
std::vector<pid_t> children(pid_t parent = getpid()) {
    std::vector<pid_t> all;
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(parent) + "/task")) {
        std::ifstream list(task.path() / "children");
        for (pid_t child; list >> child;) all.push_back(child);
    }
    return all;
}

/// Where shared memory can be opened that a process has made.
std::vector<std::filesystem::path> segmentsOf(pid_t process) {
    std::vector<std::filesystem::path> places;
    std::error_code ended;
    for (const auto& file :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/fd", ended)) {
        const auto target = std::filesystem::read_symlink(file, ended);
        if (target.string().starts_with("/memfd:penumbra-")) places.push_back(file);
    }
    return places;
}

/// Shared memory of a process that has a name in a folder: it would stay when nobody has it.
bool leavesSegments(pid_t process) {
    const std::string prefix = "penumbra-" + std::to_string(process) + "-";
    return std::ranges::any_of(
        std::filesystem::directory_iterator("/dev/shm"),
        [&](const auto& file) { return file.path().filename().string().starts_with(prefix); });
}

bool becomes(const std::function<bool()>& what, std::chrono::duration<double> within = 20s) {
    const auto end = std::chrono::steady_clock::now() + within;
    while (!what()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(5ms);
    }
    return true;
}

bool isGone(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string number, name, state;
    return !(status >> number >> name >> state) || state == "Z";
}

/// What update() took of this thread.
struct FrameCost {
    double worst = 0; ///< processor time of a frame [s]
    long waits = 0;   ///< times that the thread gave up its core of its own accord
    std::uint64_t frames = 0;
};

void frame(RadiosityNode& node, FrameCost& cost) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
    };
    const auto waits = [] {
        rusage usage{};
        getrusage(RUSAGE_THREAD, &usage);
        return usage.ru_nvcsw;
    };
    const double start = now();
    const long before = waits();
    node.update();
    cost.waits += waits() - before;
    cost.worst = std::max(cost.worst, now() - start);
    ++cost.frames;
}

TEST(RadiosityProcess, LightsAndFollowsLikeAThread) {
    LitRoom room(processLink());
    ASSERT_TRUE(updateUntilSettled(*room.node)) << describe(*room.node);
    EXPECT_EQ(room.difference(), "");
    room.box->setMatrix(moved(0.7, 0.2, 0));
    room.light->setLuminance(Rgb(30, 60, 90));
    ASSERT_TRUE(updateUntilSettled(*room.node)) << describe(*room.node);
    EXPECT_EQ(room.difference(), "");
    EXPECT_EQ(room.node->state().restarts, 0u);
}

TEST(RadiosityProcess, SaysWhatIsOpenIfAsked) {
    LitRoom room(processLink());
    ASSERT_TRUE(updateUntilSettled(*room.node)) << describe(*room.node);
    EXPECT_TRUE(room.node->dirtyBlocks().empty());
    room.node->watchDirty(true);
    EXPECT_TRUE(updateUntil(*room.node, [&] {
        const auto work = room.node->dirtyBlocks();
        return !work.empty() && !work[0].empty();
    })) << describe(*room.node);
    room.node->watchDirty(false);
    EXPECT_TRUE(room.node->dirtyBlocks().empty());
}

TEST(RadiosityProcess, NamesOfSharedMemoryAreThereForAMomentAndForNobodyElse) {
    LitRoom room(processLink());
    bool seen = false;
    ASSERT_TRUE(updateUntil(*room.node, [&] {
        for (const std::filesystem::path& place : segmentsOf(getpid())) {
            struct stat facts {};
            if (stat(place.c_str(), &facts) != 0) continue;
            seen = true;
            EXPECT_EQ(facts.st_mode & 0777, 0600u);
        }
        return room.node->state().reached(SolutionState::certified);
    }));
    EXPECT_TRUE(seen);
    EXPECT_TRUE(segmentsOf(getpid()).empty()); // unlinked as soon as program and worker had them
    EXPECT_FALSE(leavesSegments(getpid()));
}

TEST(RadiosityProcess, KilledOrStoppedAtAnyMomentItIsReplacedAndTheLightIsTheSame) {
    const char* const wanted = std::getenv("PENUMBRA_KILLS");
    const int kills = wanted ? std::atoi(wanted) : 100;
    RadiosityOptions options = LitRoom::smallRoomOptions();
    options.timeout = 0.3;
    LitRoom room(processLink(), options);
    std::mt19937 random(1);
    FrameCost cost;
    int done = 0;
    for (double time = 0; done < kills; time += 0.1) { // a drag along a figure of eight
        room.box->setMatrix(moved(1.2 * std::sin(time), 1.2 * std::sin(2 * time), 0));
        if (random() % 10 == 0) room.light->setLuminance(Rgb(float(50 + random() % 100)));
        frame(*room.node, cost);
        std::this_thread::sleep_for(4ms);
        if (random() % 15 != 0) continue;
        const std::vector<pid_t> processes = children();
        for (pid_t process : processes)
            if (!isGone(process)) done += kill(process, done % 10 == 9 ? SIGSTOP : SIGKILL) == 0;
    }
    ASSERT_TRUE(updateUntilSettled(*room.node, 60)) << describe(*room.node);
    EXPECT_EQ(room.difference(), "");
    EXPECT_GE(int(room.node->state().restarts), kills / 2); // some hit one that was going anyway
    EXPECT_LT(cost.worst, 0.05) << cost.frames << " frames";
    RecordProperty("waits", int(cost.waits));
    EXPECT_LE(cost.waits, long(room.node->state().restarts + 1)) << "only to start a process";
    EXPECT_TRUE(segmentsOf(getpid()).empty());
    room.node.reset();
    EXPECT_TRUE(becomes([] { return children().empty(); }));
}

TEST(RadiosityProcess, SaysOnceThatItWasKilled) {
    LitRoom room(processLink());
    ASSERT_TRUE(updateUntilSettled(*room.node));
    EXPECT_TRUE(room.node->takeMessages().empty());
    const auto geometry = room.node->objects()[0].geometry;
    kill(children().at(0), SIGKILL);
    ASSERT_TRUE(updateUntil(*room.node, [&] { return room.node->state().restarts > 0; }));
    EXPECT_EQ(room.node->objects()[0].geometry, geometry); // goes on with what there is
    ASSERT_TRUE(updateUntilSettled(*room.node));
    const std::vector<std::string> messages = room.node->takeMessages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("Killed"), std::string::npos) << messages[0];
}

TEST(RadiosityProcess, OutOfMemoryIsAnEndLikeAnyOther) {
    LitRoom room(processLink());
    ASSERT_TRUE(updateUntilSettled(*room.node));
    const rlimit little{1 << 20, 1 << 20};
    ASSERT_EQ(prlimit(children().at(0), RLIMIT_AS, &little, nullptr), 0);
    room.node->add(object("shelf", boxData({1, 1, 1}, {1.5f, 1.5f, 1.1f}, false)));
    ASSERT_TRUE(updateUntilSettled(*room.node)) << describe(*room.node);
    EXPECT_EQ(room.node->state().restarts, 1u);
    EXPECT_EQ(room.difference(), "");
}

TEST(RadiosityProcess, EndsWithItsViewerAndLeavesNothingBehind) {
    for (int delay : {0, 5, 20, 60, 200}) { // while it starts, and when it is there [ms]
        const pid_t viewer = fork();
        ASSERT_GE(viewer, 0);
        if (viewer == 0) {
            LitRoom room(processLink());
            updateUntil(*room.node, [] { return false; });
            _exit(0);
        }
        std::vector<pid_t> workers;
        ASSERT_TRUE(becomes([&] { return !(workers = children(viewer)).empty(); }));
        std::this_thread::sleep_for(std::chrono::milliseconds(delay));
        kill(viewer, SIGKILL);
        waitpid(viewer, nullptr, 0);
        EXPECT_TRUE(becomes([&] { return isGone(workers[0]); })) << "an orphan";
        EXPECT_FALSE(leavesSegments(viewer)) << delay;
    }
}

TEST(RadiosityProcess, CanBeStartedByHand) {
    std::string name;
    LitRoom room(
        makeProcessLink({.program = {}, .byHand = [&](const std::string& n) { name = n; }}));
    room.node->update();
    ASSERT_FALSE(name.empty());
    EXPECT_EQ(room.node->state().phase, Phase::connecting);
    std::thread people([&] { EXPECT_EQ(runPenumbra({"radiosity", name}).exitCode, 0); });
    EXPECT_TRUE(updateUntilSettled(*room.node)) << describe(*room.node);
    EXPECT_EQ(room.difference(), "");
    room.node.reset(); // tells it to stop
    people.join();
}

TEST(RadiosityProcess, SaysThatNobodyWaitsForIt) {
    const Outcome outcome = runPenumbra({"radiosity", "penumbra-1-0123"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.err.find("no viewer waits"), std::string::npos) << outcome.err;
    EXPECT_EQ(lineCount(outcome.err), 1u);
    EXPECT_EQ(runPenumbra({"radiosity", "/etc/passwd"}).exitCode, 1);
    EXPECT_EQ(runPenumbra({"radiosity"}).exitCode, 2);
}

TEST(RadiosityProcess, AProgramThatCannotBeStartedIsSaidOnceAndTriedAgain) {
    LitRoom room(makeProcessLink({.program = "/nowhere/penumbra", .byHand = {}}));
    updateUntil(*room.node, [&] { return room.node->state().restarts > 1; });
    EXPECT_EQ(room.node->takeMessages().size(), 1u);
    EXPECT_EQ(room.node->unlit().size(), 2u);
}

} // namespace

} // namespace penumbra
