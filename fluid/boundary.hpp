/// Boundary conditions through two layers of ghost cells (2.2.3). A ghost value is linear through the face
/// centroid, and profiles are evaluated at the face centroid:
///
///   given value b       phi_ghost = 2 b - phi_mirror
///   zero gradient       phi_ghost = phi_mirror
///   given gradient g    phi_ghost = phi_mirror - 2 d g   (g along the inward normal, d: mirror cell to face)
///   symmetry            zero gradient, the normal velocity with opposite sign
///   periodic            the cell at the other end
///
/// The mass flux through a face with a given velocity is exactly rho_0 u_n (rho_0 = 1, the reference
/// density), so that a closed domain keeps its mass to rounding.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/vec3.hpp"
#include "fluid/grid.hpp"
#include "fluid/state.hpp"

namespace hemoflux::fluid {

/// What is known of the velocity on a patch.
enum class VelocityCondition { given, zero_gradient, symmetry, periodic };
/// What is known of the density (pressure = density / 3) on a patch.
enum class DensityCondition { given, zero_gradient, given_gradient, periodic };

/// Conditions of one side of the box. Profiles take the face centroid (grid's length unit).
struct Patch {
    VelocityCondition velocity = VelocityCondition::given;
    DensityCondition density = DensityCondition::zero_gradient;
    /// Velocity (c = 1) on the patch; empty means at rest.
    std::function<Vec3d(const Vec3d&)> velocity_profile;
    /// Density, or its gradient along the inward normal, on the patch; empty means 1 (value) or 0 (gradient).
    std::function<double(const Vec3d&)> density_profile;
    /// The same as functions of place and time, where the condition changes in time; they take precedence.
    std::function<Vec3d(const Vec3d&, double)> unsteady_velocity = {};
    std::function<double(const Vec3d&, double)> unsteady_density = {};

    /// Whether the condition changes in time.
    [[nodiscard]] bool unsteady() const { return unsteady_velocity || unsteady_density; }
    /// Velocity at a place of the patch and time t.
    [[nodiscard]] Vec3d velocity_at(const Vec3d& x, double t) const;
    /// Density there, or its gradient along the inward normal.
    [[nodiscard]] double density_at(const Vec3d& x, double t) const;
};

/// Patches in the order x-, x+, y-, y+, z-, z+.
using Patches = std::array<Patch, 6>;

/// A patch that repeats the opposite side, in velocity and density.
Patch periodic_patch();
/// No slip on a wall at rest, zero density gradient.
Patch wall_patch();
/// A given velocity profile, zero density gradient.
Patch velocity_patch(std::function<Vec3d(const Vec3d&)> profile);
/// A given density (pressure gamma rho / 3), zero velocity gradient.
Patch density_patch(double density);
/// Zero gradients of velocity and density.
Patch open_patch();
/// A plane of symmetry.
Patch symmetry_patch();

/// Throws InputError if a periodic patch has no periodic opposite, or if velocity and density disagree on
/// being periodic.
void check(const Patches& patches);
/// Which axes are periodic.
std::array<bool, 3> periodic_axes(const Patches& patches);

/// Throws the InputError for given velocities that do not balance. net: outward flux through all sides together; gross:
/// what flows through them either way.
[[noreturn]] void refuse_imbalance(double net, double gross);

/// How ghost values of one field follow from interior ones on one patch: sign * mirror + offset[layer] *
/// value(face).
struct GhostRule {
    double sign = 1;
    double offset[exchange::ghosts] = {0, 0};
    const double* value = nullptr;  ///< per face, see Boundary; null means 0
    std::size_t pitch = 0;          ///< distance between rows of `value`
};

/// Mass flux through the faces of one patch; null: take what the reconstruction gives.
struct MassFluxView {
    const double* value = nullptr;
    std::size_t pitch = 0;
};

/// Ghost rules of up to four fields and prescribed mass fluxes; trivially copyable.
struct BoundaryView {
    GhostRule rule[6][4];
    MassFluxView mass_flux[6];
    bool periodic[3] = {false, false, false};
};

/// Evaluates the patches on a grid and keeps the result on the device.
class Boundary {
  public:
    /// Throws InputError as check(); conditions that change in time are evaluated at t = 0.
    Boundary(const Patches& patches, const Grid& grid);

    /// Replaces the conditions; those that change in time are evaluated at t = 0.
    void update(const Patches& patches, const Grid& grid);
    /// Re-evaluates the profiles that change in time.
    void set_time(double t, const Grid& grid);
    /// Whether any patch changes in time.
    [[nodiscard]] bool unsteady() const;

    /// Fills the ghost cells of density and velocity.
    void fill(const GridView& grid, const StateView& state) const;
    /// Fills the ghost cells of increments of the three momenta, by the rules of the velocity without their given values.
    void fill_increments(const GridView& grid, const std::array<double*, 3>& increments) const;
    /// Fills the ghost cells of the body force and the viscosity with the border cell's value (periodic: the
    /// other end's).
    void fill_force(const GridView& grid, const StateView& state) const;
    void fill_viscosity(const GridView& grid, const StateView& state) const;

    /// Valid as long as this object lives and its conditions are not replaced.
    [[nodiscard]] const BoundaryView& view() const { return view_; }
    [[nodiscard]] const Patches& patches() const { return patches_; }
    /// True when no patch lets mass through freely: all are periodic, symmetric or have a given velocity.
    [[nodiscard]] bool closed() const;
    /// Throws InputError when the domain is closed but the given velocities do not balance (at the time last
    /// set), so that its mass would grow or shrink for ever.
    void check_mass_balance() const;
    /// Sum of the prescribed mass fluxes, outward, over all patches (density 1).
    [[nodiscard]] double net_mass_flux() const;

  private:
    /// Profiles of one patch at time t into its buffers.
    void evaluate(std::size_t patch, double t, const Grid& grid);
    /// Ghost rules and prescribed mass fluxes of one patch, which point into its buffers.
    void set_rules(std::size_t patch, const Grid& grid);

    Patches patches_;
    std::array<exchange::Buffer<double>, 6> density_, mass_;
    std::array<std::array<exchange::Buffer<double>, 3>, 6> velocity_;
    BoundaryView view_;
    std::array<double, 6> net_mass_flux_{}, gross_mass_flux_{};
};

}  // namespace hemoflux::fluid
