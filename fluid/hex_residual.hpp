/// Right-hand side of the finite-volume equations (2.3) on an unstructured grid, in three sweeps without atomics:
///
///   cells   gradients from the six neighbours, written with the values as one record of 16
///   faces   flux through every face from the two records beside it, by flux_of_nodes() in the face's own frame
///   cells   dQ/dt = -1/V sum_faces F.n S + (0, f)
///
/// The three follow each other stage by stage (hex_sweep.hpp), so that records and fluxes are read again while they are in
/// the cache. Nodes are extrapolated from the cells' centres straight to where they lie in the frame of the face's centre,
/// which in general is not on the line between the two cells' centres.
#pragma once

#include "fluid/hex_boundary.hpp"
#include "fluid/hex_geometry.hpp"
#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// Fields of an unstructured flow, records in device memory; ghost cells follow the cells where there are any. Places for
/// records and fluxes as the view they are used with has them.
struct HexFields {
    double* values = nullptr;  ///< [cells + ghosts][4] density, velocity
    /// [cells + ghosts][4] body force, then kinematic viscosity; or null
    double* force = nullptr;
    double* records = nullptr;  ///< [places][16] values, then d/dx, d/dy, d/dz of the four values
    double* flux = nullptr;     ///< [places][4] fluxes through the faces, mass and momentum
    double* rate = nullptr;     ///< [cells][4] dQ/dt
    std::size_t rings = 1;  ///< times there is room for the places of a sweep: as many threads can share it
};

/// Gradients of all cells into `records`; ghost values must be filled. grid: HexGeometry::whole_view().
void evaluate_gradients(const HexView& grid, const HexFields& fields);

/// Ghost records and fluxes of all faces from the gradients into `flux`; fills the ghosts of `force`. grid:
/// HexGeometry::whole_view(). The viscosity of a face is the mean of its two cells' with parameters.with_viscosity, which
/// needs with_force.
void evaluate_fluxes(const HexView& grid, const HexBorderView& border, const FlowParameters& parameters,
                     const HexFields& fields);

/// The whole right-hand side, ghosts included: from `values` (and `force` if parameters.with_force) to `rate`.
void evaluate_hex_residual(const HexGeometry& geometry, const HexBorderView& border,
                           const FlowParameters& parameters, const HexFields& fields);

}  // namespace hemoflux::fluid
