/// Motion of a rigid body: where it is, how it turns, and the velocity that balances its forces.
///
///   X_j = C + R x_j,  U_j = U + Omega x r_j,  r_j = X_j - C
///   forces on the fluid after a correction with gains K_j:  F_j' = F_j + K_j (U_j - u_j)
///   (rho_b - rho) V dU/dt = -sum F_j' + f,
///   (rho_b - rho) I dOmega/dt + Omega x (rho_b - rho) I Omega = -sum r_j x F_j' + t
/// The fluid inside a body moves with it and has its inertia, so the body's own counts only beyond it (Uhlmann 2005).
/// U and Omega stand on both sides and are solved for together (6 x 6): the denominator (rho_b - rho) V / dt + sum K_j
/// stays positive for a neutrally buoyant body, whose forces then add up to nothing.
#pragma once

#include <array>

#include "coupling/body_surface.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// What moves a body. torque_free: the centre has its given velocity, the body turns freely.
enum class BodyFreedom { prescribed, torque_free, free };

/// Position, orientation (unit quaternion w, x, y, z) and velocities; um and c.
struct BodyState {
    Vec3d centre{0, 0, 0};
    std::array<double, 4> orientation{1, 0, 0, 0};
    Vec3d velocity{0, 0, 0}, angular_velocity{0, 0, 0};
    /// Rates of change of the velocities in the last step.
    Vec3d acceleration{0, 0, 0}, angular_acceleration{0, 0, 0};
};

/// Rotation matrix of a unit quaternion.
Matrix3 rotation(const std::array<double, 4>& q);

/// The state after dt with its velocities: C + dt U, and the exact rotation by |Omega| dt about Omega.
void advance(BodyState& state, double dt);

/// Sums over the nodes of a body that its balance needs; gains K_j, forces F_j, fluid velocities u_j.
struct NodeSums {
    double gain = 0;                        ///< sum K
    Vec3d gain_arm{0, 0, 0};                ///< sum K r
    double rr[6] = {0, 0, 0, 0, 0, 0};      ///< sum K r r^T: xx, yy, zz, xy, yz, zx
    Vec3d gain_velocity{0, 0, 0};           ///< sum K u
    Vec3d gain_moment{0, 0, 0};             ///< sum K r x u
    Vec3d force{0, 0, 0}, torque{0, 0, 0};  ///< sum F, sum r x F
    HEMOFLUX_FN NodeSums& operator+=(const NodeSums& b) {
        gain += b.gain;
        gain_arm += b.gain_arm;
        for (int i = 0; i < 6; ++i) rr[i] += b.rr[i];
        gain_velocity += b.gain_velocity;
        gain_moment += b.gain_moment;
        force += b.force;
        torque += b.torque;
        return *this;
    }
};

/// Inertia beyond that of the fluid inside, and what acts from outside; lattice units (rho_0, um, c).
struct BodyLoad {
    double excess_mass = 0;  ///< (rho_b - rho) V
    Matrix3 excess_inertia;  ///< (rho_b - rho) I in the laboratory's frame, about the centre
    Vec3d force{0, 0, 0};    ///< f
    Vec3d torque{0, 0, 0};   ///< t
};

/// Velocity of the centre, and angular velocity.
struct BodyVelocity {
    Vec3d velocity, angular_velocity;
};
/// The velocities at the end of a step of dt that balance the sums; `before` is the state at its start.
BodyVelocity balance(BodyFreedom freedom, const BodyState& before, const NodeSums& sums, const BodyLoad& load,
                     double dt);

}  // namespace hemoflux::coupling
