/// Surface viscosity of the membrane: dashpots along the springs, (6.40)-(6.41) with mu_T = 0.
///
///   mu_PM = sqrt(3)/4 g:  tension g dL/dt in every spring,  g = 4 mu_PM / sqrt 3, the same on any mesh.
///
/// The part of (6.40) across the spring, mu_T, would resist a rigid rotation; without it forces have no torque
/// and a rigid motion meets none. A sheet that relaxes freely has the time constant mu_PM/K_S in shear.
///
/// Explicit, g dL/dt of the last step is unstable in a viscous fluid at any time step. Here each dashpot is in
/// series with a spring of stiffness k' (a Maxwell element) beside the elastic one,
///   dq/dt = k' dL/dt - q/T,  T = g/k',
///   q <- q exp(-dt/T) + k' (T/dt) (1 - exp(-dt/T)) (L - L_before),   exact while L changes evenly,
/// so that no step meets more than the stiffness k' and the elastic step stays stable. Slow motion (over times
/// >> T) sees the viscosity mu_PM; a free relaxation takes mu_PM/K_S (1 + k/k'), k = 4 K_S/sqrt 3 that of the
/// elastic spring. At rest q vanishes: no static shape changes. dynamics.hpp has the implicit form.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "exchange/buffer.hpp"
#include "membrane/batch.hpp"

namespace hemoflux::membrane {

/// g of every spring, 1e-6 N s/m, from the surface viscosity mu_PM (1e-10 Pa s m).
inline double dashpot_coefficient(double viscosity) { return 4 * viscosity / std::sqrt(3.0); }

/// k' that is stable at the elastic step of a red blood cell in a Stokes fluid (dt = 2e-5 s), 1e-5 N/m.
inline constexpr double maxwell_stiffness = 5;

/// State of all Maxwell elements: of edge e of cell c at c * edges + e. Belongs into every checkpoint.
struct ViscousState {
    std::vector<double> tension;  ///< q, 1e-11 N
    std::vector<double> length;   ///< L at the last advance(), um
    bool operator==(const ViscousState&) const = default;
};

/// The Maxwell elements of all springs of a batch.
class MembraneViscosity {
  public:
    /// Elements without tension at the batch's present lengths; viscosity from its parameters. InputError
    /// unless `stiffness` (1e-5 N/m) is positive and finite.
    explicit MembraneViscosity(Batch& batch, double stiffness = maxwell_stiffness);

    /// Carries the tensions over a time dt (1e-5 s) in which the springs came to the batch's present lengths.
    /// InputError unless dt > 0.
    void advance(Batch& batch, double dt);
    /// Adds the tensions to the batch's forces; call it after compute_forces().
    void add_forces(Batch& batch) const;

    /// T = g/k', 1e-5 s.
    [[nodiscard]] double relaxation_time() const { return dashpot_ / stiffness_; }
    /// The present state, and a state as returned by state(); std::length_error when its size is wrong.
    [[nodiscard]] ViscousState state(const Batch& batch) const;
    void set_state(const Batch& batch, const ViscousState& state);

  private:
    double stiffness_, dashpot_;
    exchange::Buffer<double> tension_, length_;  // by ring slot, each edge at both ends with the same bits
};

}  // namespace hemoflux::membrane
