/// Files for ParaView and other VTK readers: .vtr of the fluid, .vtp of the cells. Coordinates in um.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "meshing/hex_mesh.hpp"
#include "meshing/rectilinear.hpp"
#include "meshing/surface_mesh.hpp"

namespace hemoflux::output {

/// One named array; the components of a tuple lie next to each other (x0 y0 z0 x1 y1 z1 ...).
struct DataArray {
    std::string name;  ///< with its unit, e.g. "velocity_um_per_s"
    int components = 1;
    std::vector<double> values;  ///< components x tuples
};

/// Interleaves three arrays of equal size to one of three components.
DataArray vector_array(std::string name, const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& z);

/// Level of zlib's compression where nothing else is asked for; doubles hardly shrink further, and the run waits for it.
inline constexpr int fast = 1;

/// Writes cell data on a rectilinear grid (.vtr): cells in the order i fastest, then j, then k; no ghost
/// cells. time is stored as the field TimeValue. Atomic, compressed by zlib (level 1 to 9; 0: not), double precision.
/// FileError when it cannot be written.
void write_fluid(const std::filesystem::path& path, const std::array<meshing::Axis, 3>& axes,
                 const std::vector<DataArray>& cell_data, double time, int compression = fast);

/// Writes cell data on a mesh of hexahedra (.vtu), in the order of its cells. Otherwise as above.
void write_fluid(const std::filesystem::path& path, const meshing::HexMesh& mesh,
                 const std::vector<DataArray>& cell_data, double time, int compression = fast);

/// Writes the surfaces of any number of cells into one .vtp: vertices of cell 0, then of cell 1, ...;
/// point_data and triangle_data in the same order; field_data are arrays of any size. The point array "cell"
/// holds the index of the cell. Otherwise as write_fluid().
void write_cells(const std::filesystem::path& path, const std::vector<meshing::SurfaceMesh>& cells,
                 const std::vector<DataArray>& point_data, double time,
                 const std::vector<DataArray>& triangle_data = {},
                 const std::vector<DataArray>& field_data = {}, int compression = fast);

/// The arrays of a .vtp, of vertices, triangles and of no place.
struct SurfaceArrays {
    std::vector<DataArray> point, triangle, field;
};

/// The numeric arrays of a .vtp file; none where the file is in another format. The surface itself is read by
/// meshing::read_surface(). FileError when it cannot be read.
SurfaceArrays read_arrays(const std::filesystem::path& path);

}  // namespace hemoflux::output
