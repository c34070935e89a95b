#include "apps/output/checkpoint.hpp"

#include <cmath>

#include "exchange/error.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class CheckpointTest : public TemporaryFolder {
  protected:
    static Checkpoint example() {
        Checkpoint c;
        c.put("fluid.density", {1.0, 0.1, -0.0, 1e-310, INFINITY});
        c.put("empty", {});
        c.put_number("step", 9007199254740991.0);
        c.put_number("time", 0.1);
        c.put_text("case_hash", "abc");
        c.put_text("nothing", "");
        return c;
    }
};

template <class E>
std::string message(const std::filesystem::path& path) {
    try {
        read_checkpoint(path);
    } catch (const E& error) {
        return error.what();
    }
    return "no error of this kind";
}

TEST_F(CheckpointTest, RoundTripIsExact) {
    write_checkpoint(folder_ / "c.bin", example());
    const Checkpoint c = read_checkpoint(folder_ / "c.bin");
    EXPECT_EQ(c.arrays(), example().arrays());
    EXPECT_TRUE(std::signbit(c.array("fluid.density")[2]));
    EXPECT_EQ(c.numbers(), example().numbers());
    EXPECT_EQ(c.texts(), example().texts());
}

TEST_F(CheckpointTest, SameStateGivesTheSameFile) {
    write_checkpoint(folder_ / "a.bin", example());
    write_checkpoint(folder_ / "b.bin", read_checkpoint(folder_ / "a.bin"));
    EXPECT_EQ(content("a.bin"), content("b.bin"));
}

TEST_F(CheckpointTest, EveryFlippedByteIsDetected) {
    write_checkpoint(folder_ / "c.bin", example());
    const std::string good = content("c.bin");
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 0x10);
        put("bad.bin", bad);
        EXPECT_THROW(read_checkpoint(folder_ / "bad.bin"), Error) << "byte " << i;
    }
}

TEST_F(CheckpointTest, EveryShortenedFileIsDetected) {
    write_checkpoint(folder_ / "c.bin", example());
    const std::string good = content("c.bin");
    for (std::size_t n = 0; n < good.size(); ++n) {
        put("bad.bin", good.substr(0, n));
        EXPECT_THROW(read_checkpoint(folder_ / "bad.bin"), FileError) << n << " bytes";
    }
    put("bad.bin", good + "x");
    EXPECT_NE(message<FileError>(folder_ / "bad.bin").find("bytes"), std::string::npos);
}

TEST_F(CheckpointTest, NamesWhatIsWrong) {
    write_checkpoint(folder_ / "c.bin", example());
    std::string bytes = content("c.bin");
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    put("sum.bin", bytes);
    EXPECT_NE(message<FileError>(folder_ / "sum.bin").find("checksum"), std::string::npos);
    bytes[8] = 9;
    put("format.bin", bytes);
    EXPECT_NE(message<InputError>(folder_ / "format.bin").find("format 9"), std::string::npos);
    put("text.bin", "step,time\n");
    EXPECT_NE(message<FileError>(folder_ / "text.bin").find("not a checkpoint"), std::string::npos);
    EXPECT_THROW(read_checkpoint(folder_ / "none.bin"), FileError);
}

TEST_F(CheckpointTest, NamesWhatDoesNotFitTheCase) {
    const Checkpoint c = example();
    EXPECT_NO_THROW((void)c.array("fluid.density", 5));
    EXPECT_THROW((void)c.array("fluid.density", 6), InputError);
    EXPECT_THROW((void)c.array("step"), InputError);
    EXPECT_THROW((void)c.number("fluid.density"), InputError);
    EXPECT_THROW((void)c.text("none"), InputError);
    EXPECT_TRUE(c.contains("time"));
    EXPECT_FALSE(c.contains("none"));
    EXPECT_NO_THROW(c.require_text("case_hash", "abc", "the case"));
    try {
        c.require_text("case_hash", "abd", "the case");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("the case was abc when it was written and is abd now"),
                  std::string::npos)
            << error.what();
    }
}

TEST_F(CheckpointTest, KeepsTheLastTwo) {
    for (const long long step : {100LL, 200LL, 300LL, 12345678901LL})
        write_rotating(folder_, step, example());
    EXPECT_FALSE(std::filesystem::exists(checkpoint_file(folder_, 200)));
    EXPECT_TRUE(std::filesystem::exists(checkpoint_file(folder_, 300)));
    EXPECT_EQ(latest_checkpoint(folder_).path, checkpoint_file(folder_, 12345678901LL));
    // a run restarted from step 300 leaves nothing of the abandoned future
    write_rotating(folder_, 400, example());
    EXPECT_EQ(latest_checkpoint(folder_).path, checkpoint_file(folder_, 400));
    EXPECT_TRUE(std::filesystem::exists(checkpoint_file(folder_, 300)));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2);
}

TEST_F(CheckpointTest, FallsBackToTheOlderOneWhenTheNewestIsDamaged) {
    EXPECT_THROW(latest_checkpoint(folder_), FileError);
    EXPECT_THROW(latest_checkpoint(folder_ / "none"), FileError);
    write_rotating(folder_, 1, example());
    EXPECT_EQ(latest_checkpoint(folder_).warning, "");
    put("checkpoint_0000000002.bin", "HEMOFLUX");
    const LatestCheckpoint latest = latest_checkpoint(folder_);
    EXPECT_EQ(latest.path, checkpoint_file(folder_, 1));
    EXPECT_EQ(latest.checkpoint.number("time"), 0.1);
    EXPECT_NE(latest.warning.find("checkpoint_0000000002.bin"), std::string::npos);
    put("checkpoint_0000000001.bin", "HEMOFLUX");
    EXPECT_THROW(latest_checkpoint(folder_), FileError);
}

}  // namespace
}  // namespace hemoflux::output
