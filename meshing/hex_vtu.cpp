// VTU: VTK's XML unstructured grids.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <map>
#include <system_error>

#include "meshing/hex_formats.hpp"
#include "meshing/vtk_check.hpp"
#include "meshing/vtk_listener.hpp"

namespace hemoflux::meshing {
namespace {

constexpr const char* patch_array = "patch";
constexpr const char* names_array = "patch_names";

template <std::size_t corners>
std::array<std::uint32_t, corners> nodes_of(vtkUnstructuredGrid* data, vtkIdType cell) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data->GetCellPoints(cell, count, ids);
    std::array<std::uint32_t, corners> nodes{};
    if (count != static_cast<vtkIdType>(corners))
        throw FormatError(fmt::format("cell {} has {} nodes instead of {}", cell, count, corners));
    for (std::size_t k = 0; k < corners; ++k) {
        if (ids[k] < 0 || ids[k] >= data->GetNumberOfPoints())
            throw FormatError(
                fmt::format("cell {} names node {} of {}", cell, ids[k], data->GetNumberOfPoints()));
        nodes[k] = static_cast<std::uint32_t>(ids[k]);
    }
    return nodes;
}

std::string patch_name(vtkUnstructuredGrid* data, int number) {
    auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(names_array));
    if (names == nullptr) return fmt::format("{}", number);
    if (number < 0 || number >= names->GetNumberOfValues())
        throw FormatError(fmt::format("a face is in patch {}, but {} has {} names", number, names_array,
                                      names->GetNumberOfValues()));
    return names->GetValue(number);
}

/// Hexahedra into mesh.cells, quadrilaterals into patches by number.
HexMesh sort_cells(vtkUnstructuredGrid* data) {
    HexMesh mesh;
    std::map<int, HexMesh::Patch> patches;
    vtkDataArray* patch = data->GetCellData()->GetArray(patch_array);
    if (patch == nullptr) patch = data->GetCellData()->GetArray("gmsh:physical");
    for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
        const int type = data->GetCellType(c);
        if (type == VTK_HEXAHEDRON) {
            mesh.cells.push_back(nodes_of<8>(data, c));
        } else if (type == VTK_QUAD && patch != nullptr) {
            const int number = static_cast<int>(std::lround(patch->GetTuple1(c)));
            patches[number].faces.push_back(nodes_of<4>(data, c));
        } else if (type == VTK_QUAD) {
            throw FormatError(fmt::format("its quadrilaterals have no cell array \"{}\"", patch_array));
        } else if (type != VTK_VERTEX && type != VTK_LINE) {
            throw FormatError(
                fmt::format("cell {} is of VTK type {}, neither a hexahedron ({}) nor a quadrilateral ({})",
                            c, type, int{VTK_HEXAHEDRON}, int{VTK_QUAD}));
        }
    }
    for (auto& [number, found] : patches) {
        found.name = patch_name(data, number);
        mesh.patches.push_back(std::move(found));
    }
    return mesh;
}

}  // namespace

HexMesh read_vtu(const std::string& file) {
    const std::string text = file_text(file);
    const VtkSilence silence;  // of its compressors too
    check_vtk(text, "UnstructuredGrid");
    const vtkNew<vtkXMLUnstructuredGridReader> reader;
    read_xml(*reader.Get(), text);
    vtkUnstructuredGrid* data = reader->GetOutput();
    HexMesh mesh = sort_cells(data);
    mesh.nodes.reserve(static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        double p[3];
        data->GetPoint(i, p);
        mesh.nodes.push_back({p[0], p[1], p[2]});
    }
    return mesh;
}

void write_vtu(const std::string& file, const HexMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3d& p : mesh.nodes) points->InsertNextPoint(p.x, p.y, p.z);
    vtkNew<vtkUnstructuredGrid> data;
    data->SetPoints(points);
    vtkNew<vtkIntArray> patch;
    patch->SetName(patch_array);
    vtkNew<vtkStringArray> names;
    names->SetName(names_array);
    data->Allocate(static_cast<vtkIdType>(mesh.cells.size()));
    const auto insert = [&](int type, const auto& nodes, int number) {
        std::array<vtkIdType, 8> ids{};
        for (std::size_t k = 0; k < nodes.size(); ++k) ids[k] = nodes[k];
        data->InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), ids.data());
        patch->InsertNextValue(number);
    };
    for (const auto& cell : mesh.cells) insert(VTK_HEXAHEDRON, cell, -1);
    for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
        for (const auto& face : mesh.patches[p].faces) insert(VTK_QUAD, face, static_cast<int>(p));
        names->InsertNextValue(mesh.patches[p].name);
    }
    data->GetCellData()->AddArray(patch);
    data->GetFieldData()->AddArray(names);
    vtkNew<VtkListener> listener;
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->AddObserver(vtkCommand::ErrorEvent, listener);
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->WriteToOutputStringOn();  // VTK does not always say when the disk is full
    if (writer->Write() == 0 || !listener->first().empty())
        throw FormatError(listener->first().empty() ? "VTK does not say why" : listener->first());
    const std::string text = writer->GetOutputString();
    std::ofstream out(file, std::ios::binary);
    out.write(text.data(), static_cast<std::streamsize>(text.size())).flush();
    if (!out) throw FormatError(std::generic_category().message(errno));
}

}  // namespace hemoflux::meshing
