#include "apps/output/log.hpp"

#include "exchange/error.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class LogTest : public TemporaryFolder {};

TEST_F(LogTest, FileHoldsEverythingAndTheTerminalWhatConcernsIt) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    {
        const Log log(folder_ / "log.txt", false);
        log.info("reading {case}");  // braces are not a format
        log.detail("only here");
        log.warn("thin");
        log.error("stop");
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "reading {case}\n");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: thin\nerror: stop\n");
    const std::string text = content("log.txt");
    for (const char* part :
         {" info: reading {case}\n", " debug: only here\n", " warning: thin\n", " error: stop\n"})
        EXPECT_NE(text.find(part), std::string::npos) << part << text;
}

TEST_F(LogTest, QuietKeepsInformationOffTheTerminalAndAppendKeepsTheFile) {
    put("log.txt", "before\n");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    {
        const Log log(folder_ / "log.txt", true, true);
        log.info("hidden");
        log.error("shown");
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "error: shown\n");
    EXPECT_TRUE(content("log.txt").starts_with("before\n"));
    EXPECT_NE(content("log.txt").find("hidden"), std::string::npos);
    EXPECT_THROW(Log("/proc/hemoflux/log.txt", true), FileError);
}

}  // namespace
}  // namespace hemoflux::output
