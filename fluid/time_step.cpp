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
    return (speed * sum + preconditioned_sound(speed, gamma) * std::sqrt(squares)) / gamma;
}

double preconditioned_sound(double speed, double gamma) {
    return std::sqrt(speed * speed * (1 - gamma) + gamma * gamma / 3);
}

double explicit_step(Scheme scheme, const StepRates& r) {
    constexpr double faster_sound = 1.17;
    const double real = std::max(r.viscous + r.streaming_largest, r.streaming_sum);
    if (scheme == Scheme::rk4) return radius_rk4 / std::hypot(real, faster_sound * r.acoustic);
    const auto of_waves = [](double damping, double speed) {
        return speed > 0 ? 2 * damping / (speed * speed) : 1e300;
    };
    return std::min({1 / (real / real_limit_euler + r.acoustic), of_waves(r.diffusivity, r.fastest),
                     of_waves(r.viscosity, r.convection)});
}

double stable_step(const Grid& grid, Scheme scheme, double nu, double speed, double gamma) {
    if (scheme == Scheme::factored)
        return factored_limit * grid.rectilinear().smallest() * gamma / (gamma + speed);
    StepRates r;
    r.viscous = viscous_eigenvalue(grid, nu / gamma);
    r.acoustic = acoustic_eigenvalue(grid, speed, gamma);
    double delta = 1e300;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto& axis = grid.rectilinear().axes[a];
        delta = std::min(delta, grid.smallest_delta(static_cast<int>(a)));
        if (axis.cells() == 1) continue;
        const double streaming = streaming_rate / axis.smallest();
        r.streaming_sum += streaming;
        r.streaming_largest =
            std::max(r.streaming_largest, streaming + 2 * speed / (gamma * axis.smallest()));
    }
    r.viscosity = nu / gamma;
    r.diffusivity = r.viscosity + delta / 3;
    r.convection = speed / gamma;
    r.fastest = (speed + preconditioned_sound(speed, gamma)) / gamma;
    return explicit_step(scheme, r);
}

}  // namespace hemoflux::fluid
