/// From the input of a cell to its membrane: mesh, moduli, reference and the relaxed shape.
#pragma once

#include "apps/case.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::apps {

/// Moduli in the internal units of the membrane (membrane/parameters.hpp).
membrane::Parameters membrane_parameters(const CellInput& cell);

/// Whether the cell's references are those in its file. FileError when that cannot be read.
bool takes_stored_reference(const CellInput& cell);

/// What membrane/shapes.hpp needs to know of the cell. Throws InputError, FileError.
membrane::ShapeOptions shape_options(const CellInput& cell, const membrane::RelaxOptions& relaxation = {});

/// The cell about the origin with its axis along z, um; place() puts it where it belongs. A discocyte is
/// relaxed (membrane/shapes.hpp); other shapes start as they are and are themselves the rest shape of
/// reference = "stress-free" and "uniform". reference = "stored" takes every reference from the cell's file
/// but those of the whole cell that the input names. Throws InputError, FileError, and NumericalError when a
/// relaxation fails.
membrane::Cell build_cell(const CellInput& cell, const membrane::RelaxOptions& relaxation = {});

}  // namespace hemoflux::apps
