/// Streamfunction of a plane flow, (3.14):
///   laplace psi = -zeta,   zeta = dv/dx - du/dy (3.13),   u = dpsi/dy,   v = -dpsi/dx.
/// Finite volumes: psi fits, by least squares weighted with face length over distance, its steps between neighbouring
/// centres to the velocity between them (trapezoidal rule; to a side: between the centre and the side). The normal
/// equations are (3.14) with the circulation of these velocities around each cell. psi on the sides is the volume flux
/// through them, counted from the lower left corner (0 on walls). Second order, and of the right sign beside walls.
#pragma once

#include <vector>

#include "meshing/rectilinear.hpp"

namespace hemoflux::fluid {

class Solver;

/// A scalar field at the cell centres of a plane grid, x fastest.
struct PlaneField {
    meshing::Axis x, y;
    std::vector<double> values;

    /// Value in cell (i, j).
    [[nodiscard]] double at(std::size_t i, std::size_t j) const { return values[j * x.cells() + i]; }
};

/// Streamfunction (velocity times length) of a flow on a grid one cell thick in z, neither x nor y periodic. InputError
/// for any other grid.
PlaneField streamfunction(const Solver& solver);

/// Values at the face centres of the four sides of a plane grid.
struct PlaneBorder {
    std::vector<double> x_lower, x_upper;  ///< y.cells() values each
    std::vector<double> y_lower, y_upper;  ///< x.cells() values each
};
/// Solves laplace psi = -zeta with psi given on the sides; psi at the centres, x fastest.
std::vector<double> solve_poisson(const PlaneField& vorticity, const PlaneBorder& psi);

}  // namespace hemoflux::fluid
