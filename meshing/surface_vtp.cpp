// VTP: VTK's XML PolyData.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstddef>

#include "meshing/surface_formats.hpp"
#include "meshing/vtk_check.hpp"
#include "meshing/vtk_listener.hpp"

namespace hemoflux::meshing {

SurfaceMesh parse_vtp(const std::string& text) {
    const VtkSilence silence;  // of its compressors too
    check_vtk(text, "PolyData");
    const vtkNew<vtkXMLPolyDataReader> reader;
    read_xml(*reader.Get(), text);
    vtkPolyData* data = reader->GetOutput();
    if (data->GetNumberOfStrips() > 0) throw FormatError("it holds triangle strips instead of triangles");
    SurfaceMesh mesh;
    mesh.vertices.reserve(static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        double p[3];
        data->GetPoint(i, p);
        mesh.vertices.push_back({p[0], p[1], p[2]});
    }
    vtkCellArray* cells = data->GetPolys();
    for (vtkIdType f = 0; f < cells->GetNumberOfCells(); ++f) {
        vtkIdType corners = 0;
        const vtkIdType* ids = nullptr;
        cells->GetCellAtId(f, corners, ids);
        if (corners != 3) throw FormatError(fmt::format("face {} has {} corners instead of 3", f, corners));
        Triangle triangle{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (ids[i] < 0 || ids[i] >= data->GetNumberOfPoints())
                throw FormatError(
                    fmt::format("face {} names vertex {} of {}", f, ids[i], data->GetNumberOfPoints()));
            triangle[i] = static_cast<int>(ids[i]);
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

std::string print_vtp(const SurfaceMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3d& p : mesh.vertices) points->InsertNextPoint(p.x, p.y, p.z);
    vtkNew<vtkCellArray> cells;
    for (const auto& [a, b, c] : mesh.triangles) cells->InsertNextCell({a, b, c});
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(cells);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->SetDataModeToBinary();
    writer->WriteToOutputStringOn();
    writer->Write();
    return writer->GetOutputString();
}

}  // namespace hemoflux::meshing
