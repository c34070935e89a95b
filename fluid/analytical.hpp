/// Exact solutions of incompressible flows, as initial conditions and as what a run is compared with.
///
///   Couette       u = U y/h                                                                           (3.3)
///   Poiseuille    u = 4 U y (h - y)/h^2,  U = G h^2/(8 mu), G the pressure gradient or body force      (3.7)
///   Taylor-Green  u = -u0 sqrt(ky/kx) cos(kx x) sin(ky y) e^{-t/t_d}
///                 v = +u0 sqrt(kx/ky) sin(kx x) cos(ky y) e^{-t/t_d}       (3.15; printed with - in v)
///                 p = -rho u0^2/4 [(ky/kx) cos(2 kx x) + (kx/ky) cos(2 ky y)] e^{-2 t/t_d}            (3.16)
///                 t_d = 1/[nu (kx^2 + ky^2)]                                                          (3.17)
///   Womersley     u = Re{A/(i omega rho) [1 - cosh(sqrt(i) Wo y/a)/cosh(sqrt(i) Wo)] e^{i omega t}}   (3.24)
///                 Wo = a sqrt(omega/nu), a the half height, y from the middle, driven by A cos(omega t)
///
/// Lattice units: rho_0 = 1, pressure above the reference = gamma (rho - 1)/3.
#pragma once

#include <functional>

#include "fluid/flow.hpp"

namespace hemoflux::fluid {

/// Density and velocity at a point and a time.
using ExactFlow = std::function<FlowPoint(const Vec3d&, double)>;

/// The upper wall of a gap moves with `speed` in x; the lower one, at y = lower, is at rest.
struct Couette {
    double speed, lower, height;
    [[nodiscard]] FlowPoint operator()(const Vec3d& x, double t) const;
};

/// Flow in x between walls at rest, `speed` in the middle.
struct Poiseuille {
    double speed, lower, height;
    [[nodiscard]] FlowPoint operator()(const Vec3d& x, double t) const;
};

/// Decaying vortices; wave numbers of x and y, gamma as in the equilibrium (density = 1 + 3 p/gamma).
struct TaylorGreen {
    double u0, kx, ky, nu, gamma = 1;
    /// Time in which the velocity falls by a factor e.
    [[nodiscard]] double decay_time() const;
    [[nodiscard]] FlowPoint operator()(const Vec3d& x, double t) const;
};

/// Flow in x between walls at rest, driven by the force density A cos(omega t + phase).
struct Womersley {
    double amplitude, omega, phase, nu, middle, half_height;
    [[nodiscard]] double period() const;
    /// Womersley number (3.23).
    [[nodiscard]] double number() const;
    [[nodiscard]] FlowPoint operator()(const Vec3d& x, double t) const;
};

/// How far a flow's velocity is from an exact one, volume-weighted over all cells; e the difference, u the exact
/// velocity. The root mean squares that (3.21) and (3.22) mean.
struct VelocityError {
    double relative;  ///< sqrt(sum |e|^2 / sum |u|^2), the volume-averaged norm
    double total;     ///< the same without the average: sqrt(cells) relative
    double largest;   ///< max |e| / max |u|
    double norm;      ///< sqrt(sum |u|^2 / volume)
    double absolute;  ///< sqrt(sum |e|^2 / volume)
};
VelocityError velocity_error(const Flow& flow, const ExactFlow& exact, double t);

/// Root mean square of the density's difference from the exact one over the root mean square of the exact density's
/// variation about its mean; NaN where that does not vary. Both are taken about their means.
double density_error(const Flow& flow, const ExactFlow& exact, double t);

}  // namespace hemoflux::fluid
