/// Stability limits of the time step on rectilinear grids.
///
/// Viscosity. The scheme's eigenvalue on a face normal to axis a is 2 nu / (dx_a delta_a); a velocity component feels
/// its own direction twice (2.45), so the largest is lambda_v = 2 nu [sum_a 1/(dx_a delta_a) + max_a 1/(dx_a delta_a)],
/// which is 16 nu / h^2 on a uniform grid (delta = h/2). The bound (2.50) of the thesis is up to 2.7 times too
/// optimistic.
///
/// Convection and sound: lambda_c = |u|/dx + |v|/dy + |w|/dz + c_s sqrt(1/dx^2 + 1/dy^2 + 1/dz^2)   (2.47, with c_s).
/// Three points on either side of a face make sound up to 1.17 times as fast on the grid.
///
/// Streaming from both sides of a face damps the shortest waves of density by 2/(3 dx_a) along every axis, and those of each
/// velocity component by 2/(3 dx_a) along its own. At low viscosity this is what limits the step; (2.54) knows nothing of
/// it, and Runge-Kutta steps by (2.54) are unstable there, in a cube by a factor of two:
///
///   lambda_r = max(lambda_v + max_a (2/3 + 2|u|)/dx_a, sum_a 2/(3 dx_a))        2|u| from numerical experiments in streams
///   RK4:    dt = 2.6 / sqrt(lambda_r^2 + (1.17 lambda_c)^2)        the half disc |z| <= 2.6 lies in its region
///   Euler:  dt = min[1 / (lambda_r / 2 + lambda_c), 2 (nu + delta/3) / (|u| + c_s)^2, 2 nu / |u|^2]
///           the latter for long waves, which this scheme amplifies by (k c)^2 dt / 2: viscosity and streaming damp sound,
///           viscosity alone damps shear waves
#pragma once

#include <cmath>

#include "fluid/grid.hpp"

namespace hemoflux::fluid {

/// Explicit time schemes and the factored implicit one.
enum class Scheme { euler, rk4, factored };

/// Extent of the stability region along the negative real axis (2.37).
inline constexpr double real_limit_euler = 2.0, real_limit_rk4 = 2.785;
/// What streaming from both sides of a face damps waves from cell to cell by, times the width of the cells.
inline constexpr double streaming_rate = 2.0 / 3;
/// Radius of a half disc in RK4's stability region.
inline constexpr double radius_rk4 = 2.6;
/// Share of dt c = h that is used with the factored scheme, whose density part is explicit: noise in uniform and stretched
/// cubes and in columns of flat cells stays bounded exactly up to 1.
inline constexpr double factored_limit = 0.9;
/// The same of longer steps, in which the density is implicit too (factored.hpp).
inline constexpr double implicit_density_limit = 2.5;

/// Largest viscous eigenvalue of the scheme on this grid, 1/time. nu: largest kinematic viscosity.
double viscous_eigenvalue(const Grid& grid, double nu);

/// Largest eigenvalue of convection and sound, 1/time. speed: largest velocity magnitude. With preconditioning the
/// speeds are [u + sqrt(u^2 (1 - gamma) + gamma^2 c_s^2)]/gamma (4.13, corrected).
double acoustic_eigenvalue(const Grid& grid, double speed, double gamma = 1);

/// gamma times the speed of sound of the preconditioned equations: sqrt[u^2 (1 - gamma) + gamma^2 c_s^2] (4.13, corrected).
double preconditioned_sound(double speed, double gamma);

/// Rates that limit an explicit step, 1/time, and what long waves need.
struct StepRates {
    double viscous = 0, acoustic = 0;
    double streaming_sum = 0, streaming_largest = 0;  ///< 2/(3 dx_a): sum over the axes, largest
    double viscosity = 0, diffusivity = 0;            ///< nu and nu + delta/3, nu divided by gamma
    double convection = 0, fastest = 0;  ///< |u| and |u| + c_s, or what preconditioning makes of them
};

/// Largest stable step of an explicit scheme with these rates.
double explicit_step(Scheme scheme, const StepRates& rates);

/// Largest stable step of an explicit scheme; for the factored scheme the smallest cell divided by c = 1 + speed.
double stable_step(const Grid& grid, Scheme scheme, double nu, double speed, double gamma = 1);

}  // namespace hemoflux::fluid
