/// Explicit updates of the conserved variables Q = (rho, rho V): forward Euler and the four-stage Runge-Kutta
/// scheme (2.29).
#pragma once

#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// What one update does.
struct UpdateParameters {
    double a = 0;                      ///< factor of the residual, or of the sum
    double w = 0;                      ///< weight of the residual in the sum
    bool accumulate = false;           ///< sum <- (first ? 0 : sum) + w r
    bool first = false;                ///< the sum begins with this residual
    bool use_sum = false;              ///< the increment is a (sum + w r) instead of a r
    const double* local_dt = nullptr;  ///< every cell's own step, which multiplies its increment; null: 1
};
/// state <- base + increment, in conserved variables. base and state may be the same fields; local_dt is a field in their
/// layout.
void update(const exchange::Layout& layout, const StateView& base, const ResidualView& r,
            const ResidualView& sum, const UpdateParameters& parameters, const StateView& state);

/// state <- state + (dt r[0], r[1..3]) in conserved variables: what the factored scheme leaves behind.
void update_factored(const exchange::Layout& layout, const ResidualView& r, double dt,
                     const StateView& state);

}  // namespace hemoflux::fluid
