/// From the input of a cell to its membrane: mesh, moduli, reference and the relaxed shape.
#pragma once

#include "apps/case.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::apps {

/// Moduli in the internal units of the membrane (membrane/parameters.hpp).
membrane::Parameters membrane_parameters(const CellInput& cell);

/// The cell about the origin with its axis along z, um; place() puts it where it belongs. A discocyte is
/// relaxed from the Evans-Fung disc with a spheroid as reference, and again with its own reference; other
/// shapes start as they are and are themselves the rest shape of reference = "stress-free" and "uniform".
/// Throws InputError, FileError, and NumericalError when a relaxation fails.
membrane::Cell build_cell(const CellInput& cell, const membrane::RelaxOptions& options = {});

}  // namespace hemoflux::apps
