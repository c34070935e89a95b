/// Stability limits of the time step on rectilinear grids.
///
/// The scheme's viscous eigenvalue on a face normal to axis a is 2 nu / (dx_a delta_a); a velocity component
/// feels its own direction twice (2.45), so the largest is lambda_v = 2 nu [sum_a 1/(dx_a delta_a) + max_a
/// 1/(dx_a delta_a)], which is 16 nu / h^2 on a uniform grid (delta = h/2). The bound (2.50) of the thesis is
/// up to 2.7 times too optimistic. Convection and sound: lambda_c = |u|/dx + |v|/dy + |w|/dz + c_s
/// sqrt(1/dx^2 + 1/dy^2 + 1/dz^2)   (2.47, with c_s).
#pragma once

#include <cmath>

#include "fluid/grid.hpp"

namespace hemoflux::fluid {

/// Explicit time schemes and the factored implicit one.
enum class Scheme { euler, rk4, factored };

/// Extent of the stability region along the negative real axis (2.37).
inline constexpr double real_limit_euler = 2.0, real_limit_rk4 = 2.785;
/// Extent of RK4's stability region along the imaginary axis (2.37).
inline constexpr double imaginary_limit_rk4 = 2.828;
/// Share of dt c = h that is used with the factored scheme, whose density part is explicit: noise in uniform and stretched
/// cubes and in columns of flat cells stays bounded exactly up to 1.
inline constexpr double factored_limit = 0.9;

/// Largest viscous eigenvalue of the scheme on this grid, 1/time. nu: largest kinematic viscosity.
double viscous_eigenvalue(const Grid& grid, double nu);

/// Largest eigenvalue of convection and sound, 1/time. speed: largest velocity magnitude. With preconditioning the
/// speeds are [u + sqrt(u^2 (1 - gamma) + gamma^2 c_s^2)]/gamma (4.13, corrected).
double acoustic_eigenvalue(const Grid& grid, double speed, double gamma = 1);

/// Largest stable step of an explicit scheme, by 1/dt = 1/dt_viscous + 1/dt_acoustic (2.54); for the factored
/// scheme the smallest cell divided by c = 1 + speed.
double stable_step(const Grid& grid, Scheme scheme, double nu, double speed, double gamma = 1);

}  // namespace hemoflux::fluid
