#include "apps/cell_file.hpp"

#include <gtest/gtest.h>

#include "apps/cell_builder.hpp"
#include "exchange/error.hpp"
#include "membrane/batch.hpp"
#include "membrane/relax.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/surface_io.hpp"
#include "tests/apps/example_case.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class CellFile : public Program {
  protected:
    [[nodiscard]] CellInput cell_with(const std::vector<std::string>& sets) const {
        std::vector<std::string> all{"cell.0.nodes=162", "cell.0.spring_length=auto"};
        all.insert(all.end(), sets.begin(), sets.end());
        return parse_case(example_case, "case", folder_, all).cells[0];
    }
    [[nodiscard]] std::string save(const membrane::Cell& cell) const {
        const fs::path file = folder_ / "cell.vtp";
        write_cell(file, *cell.topology, cell.reference, cell.positions);
        return file.string();
    }
};

TEST_F(CellFile, GivesBackEveryReferenceBitForBit) {
    const membrane::Cell cell = build_cell(cell_with(
        {"cell.0.reference=stress-free", "cell.0.spontaneous_curvature=3", "cell.0.spring_ratio=2.4"}));
    const std::string file = save(cell);
    ASSERT_TRUE(has_reference(file));
    const membrane::Cell again = build_cell(cell_with({"cell.0.file=" + file, "cell.0.reference=auto"}));
    EXPECT_EQ(again.reference.edge_lengths, cell.reference.edge_lengths);
    EXPECT_EQ(again.reference.triangle_areas, cell.reference.triangle_areas);
    EXPECT_EQ(again.reference.area, cell.reference.area);
    EXPECT_EQ(again.reference.volume, cell.reference.volume);
    EXPECT_EQ(again.reference.curvature, cell.reference.curvature);
    EXPECT_EQ(again.reference.total_curvature, cell.reference.total_curvature);
    EXPECT_EQ(again.reference.stretch_ratio, 2.4);
    for (std::size_t v = 0; v < cell.positions.size(); ++v)
        EXPECT_LT(norm(again.positions[v] - cell.positions[v]), 1e-14);
}

TEST_F(CellFile, InputOverridesWhatItNamesAndNothingElse) {
    const membrane::Cell cell = build_cell(cell_with({"cell.0.reference=stress-free"}));
    const std::string file = save(cell);
    const membrane::Cell other =
        build_cell(cell_with({"cell.0.file=" + file, "cell.0.reference=stored",
                              "cell.0.spontaneous_curvature=0", "cell.0.volume=90 um^3"}));
    EXPECT_EQ(other.reference.curvature, 0);
    EXPECT_EQ(other.reference.volume, 90);
    EXPECT_EQ(other.reference.total_curvature, cell.reference.total_curvature);
    EXPECT_EQ(other.reference.edge_lengths, cell.reference.edge_lengths);
}

TEST_F(CellFile, StartsARunAtItsMinimum) {
    const membrane::Cell cell = build_cell(cell_with({"cell.0.reference=stress-free"}));
    const membrane::Cell again =
        build_cell(cell_with({"cell.0.file=" + save(cell), "cell.0.reference=stored"}));
    membrane::Batch batch(again.topology, again.parameters, again.reference);
    batch.set_positions(0, again.positions);
    EXPECT_LE(membrane::relax(batch).iterations, 1);
}

TEST_F(CellFile, RefusesFilesWithoutOrWithOtherReferences) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(2, 3.0);
    meshing::write_surface(folder_ / "plain.vtp", sphere);
    const std::string plain = (folder_ / "plain.vtp").string();
    EXPECT_FALSE(has_reference(plain));
    const membrane::Topology topology(sphere);
    EXPECT_NE(message_of<InputError>([&] { read_reference(plain, topology); }).find("rest_length_um"),
              std::string::npos);
    const membrane::Cell cell = build_cell(cell_with({"cell.0.nodes=42", "cell.0.shape=sphere"}));
    const std::string small = save(cell);
    EXPECT_NE(message_of<InputError>([&] { read_reference(small, topology); }).find("have 480"),
              std::string::npos);
    expect_error("membrane relax --set cell.0.reference=stored -o x", 2, "no file is given");
    expect_error("membrane relax --set cell.0.file=plain.vtp --reference stored -o x", 2, "rest_length_um");
    expect_error("membrane relax --set cell.0.file=none.vtp -o x", 4, "none.vtp");
}

}  // namespace
}  // namespace hemoflux::apps
