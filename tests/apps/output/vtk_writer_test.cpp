#include "apps/output/vtk_writer.hpp"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>

#include <stdexcept>

#include "exchange/error.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class VtkWriterTest : public TemporaryFolder {};

const meshing::SurfaceMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.0 / 3.0}},
                                       {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

TEST_F(VtkWriterTest, FluidReadsBackExactly) {
    const std::array<meshing::Axis, 3> axes{meshing::Axis{{0, 1.0 / 3.0, 1}}, meshing::Axis{{-1, 0, 2, 3}},
                                            meshing::Axis{{0, 0.5}}};
    DataArray velocity{"velocity", 3, {}}, density{"density", 1, {}};
    for (int cell = 0; cell < 6; ++cell) {
        density.values.push_back(1 + 1e-15 * cell);
        for (int c = 0; c < 3; ++c) velocity.values.push_back(cell + 0.1 * c);
    }
    write_fluid(folder_ / "fluid_0000.vtr", axes, {velocity, density}, 2.5);

    vtkNew<vtkXMLRectilinearGridReader> reader;
    reader->SetFileName((folder_ / "fluid_0000.vtr").c_str());
    reader->Update();
    vtkRectilinearGrid* grid = reader->GetOutput();
    ASSERT_EQ(grid->GetNumberOfCells(), 6);
    EXPECT_EQ(grid->GetXCoordinates()->GetTuple1(1), 1.0 / 3.0);
    EXPECT_EQ(grid->GetYCoordinates()->GetTuple1(3), 3);
    vtkDataArray* u = grid->GetCellData()->GetArray("velocity");
    ASSERT_NE(u, nullptr);
    ASSERT_EQ(u->GetNumberOfComponents(), 3);
    for (int cell = 0; cell < 6; ++cell) {
        for (int c = 0; c < 3; ++c) EXPECT_EQ(u->GetComponent(cell, c), cell + 0.1 * c);
        EXPECT_EQ(grid->GetCellData()->GetArray("density")->GetTuple1(cell), 1 + 1e-15 * cell);
    }
    // i runs fastest: cell 1 is the second in x
    double bounds[6];
    grid->GetCellBounds(1, bounds);
    EXPECT_EQ(bounds[0], 1.0 / 3.0);
    EXPECT_EQ(bounds[2], -1);
    EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 2.5);
}

TEST_F(VtkWriterTest, CellsReadBackExactly) {
    auto second = tetrahedron;
    for (Vec3d& v : second.vertices) v += Vec3d{5, 0, 0};
    DataArray force{"force", 3, {}};
    for (int i = 0; i < 24; ++i) force.values.push_back(0.1 * i);
    write_cells(folder_ / "cells_0000.vtp", {tetrahedron, second}, {force}, 0);

    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder_ / "cells_0000.vtp").c_str());
    reader->Update();
    vtkPolyData* surface = reader->GetOutput();
    ASSERT_EQ(surface->GetNumberOfPoints(), 8);
    ASSERT_EQ(surface->GetNumberOfPolys(), 8);
    EXPECT_EQ(surface->GetPoint(3)[2], 1.0 / 3.0);
    EXPECT_EQ(surface->GetPoint(5)[0], 6);
    vtkIdList* last = surface->GetCell(7)->GetPointIds();
    EXPECT_EQ(last->GetId(0), 5);
    EXPECT_EQ(last->GetId(1), 6);
    EXPECT_EQ(last->GetId(2), 7);
    for (int p = 0; p < 8; ++p) {
        EXPECT_EQ(surface->GetPointData()->GetArray("cell")->GetTuple1(p), p / 4);
        EXPECT_EQ(surface->GetPointData()->GetArray("force")->GetComponent(p, 1), 0.1 * (3 * p + 1));
    }
}

TEST_F(VtkWriterTest, InterleavesComponents) {
    const DataArray a = vector_array("u", {1, 2}, {3, 4}, {5, 6});
    EXPECT_EQ(a.components, 3);
    EXPECT_EQ(a.values, (std::vector<double>{1, 3, 5, 2, 4, 6}));
    EXPECT_THROW(vector_array("u", {1, 2}, {3}, {5, 6}), std::invalid_argument);
}

TEST_F(VtkWriterTest, RefusesArraysOfWrongSizeAndFoldersThatAreMissing) {
    EXPECT_THROW(write_cells(folder_ / "a.vtp", {tetrahedron}, {{"x", 1, {1, 2}}}, 0), std::invalid_argument);
    EXPECT_THROW(write_cells(folder_ / "none" / "a.vtp", {tetrahedron}, {}, 0), FileError);
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace hemoflux::output
