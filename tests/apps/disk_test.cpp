// Disks that are full, and files read back by a reader that knows nothing of VTK.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <sstream>

#include "apps/output/checkpoint.hpp"
#include "apps/output/pvd_series.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class Disk : public Program {
  protected:
    /// The program with files limited to so many blocks of 512 bytes: what a full disk does to write().
    [[nodiscard]] Outcome run_limited(int blocks, const std::string& arguments) const {
        const std::string command = "cd '" + folder_.string() + "' && ulimit -f " + std::to_string(blocks) +
                                    " && OMP_WAIT_POLICY=passive HEMOFLUX_THREADS=1 " HEMOFLUX_PROGRAM " " +
                                    arguments + " 2>&1";
        return run_command(command);
    }

    void expect_nothing_truncated(const std::string& where) const {
        for (const auto& entry : fs::directory_iterator(folder_ / where)) {
            const std::string name = entry.path().filename().string();
            EXPECT_FALSE(name.starts_with('.')) << name;
            if (entry.path().extension() == ".bin") {
                EXPECT_NO_THROW(static_cast<void>(output::read_checkpoint(entry.path()))) << name;
            }
            const std::string text = output::read_file(entry.path());
            EXPECT_TRUE(!name.ends_with(".csv") || text.ends_with('\n')) << name;
            EXPECT_TRUE(!entry.path().extension().string().starts_with(".vt") ||
                        text.ends_with("</VTKFile>\n"))
                << name;
        }
    }
};

TEST_F(Disk, FullFromTheStart) {
    for (const int blocks : {0, 1, 8}) {
        const Outcome outcome = run_limited(blocks, small_run + "-o out");
        EXPECT_EQ(outcome.code, 4) << blocks << " " << outcome.text;
        EXPECT_TRUE(outcome.text.starts_with("error: ")) << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
        if (fs::exists(folder_ / "out")) expect_nothing_truncated("out");
        fs::remove_all(folder_ / "out");
    }
}

TEST_F(Disk, FullOnTheWay) {
    // frames fit (about 100 kB), checkpoints (about 150 kB and growing) do not
    const Outcome outcome = run_limited(240, small_run + "--set output.compression=9 -o out");
    EXPECT_EQ(outcome.code, 4) << outcome.text;
    EXPECT_NE(outcome.text.find("error: cannot write out/"), std::string::npos) << outcome.text;
    expect_nothing_truncated("out");
}

TEST_F(Disk, FullUnderMeshes) {
    write("rbc.vtp", "an older file");
    for (const char* command :
         {"mesh rbc --nodes 162 --shape sphere -o rbc.vtp", "mesh rbc --nodes 162 --shape sphere -o rbc.ply",
          "mesh hex box --cells 9 9 9 -o box.msh", "mesh hex box --cells 9 9 9 -o box.vtu",
          "mesh grid --kind plateau --cells 30 --plateau 10 0.2 -o grid.vtr"}) {
        const Outcome outcome = run_limited(4, command);
        EXPECT_EQ(outcome.code, 4) << command << " " << outcome.text;
        EXPECT_TRUE(outcome.text.starts_with("error: ")) << outcome.text;
    }
    EXPECT_EQ(content("rbc.vtp"), "an older file");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "only the older file is there";
}

/// Number of values and sum of an array, as read_back.py prints them.
std::string line_of(const std::string& name, vtkDataArray* array) {
    double sum = 0;
    std::size_t count = 0;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
        for (int c = 0; c < array->GetNumberOfComponents(); ++c, ++count) sum += array->GetComponent(i, c);
    std::ostringstream text;
    text.precision(17);
    text << name << " " << count << " " << sum << "\n";
    return text.str();
}

template <class Reader>
std::string arrays_by_vtk(const fs::path& file) {
    const vtkNew<Reader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    auto* data = reader->GetOutput();
    std::string lines;
    for (vtkDataSetAttributes* attributes : {static_cast<vtkDataSetAttributes*>(data->GetPointData()),
                                             static_cast<vtkDataSetAttributes*>(data->GetCellData())})
        for (int a = 0; a < attributes->GetNumberOfArrays(); ++a)
            lines += line_of(attributes->GetArrayName(a), attributes->GetArray(a));
    return lines;
}

TEST_F(Disk, FilesAreReadBackByAnotherReader) {
    if (std::system("python3 -c 'import xml.etree.ElementTree, zlib' >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "there is no Python to read the files back with";
    const std::string fields = "--set 'output.fields=[\"velocity\", \"pressure\"]' ";
    for (const char* compression : {"0", "9"}) {
        ASSERT_EQ(run(small_run + fields + "--set output.compression=" + compression + " -o out").code, 0);
        const auto read = [&](const std::string& file) {
            return run_command("cd '" + folder_.string() +
                               "' && python3 '" HEMOFLUX_TESTS "/apps/read_back.py' " + file)
                .text;
        };
        const std::string fluid = arrays_by_vtk<vtkXMLRectilinearGridReader>(folder_ / "out/fluid_0000.vtr");
        EXPECT_EQ(read("out/fluid_0000.vtr"), fluid);
        EXPECT_NE(fluid.find("velocity_um_per_s 12288 "), std::string::npos) << fluid;  // 3 x 16^3
        EXPECT_NE(fluid.find("pressure_Pa 4096 "), std::string::npos) << fluid;
        EXPECT_EQ(fluid.find("density"), std::string::npos) << "a field that was not asked for";
        EXPECT_EQ(read("out/cells_0000.vtp"),
                  arrays_by_vtk<vtkXMLPolyDataReader>(folder_ / "out/cells_0000.vtp"));
        std::string frames;
        for (const output::Frame& frame : output::read_pvd(folder_ / "out/fluid.pvd"))
            frames += frame.file + "\n";
        EXPECT_EQ(read("out/fluid.pvd"), frames);
        ASSERT_EQ(run("mesh hex box --cells 3 4 5 -o box.vtu").code, 0);
        EXPECT_EQ(read("box.vtu"), arrays_by_vtk<vtkXMLUnstructuredGridReader>(folder_ / "box.vtu"));
        fs::remove_all(folder_ / "out");
    }
}

TEST_F(Disk, CompressionChangesTheSizeOnly) {
    ASSERT_EQ(run(small_run + "--set output.compression=0 -o none").code, 0);
    ASSERT_EQ(run(small_run + "--set output.compression=9 -o most").code, 0);
    EXPECT_GT(fs::file_size(folder_ / "none/fluid_0000.vtr"), fs::file_size(folder_ / "most/fluid_0000.vtr"));
    EXPECT_EQ(arrays_by_vtk<vtkXMLRectilinearGridReader>(folder_ / "none/fluid_0000.vtr"),
              arrays_by_vtk<vtkXMLRectilinearGridReader>(folder_ / "most/fluid_0000.vtr"));
}

TEST_F(Disk, IntervalsMayBeTimes) {
    // 0.2 strain units at 3 /s are 66.7 ms
    ASSERT_EQ(run(small_run + "--set output.history_interval='20 ms' --set output.interval='50 ms' --set "
                              "output.checkpoint_interval='40 ms' -o out")
                  .code,
              0);
    const std::string history = content("out/history.csv");
    EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 1 + 6) << history;  // 0, 20, 40, 50, 60, end
    EXPECT_EQ(output::read_pvd(folder_ / "out/fluid.pvd").size(), 3u);              // 0, 50 ms, end
}

}  // namespace
}  // namespace hemoflux::apps
