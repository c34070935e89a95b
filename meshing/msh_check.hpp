/// What is looked at in an MSH file before gmsh reads it. gmsh takes a file of another kind for a script and runs it,
/// allocates what a file claims to hold, and does not survive every file that breaks off or contradicts itself.
#pragma once

#include <string>

namespace hemoflux::meshing {

/// FormatError naming the section and, of text files, the line, unless every section of a file of MSH 2.2 or 4.1, text or
/// binary, can be read from end to end as gmsh reads it and names nodes and entities that exist. Meshes in partitions and
/// sections of results are not read.
void check_msh(const std::string& text);

}  // namespace hemoflux::meshing
