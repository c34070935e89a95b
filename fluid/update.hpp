/// Explicit updates of the conserved variables Q = (rho, rho V): forward Euler and the four-stage Runge-Kutta
/// scheme (2.29).
#pragma once

#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// state <- base + increment, in conserved variables, where increment = a r. base and state may be the same
/// fields. With `sum`, also sum <- (first ? 0 : sum) + w r; with `use_sum` the increment is a sum instead of
/// a r. With `local_dt` (a field in the state's layout) every cell's increment is multiplied by its own step.
struct UpdateParameters {
    double a = 0, w = 0;
    bool accumulate = false, first = false, use_sum = false;
    const double* local_dt = nullptr;
};
void update(const exchange::Layout& layout, const StateView& base, const ResidualView& r,
            const ResidualView& sum, const UpdateParameters& parameters, const StateView& state);

/// state <- state + (dt r[0], r[1..3]) in conserved variables: what the factored scheme leaves behind.
void update_factored(const exchange::Layout& layout, const ResidualView& r, double dt,
                     const StateView& state);

}  // namespace hemoflux::fluid
