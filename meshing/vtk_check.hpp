/// What is looked at in a VTK XML file before VTK reads it. VTK allocates what a file claims to hold, prints some of
/// its errors where nobody asked for them, and does not survive every array shorter than its place demands.
#pragma once

#include <string>

namespace hemoflux::meshing {

/// FormatError when the text cannot be a VTK XML file of this type ("PolyData", "UnstructuredGrid"), claims more
/// points, cells or values than its bytes can hold, or has an array that does not hold exactly what its place demands.
/// Polyhedra, arrays of bits and of several times are not read. Run under VtkSilence: compressors print what fails.
void check_vtk(const std::string& text, const std::string& type);

}  // namespace hemoflux::meshing
