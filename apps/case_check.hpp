/// Checks of a case that need its geometry: grid and cells.
#pragma once

#include <string>
#include <vector>

#include "apps/case.hpp"

namespace hemoflux::apps {

/// Builds the grid and the cells' surfaces and throws InputError (FileError for unreadable meshes) when a
/// cell lies outside the box or reaches through a side that is not periodic, or a mesh is no closed surface
/// of 42 nodes or more. Returns warnings in the same grammar: fewer than one grid cell across a cell's
/// thinnest part.
std::vector<std::string> check_case(const Case& c);

}  // namespace hemoflux::apps
