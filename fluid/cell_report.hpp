/// Single cells of a flow in words, for the messages of runs that fail.
#pragma once

#include <cstddef>
#include <string>

#include "fluid/flow.hpp"

namespace hemoflux::fluid {

/// "fluid cell 17 at (x, y, z) um, density 1.02, speed 0.1 c".
std::string describe_cell(const Flow& flow, std::size_t cell);

/// First cell whose density is not inside [lowest, highest]; cells() if there is none.
std::size_t first_density_outside(const Flow& flow, double lowest, double highest);

/// The cell whose last residual, all components together, is the largest.
std::size_t least_steady_cell(const Flow& flow);

}  // namespace hemoflux::fluid
