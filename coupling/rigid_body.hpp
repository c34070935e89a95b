/// A rigid body in the fluid, held or carried by forces at the nodes of its surface.
///
///   feedback  F_j = k A_j int (U_j - u_j) dt: springs of stiffness k per area between each node of the body and a
///             point that drifts with the fluid (5.21); the nodes that spread stay on the body, which is (5.21) to first
///             order in the drift
///   direct    after the fluid step F_j += K_j (U_j - u_j), K_j = rho A_j / (dt r_j), r = W W^T A / V the fluid's
///             response at the node to a unit stress on the whole surface, spread to the new velocity at once and
///             repeated: multi-direct forcing with row-sum gains, no free stiffness (Wang et al. 2008, Pinelli et al.
///             2010). The force so found acts in the next fluid step, with its balanced impulse; what the correction
///             adds vanishes in steady flow.
/// Both are the same update with different gains, so that body_motion.hpp moves the body for both. The viscosity inside
/// is the fluid's. Force and torque of the fluid on a body are minus the nodal ones plus the rate of change of the
/// momentum of the fluid inside, which is taken to move with the body.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "coupling/body_motion.hpp"
#include "coupling/body_nodes.hpp"
#include "coupling/body_surface.hpp"
#include "coupling/immersed.hpp"

namespace hemoflux::coupling {

/// How the forces at the nodes are found; see above.
enum class BodyForcing { direct, feedback };

/// What does not change during a run; lattice units (rho_0, um, c).
struct BodyOptions {
    std::string name = "body";
    BodyForcing forcing = BodyForcing::direct;
    BodyFreedom freedom = BodyFreedom::prescribed;
    double density_ratio = 1;  ///< body over fluid, of bodies that move freely; at least 1
    double stiffness = 0;  ///< k of feedback, rho_0 c^2 / um^2; 0: 0.02 / (dt^2 r), r the largest response
    int iterations = 4;    ///< of direct forcing in every step
    Vec3d force{0, 0, 0};  ///< on the body from outside, beside the fluid's
    Vec3d torque{0, 0, 0};
};

/// What the future of a body depends on beside the fluid.
struct BodyMemory {
    BodyState state;
    std::array<std::vector<double>, 3> forces;  ///< at the nodes, component by component
    double stiffness = 0;                       ///< k of feedback, once it is found
};

/// Force and torque about the centre of the fluid on a body, rho_0 c^2 um^2 and um^3.
struct BodyForces {
    Vec3d force{0, 0, 0}, torque{0, 0, 0};
};

/// One rigid body as a partner of the fluid: held, moved, turning freely or free.
class RigidBody final : public Immersed {
  public:
    /// start: where the body is and its (given or first) velocities. InputError when an option is out of range or an
    /// open surface should move freely.
    RigidBody(BodySurface surface, const FluidGrid& grid, const BodyOptions& options, const BodyState& start);
    ~RigidBody() override;

    [[nodiscard]] std::string name() const override { return options_.name; }
    [[nodiscard]] std::size_t nodes() const override { return nodes_.size(); }
    [[nodiscard]] exchange::FieldView positions() override { return nodes_.positions(); }
    [[nodiscard]] exchange::FieldView forces() override { return nodes_.forces(); }
    [[nodiscard]] std::string force_unit() const override { return "rho_0 c^2 um^2"; }
    [[nodiscard]] double force_factor() const override { return 1; }
    /// Nothing to do: the forces are those that the last step found.
    void compute_forces(double /*dt*/) override {}
    void correct(double dt, const NodeLink& link, const FluidFields& fluid) override;
    void advance(double dt, const exchange::FieldView& velocity) override;
    [[noreturn]] void report_lost(std::size_t node) const override;

    /// In the body's own frame.
    [[nodiscard]] const BodySurface& surface() const { return surface_; }
    /// Where the body is and how it moves, at the end of the last step.
    [[nodiscard]] const BodyState& state() const { return state_; }
    [[nodiscard]] const BodyOptions& options() const { return options_; }
    /// Force and torque of the fluid in the last step.
    [[nodiscard]] BodyForces fluid_forces() const;
    /// Area-weighted root mean square of |U_j - u_j| at the end of the last step, c.
    [[nodiscard]] double slip() const { return slip_; }
    /// Positions of the nodes, um, and forces per area of the fluid on the body there, rho_0 c^2; on the host.
    [[nodiscard]] std::vector<Vec3d> host_positions() const;
    [[nodiscard]] std::vector<Vec3d> tractions() const;

    /// State for a checkpoint, and back.
    [[nodiscard]] BodyMemory memory() const;
    void restore(const BodyMemory& memory);

  private:
    [[nodiscard]] bool moves() const;
    void find_gains(double dt, const NodeLink& link);
    /// Velocities that balance the sums, and the forces corrected to them.
    void exchange_momentum(double dt, const exchange::FieldView& u, bool add);

    BodySurface surface_;
    BodyOptions options_;
    BodyState state_, before_;
    BodyNodes nodes_;
    exchange::Buffer<double> density_[3], predicted_[3];
    std::unique_ptr<ForceSpreader> spreader_;
    double gains_for_ = 0, stiffness_ = 0, slip_ = 0;
    BodyForces on_fluid_;
};

}  // namespace hemoflux::coupling
