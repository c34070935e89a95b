/// What is looked at in a VTK XML file before VTK reads it. VTK allocates what a file claims to hold, and prints some of
/// its errors where nobody asked for them.
#pragma once

#include <string>

namespace hemoflux::meshing {

/// FormatError when the text cannot be a VTK XML file of this type ("PolyData", "UnstructuredGrid"), or claims more
/// points, cells or values than its bytes can hold.
void check_vtk(const std::string& text, const std::string& type);

}  // namespace hemoflux::meshing
