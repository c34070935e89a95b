#include "apps/output/folder.hpp"

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class FolderTest : public TemporaryFolder {};
using fs_path = std::filesystem::path;

TEST_F(FolderTest, IsMadeWithItsParentsAndLeftEmpty) {
    const OutputFolder out(folder_ / "a" / "b", Folder::fresh);
    EXPECT_TRUE(std::filesystem::is_directory(folder_ / "a" / "b"));
    EXPECT_TRUE(std::filesystem::is_empty(out.path()));
    EXPECT_EQ(out.fluid_file(12).filename(), "fluid_0012.vtr");
    EXPECT_EQ(out.cell_file(12345).filename(), "cells_12345.vtp");
}

TEST_F(FolderTest, RemovesTheFilesOfAnEarlierRunOnly) {
    const char* run[] = {
        "resolved.toml",  "history.csv",    "summary.json",        "log.txt",
        "fluid.pvd",      "fluid_0003.vtr", "cells_0003.vtp",      "checkpoint_0000000010.bin",
        "picture_01.png", "plot_incl.svg",  ".fluid_0004.vtr.tmp", "picture_series.png"};
    for (const char* name : run) put(name, "old");
    const char* own[] = {"notes.md", "fluid_mine.vtr", "photo.png"};
    for (const char* name : own) put(name, "mine");
    const OutputFolder out(folder_, Folder::fresh);
    for (const char* name : run) EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << name;
    for (const char* name : own) EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
}

TEST_F(FolderTest, KeepsEverythingOnRestart) {
    put("resolved.toml", "old");
    put("history.csv", "old");
    const OutputFolder out(folder_, Folder::restart);
    EXPECT_EQ(content("history.csv"), "old");
}

TEST_F(FolderTest, RefusesAFolderWithOtherFiles) {
    put("thesis.tex", "precious");
    EXPECT_THROW(OutputFolder(folder_, Folder::fresh), InputError);
    EXPECT_THROW(OutputFolder(folder_, Folder::restart), InputError);
    EXPECT_EQ(content("thesis.tex"), "precious");
}

TEST_F(FolderTest, NamesWhatCannotBeMadeOrWritten) {
    put("file", "not a folder");
    try {
        OutputFolder(folder_ / "file" / "results", Folder::fresh);
        FAIL() << "no error";
    } catch (const FileError& error) {
        EXPECT_EQ(error.code(), Exit::file);
        EXPECT_NE(std::string(error.what()).find("results"), std::string::npos) << error.what();
    }
    EXPECT_THROW(OutputFolder(folder_ / "file", Folder::fresh), FileError);
    // writable by nobody, the administrator included
    EXPECT_THROW(OutputFolder("/proc/hemoflux", Folder::fresh), FileError);
}

TEST_F(FolderTest, AtomicWriteReplacesAndLeavesNoTemporary) {
    write_file(folder_ / "a.txt", "first, longer");
    write_file(folder_ / "a.txt", "second");
    EXPECT_EQ(read_file(folder_ / "a.txt"), "second");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
    write_file(folder_ / "empty", "");
    EXPECT_EQ(read_file(folder_ / "empty"), "");
}

TEST_F(FolderTest, AtomicWriteReportsEachStepThatFails) {
    EXPECT_THROW(write_file("/dev/full/x", "text"), FileError);
    EXPECT_THROW(write_file(folder_ / "none" / "x", "text"), FileError);
    EXPECT_THROW(read_file(folder_ / "none"), FileError);
    EXPECT_THROW(read_file(folder_), FileError);
    // a folder in the way makes the last step, the renaming, fail
    std::filesystem::create_directories(folder_ / "target" / "inside");
    EXPECT_THROW(write_file(folder_ / "target", "text"), FileError);
    EXPECT_FALSE(std::filesystem::exists(folder_ / ".target.tmp"));
}

}  // namespace
}  // namespace hemoflux::output
