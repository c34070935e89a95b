/// The limit of a quantity under refinement, and the order at which it is approached (Richardson's extrapolation).
#pragma once

#include <vector>

namespace hemoflux::apps {

/// y = limit + a x^order; NaN where the points do not determine it.
struct Extrapolation {
    double limit, order;
};

/// Least squares over the points where x is positive and both are finite; it takes at least three different x, exact for
/// three. x is a spacing or a step: it falls to 0. The order is sought between 0.25 and 8; at either end the points show
/// no order, and limit and order are NaN.
Extrapolation extrapolate(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace hemoflux::apps
