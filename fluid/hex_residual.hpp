/// Right-hand side of the finite-volume equations (2.3) on an unstructured grid, in three sweeps without atomics:
///
///   cells   gradients from the six neighbours, written with the values as one record of 16
///   faces   flux through every face from the two records beside it, by face_flux() in the face's own frame
///   cells   dQ/dt = -1/V sum_faces F.n S + (0, f)
///
/// The centre of a face is in general not on the line between the two cells' centres: each side's values are first moved
/// along the face, phi + (r_face - r_cell)_t.grad phi, to where the normal through the face's centre meets them.
#pragma once

#include "fluid/hex_boundary.hpp"
#include "fluid/hex_geometry.hpp"
#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// Fields of an unstructured flow, records in device memory; ghost cells follow the cells where there are any.
struct HexFields {
    double* values = nullptr;  ///< [cells + ghosts][4] density, velocity
    /// [cells + ghosts][4] body force, then kinematic viscosity; or null
    double* force = nullptr;
    double* records = nullptr;  ///< [cells + ghosts][16] values, then d/dx, d/dy, d/dz of the four values
    double* flux = nullptr;     ///< [padded faces][4] fluxes through the faces, mass and momentum
    double* rate = nullptr;     ///< [cells][4] dQ/dt
};

/// Gradients of all cells into `records`; ghost values must be filled.
void evaluate_gradients(const HexView& grid, const HexFields& fields);

/// Fluxes from `records`, whose ghosts must be filled, into `flux`; fills the ghosts of `force`. The viscosity of a face is the mean of its two cells'
/// with parameters.with_viscosity, which needs with_force.
void evaluate_fluxes(const HexView& grid, const HexBorderView& border, const FlowParameters& parameters,
                     const HexFields& fields);

/// The whole right-hand side, ghosts included: from `values` (and `force` if parameters.with_force) to `rate`.
void evaluate_hex_residual(const HexView& grid, const HexBorderView& border, const FlowParameters& parameters,
                           const HexFields& fields);

}  // namespace hemoflux::fluid
