/// Surfaces and measures of the rigid bodies of a case.
#pragma once

#include "apps/case.hpp"
#include "coupling/rigid_body.hpp"
#include "fluid/probe.hpp"
#include "fluid/solver.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::apps {

/// Cube root of the volume of the smallest cells that the body's surroundings have at the start, um.
double cells_around(const RigidInput& body, const coupling::FluidGrid& grid);

/// The surface of a body about its centre, turned to its axis; h: width of the cells around it, for nodes = "auto".
/// FileError, InputError.
coupling::BodySurface make_surface(const RigidInput& body, double h);

/// By how many local cells the nodes are drawn in: as given, or what makes the torque on a turning sphere right.
double retraction(const RigidInput& body, Kernel kernel);

/// InputError when the surface of body `index` reaches through the border of the grid.
void check_inside(const Case& c, std::size_t index, const coupling::BodySurface& surface,
                  const coupling::FluidGrid& grid);

/// A of the coefficients, um^2.
double reference_area(const RigidInput& body, const coupling::BodySurface& surface);

/// Speed that the no-slip error refers to where the case gives none: the fastest of body and fluid, c.
double fluid_speed(const RigidInput& body, const coupling::BodyState& state, fluid::Flow& fluid);

/// Pressure at the surface's end against `direction` less that at its end along it, lattice units. At each end it is
/// the parabola through the pressures at 2, 3 and 4 local cells outside, along the line through the centre, taken on
/// the surface. NaN where one of them lies outside the box.
double pressure_difference(const coupling::RigidBody& body, const Vec3d& direction,
                           const coupling::FluidGrid& grid, const fluid::Probe& probe);

}  // namespace hemoflux::apps
