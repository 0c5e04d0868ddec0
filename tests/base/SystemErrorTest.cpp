// The system's refusals: in our own words, with what to do.
#include "base/SystemError.h"

#include "base/Error.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>

#include <cerrno>
#include <cstring>

#include <unistd.h>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const int kFaults[] = {EACCES, EDQUOT, EFBIG,  EIO,     EISDIR, ELOOP, EMFILE, ENAMETOOLONG,
                       ENOENT, ENOMEM, ENOSPC, ENOTDIR, EPERM,  EROFS, EXDEV};

TEST(SystemError, EveryReasonSaysWhatToDoAndIsOurOwn) {
    for (const int fault : kFaults)
        for (const FileUse use : {FileUse::read, FileUse::write}) {
            const std::string reason = reasonOf(fault, use);
            EXPECT_THAT(reason, testing::MatchesRegex("[a-z].* [(].*[)]")) << fault;
            EXPECT_THAT(reason, Not(HasSubstr("\n")));
            EXPECT_THAT(reason, Not(HasSubstr(std::strerror(fault))));
        }
}

TEST(SystemError, TellsFaultsApart) {
    EXPECT_THAT(reasonOf(ENOSPC, FileUse::write), HasSubstr("no space left on the device"));
    EXPECT_THAT(reasonOf(EROFS, FileUse::write), HasSubstr("can only be read"));
    EXPECT_THAT(reasonOf(ENOENT, FileUse::write), HasSubstr("folder does not exist"));
    EXPECT_THAT(reasonOf(ENOENT, FileUse::read), HasSubstr("no such file"));
    EXPECT_THAT(reasonOf(EXDEV, FileUse::write), HasSubstr(std::to_string(EXDEV)));
}

TEST(SystemError, IsAnErrorThatBeginsWithThePath) {
    try {
        failToUse("out/x.exr", ENOSPC, FileUse::write);
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "out/x.exr: error: can't write: no space left on the device "
                                   "(free some space or choose another place)");
    }
    EXPECT_THROW(failToUse("x", EIO, FileUse::read), Error);
}

TEST(SystemError, SaysWhyAFileCannotBeRead) {
    const TemporaryFolder folder;
    const std::string file = folder.write("file", "x").string();
    std::filesystem::create_symlink("loop", folder.path() / "loop");
    EXPECT_THAT(whyUnreadable(file), IsEmpty());
    EXPECT_THAT(whyUnreadable(folder.file("none")), HasSubstr("no such file"));
    EXPECT_THAT(whyUnreadable(folder.path().string()), HasSubstr("is a folder"));
    EXPECT_THAT(whyUnreadable(folder.file("loop")), HasSubstr("in a circle"));
    EXPECT_THAT(whyUnreadable(folder.file(std::string(300, 'n'))), HasSubstr("too long"));
    EXPECT_THAT(whyUnreadable(file + "/below"), HasSubstr("not a folder"));
    if (geteuid() == 0) return; // who may read everything
    std::filesystem::permissions(file, std::filesystem::perms::none);
    EXPECT_THAT(whyUnreadable(file), HasSubstr("no permission"));
}

} // namespace

} // namespace penumbra
