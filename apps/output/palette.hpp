/// Colours of the pictures.
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

namespace hemoflux::output {

/// Light to dark blue from 0 to `maximum` of a magnitude; a red cell stands out on it.
vtkSmartPointer<vtkLookupTable> blues(double maximum);

/// Blue to white to red over [-limit, limit], the limit the larger magnitude; white to red from 0 where low is not
/// negative.
vtkSmartPointer<vtkLookupTable> diverging(double low, double high);

/// A few reds by cell number in turn, so that neighbouring cells are told apart.
vtkSmartPointer<vtkLookupTable> reds();

}  // namespace hemoflux::output
