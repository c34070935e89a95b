#include "fluid/time_step.hpp"

#include <algorithm>

namespace hemoflux::fluid {

double viscous_eigenvalue(const Grid& grid, double nu) {
    const auto& axes = grid.rectilinear().axes;
    // The largest sum lies in the cell that is smallest along every axis; delta there is half its smallest
    // width.
    double dx[3], delta = 1e300;
    for (std::size_t a = 0; a < 3; ++a) {
        dx[a] = axes[a].smallest();
        if (axes[a].cells() > 1) delta = std::min(delta, dx[a] / 2);
    }
    double sum = 0, largest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        if (axes[a].cells() == 1) continue;
        const double term = 1 / (dx[a] * delta);
        sum += term;
        largest = std::max(largest, term);
    }
    return 2 * nu * (sum + largest);
}

double acoustic_eigenvalue(const Grid& grid, double speed, double gamma) {
    double sum = 0, squares = 0;
    for (const auto& axis : grid.rectilinear().axes) {
        if (axis.cells() == 1) continue;
        sum += 1 / axis.smallest();
        squares += 1 / (axis.smallest() * axis.smallest());
    }
    const double sound = std::sqrt(speed * speed * (1 - gamma) + gamma * gamma / 3);
    return (speed * sum + sound * std::sqrt(squares)) / gamma;
}

double stable_step(const Grid& grid, Scheme scheme, double nu, double speed, double gamma) {
    if (scheme == Scheme::factored)
        return factored_limit * grid.rectilinear().smallest() * gamma / (gamma + speed);
    const double viscous = viscous_eigenvalue(grid, nu / gamma);
    const double acoustic = acoustic_eigenvalue(grid, speed, gamma);
    if (scheme == Scheme::rk4) return 1 / (viscous / real_limit_rk4 + acoustic / imaginary_limit_rk4);
    // Forward Euler is unstable for undamped waves; viscosity damps them while dt < 2 lambda_v / lambda_c^2.
    return std::min(real_limit_euler / viscous, 1 / (viscous / real_limit_euler + acoustic));
}

}  // namespace hemoflux::fluid
