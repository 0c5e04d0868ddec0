// A small `ulimit -v`: the program works, or says in one line that memory is short.
#include "Program.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

class Memory : public testing::Test {
protected:
    void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "sanitizers need terabytes of address space";
#endif
    }

    /// Runs with `first` megabytes of address space, and more in steps until it has worked twice.
    void expectAnAnswerAtEveryLimit(const std::vector<std::string>& arguments, std::size_t first,
                                    std::size_t step) {
        int worked = 0;
        for (std::size_t megabytes = first; megabytes < 4000 && worked < 2; megabytes += step) {
            const Outcome outcome =
                runPenumbra(arguments, {.addressBytes = megabytes << 20, .seconds = 60});
            worked += outcome.exitCode == 0;
            if (outcome.exitCode == 0) continue;
            EXPECT_EQ(outcome.exitCode, 1) << megabytes << " MB: " << outcome.err;
            EXPECT_THAT(outcome.err, testing::HasSubstr("memory is short: ")) << megabytes;
            EXPECT_EQ(lineCount(outcome.err), 1u) << outcome.err;
            ++refused_;
        }
        EXPECT_EQ(worked, 2);
    }

    Workplace here;
    std::string room = here.write("room.usda", smallRoom());
    int refused_ = 0;
};

// The first limits are those with which the system can load the program at all.
TEST_F(Memory, ThatIsTooShortToSolveIsToldInOneLine) {
    expectAnAnswerAtEveryLimit(
        {"solve", room, "--patch-size", "0.5", "--element-size", "0.1", "--quiet"}, 100, 8);
    EXPECT_GT(refused_, 0);
}

TEST_F(Memory, ThatIsTooShortToDrawIsToldInOneLine) {
    expectAnAnswerAtEveryLimit({"render", room, "-o", here.path("a.exr"), "--width", "160",
                                "--patch-size", "0.5", "--element-size", "0.25", "--quiet"},
                               180, 40);
    EXPECT_GT(refused_, 3);
    EXPECT_THAT(here.files(), testing::ElementsAre("a.exr", "room.usda"));
}

TEST_F(Memory, ThatIsShortIsEnoughToSayWhatIsInAScene) {
    expectAnAnswerAtEveryLimit({"info", room}, 100, 50);
}

} // namespace

} // namespace penumbra
