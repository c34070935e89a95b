#include "apps/output/vtk_writer.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <stdexcept>

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"
#include "meshing/vtk_listener.hpp"

namespace hemoflux::output {
namespace {

vtkNew<vtkDoubleArray> to_vtk(const std::string& name, int components, const std::vector<double>& values) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
}

void add_arrays(vtkDataSetAttributes* attributes, const std::vector<DataArray>& arrays, std::size_t tuples) {
    for (const DataArray& a : arrays) {
        if (a.components < 1 || a.values.size() != tuples * static_cast<std::size_t>(a.components))
            throw std::invalid_argument("write: array " + a.name +
                                        " does not have one tuple per cell or vertex");
        attributes->AddArray(to_vtk(a.name, a.components, a.values));
    }
}

std::vector<DataArray> arrays_of(vtkFieldData* attributes) {
    std::vector<DataArray> arrays;
    for (int a = 0; a < attributes->GetNumberOfArrays(); ++a) {
        vtkDataArray* array = attributes->GetArray(a);
        if (!array || !array->GetName()) continue;
        DataArray out{array->GetName(), array->GetNumberOfComponents(), {}};
        for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
            for (int c = 0; c < out.components; ++c) out.values.push_back(array->GetComponent(i, c));
        arrays.push_back(std::move(out));
    }
    return arrays;
}

/// Serialises in memory, so that the file itself is written atomically and its errors are ours to report.
template <class Writer, class Data>
void write(const std::filesystem::path& path, Data* data, double time, int compression) {
    data->GetFieldData()->AddArray(to_vtk("TimeValue", 1, {time}));
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    if (compression > 0) {
        writer->SetCompressorTypeToZLib();
        writer->SetCompressionLevel(compression);
    } else {
        writer->SetCompressorTypeToNone();
    }
    writer->WriteToOutputStringOn();
    writer->Write();
    write_file(path, writer->GetOutputString());
}

}  // namespace

DataArray vector_array(std::string name, const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& z) {
    if (x.size() != y.size() || x.size() != z.size())
        throw std::invalid_argument("vector_array: components of " + name + " differ in size");
    DataArray out{std::move(name), 3, std::vector<double>(3 * x.size())};
    for (std::size_t i = 0; i < x.size(); ++i) {
        out.values[3 * i] = x[i];
        out.values[3 * i + 1] = y[i];
        out.values[3 * i + 2] = z[i];
    }
    return out;
}

void write_fluid(const std::filesystem::path& path, const std::array<meshing::Axis, 3>& axes,
                 const std::vector<DataArray>& cell_data, double time, int compression) {
    vtkNew<vtkRectilinearGrid> grid;
    grid->SetDimensions(static_cast<int>(axes[0].faces.size()), static_cast<int>(axes[1].faces.size()),
                        static_cast<int>(axes[2].faces.size()));
    grid->SetXCoordinates(to_vtk("x_um", 1, axes[0].faces));
    grid->SetYCoordinates(to_vtk("y_um", 1, axes[1].faces));
    grid->SetZCoordinates(to_vtk("z_um", 1, axes[2].faces));
    add_arrays(grid->GetCellData(), cell_data, axes[0].cells() * axes[1].cells() * axes[2].cells());
    write<vtkXMLRectilinearGridWriter>(path, grid.Get(), time, compression);
}

void write_fluid(const std::filesystem::path& path, const meshing::HexMesh& mesh,
                 const std::vector<DataArray>& cell_data, double time, int compression) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3d& node : mesh.nodes) points->InsertNextPoint(node.x, node.y, node.z);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    grid->Allocate(static_cast<vtkIdType>(mesh.cells.size()));
    for (const auto& cell : mesh.cells) {
        vtkIdType nodes[8];
        std::copy(cell.begin(), cell.end(), nodes);
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, nodes);
    }
    add_arrays(grid->GetCellData(), cell_data, mesh.cells.size());
    write<vtkXMLUnstructuredGridWriter>(path, grid.Get(), time, compression);
}

void write_cells(const std::filesystem::path& path, const std::vector<meshing::SurfaceMesh>& cells,
                 const std::vector<DataArray>& point_data, double time,
                 const std::vector<DataArray>& triangle_data, const std::vector<DataArray>& field_data,
                 int compression) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> triangles;
    vtkNew<vtkIntArray> index;
    index->SetName("cell");
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const vtkIdType first = points->GetNumberOfPoints();
        for (const Vec3d& v : cells[c].vertices) {
            points->InsertNextPoint(v.x, v.y, v.z);
            index->InsertNextValue(static_cast<int>(c));
        }
        for (const meshing::Triangle& t : cells[c].triangles)
            triangles->InsertNextCell({first + t[0], first + t[1], first + t[2]});
    }
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->SetPolys(triangles);
    surface->GetPointData()->AddArray(index);
    add_arrays(surface->GetPointData(), point_data, static_cast<std::size_t>(points->GetNumberOfPoints()));
    add_arrays(surface->GetCellData(), triangle_data,
               static_cast<std::size_t>(triangles->GetNumberOfCells()));
    for (const DataArray& a : field_data)
        surface->GetFieldData()->AddArray(to_vtk(a.name, a.components, a.values));
    write<vtkXMLPolyDataWriter>(path, surface.Get(), time, compression);
}

SurfaceArrays read_arrays(const std::filesystem::path& path) {
    if (path.extension() != ".vtp") return {};
    const meshing::VtkSilence silence;
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetErrorCode() != vtkErrorCode::NoError)
        throw FileError("cannot read " + path.string(),
                        vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode()), "Write it anew");
    vtkPolyData* surface = reader->GetOutput();
    return {.point = arrays_of(surface->GetPointData()),
            .triangle = arrays_of(surface->GetCellData()),
            .field = arrays_of(surface->GetFieldData())};
}

}  // namespace hemoflux::output
