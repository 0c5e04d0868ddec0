// Which key does what.
#include "viewer/input/Shortcuts.h"

#include <gtest/gtest.h>

#include <string>

namespace penumbra {

namespace {

std::optional<Command> stroke(Key pressed, char letter = 0, Modifiers modifiers = {}) {
    return commandOf(
        KeyEvent{.key = pressed, .down = true, .modifiers = modifiers, .letter = letter});
}

TEST(Shortcuts, LettersCountAsTheLayoutHasThem) {
    // On a French keyboard the key in the position of Q is an A.
    const auto quit = stroke(key('A'), 'Q', {.control = true});
    ASSERT_TRUE(quit);
    EXPECT_EQ(quit->action, Action::quit);
    EXPECT_FALSE(stroke(key('Q'), 'A', {.control = true}));
    EXPECT_FALSE(stroke(key('Q'), 'Q')) << "a step down, no command";
}

TEST(Shortcuts, DigitsAreBookmarksAndSignsComeAsText) {
    const auto third = stroke(key('3'));
    ASSERT_TRUE(third);
    EXPECT_EQ(third->action, Action::bookmark);
    EXPECT_EQ(third->number, 3);
    const auto help = commandOf(TextEvent{U'?'});
    ASSERT_TRUE(help);
    EXPECT_EQ(help->action, Action::help);
    EXPECT_FALSE(commandOf(TextEvent{U'w'}));
}

TEST(Shortcuts, WalkingKeysAndHeldKeysAreNoCommands) {
    for (const char letter : std::string("WASDEQ")) EXPECT_FALSE(stroke(key(letter), letter));
    EXPECT_FALSE(commandOf(KeyEvent{.key = Key::tab, .down = true, .repeat = true}));
    EXPECT_FALSE(commandOf(KeyEvent{.key = Key::tab, .down = false}));
}

TEST(Shortcuts, OGoesThroughTheOverlaysAndShiftOBack) {
    EXPECT_EQ(stroke(key('O'), 'O')->action, Action::nextOverlay);
    EXPECT_EQ(stroke(key('O'), 'O', {.shift = true})->action, Action::previousOverlay);
}

TEST(Shortcuts, EveryLineOfTheHelpSaysSomething) {
    EXPECT_GT(helpLines().size(), 10u);
    for (const HelpLine& line : helpLines()) {
        EXPECT_GT(std::string(line.keys).size(), 0u);
        EXPECT_GT(std::string(line.text).size(), 2u);
    }
}

} // namespace

} // namespace penumbra
