/// Surfaces and measures of the rigid bodies of a case.
#pragma once

#include "apps/case.hpp"
#include "coupling/rigid_body.hpp"
#include "fluid/probe.hpp"
#include "fluid/solver.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::apps {

/// Nodes per square of a cell below which the Lagrange kernel lets the flow through between them.
inline constexpr double fewest_nodes = 1.4;

/// Cube root of the volume of the smallest cells that the body's surroundings have at the start, um.
double cells_around(const RigidInput& body, const coupling::FluidGrid& grid);

/// The surface of a body about its centre, turned to its axis; h: width of the cells around it, for nodes = "auto".
/// FileError, InputError.
coupling::BodySurface make_surface(const RigidInput& body, double h);

/// By how many local cells the nodes are drawn in: as given, or what makes the torque on a turning sphere right in boxes of
/// cells or, `hexahedra`, on equal unstructured ones.
double retraction(const RigidInput& body, Kernel kernel, bool hexahedra);

/// InputError when the surface of body `index` reaches through the border of the grid.
void check_inside(const Case& c, std::size_t index, const coupling::BodySurface& surface,
                  const coupling::FluidGrid& grid);

/// A of the coefficients, um^2.
double reference_area(const RigidInput& body, const coupling::BodySurface& surface);

/// Speed that the no-slip error refers to where the case gives none: the fastest of body and fluid, c.
double fluid_speed(const RigidInput& body, const coupling::BodyState& state, fluid::Flow& fluid);

/// Pressure at the surface's end against `direction` less that at its end along it, lattice units. The pressure within
/// two cells of the nodes is smeared with their forces, so it is extrapolated from 2, 3 and 4 local cells outside, along
/// the line through the centre, with the slope that a surface without slip has:
///   dp/dn = mu d^2 u_n/dn^2 + f_n - rho a_n,   p = p_0 + p' n + c n^2 + d n^3
/// d^2 u_n/dn^2 = 2 a of u_n = n^2 (a + b n + c n^2), relative to the surface, in the same three places. In Stokes flow
/// about a sphere of ten cells to the diameter it is estimated to be 3 % too small (a parabola through the three pressures:
/// 14 %); a test holds it to 5 %.
/// NaN where a place lies outside the box.
double pressure_difference(const coupling::RigidBody& body, const Vec3d& direction,
                           const coupling::FluidGrid& grid, const fluid::SolverOptions& fluid,
                           const fluid::Probe& probe);

}  // namespace hemoflux::apps
