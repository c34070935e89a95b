/// Flows with analytical solutions, and how far a solver is from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "fluid/solver.hpp"

namespace hemoflux::fluid::test {

inline constexpr double pi = 3.14159265358979323846;

/// n x n x 1 cells on a unit square about the origin of side L, third axis periodic.
inline meshing::RectilinearGrid square(int n, double length) {
    meshing::RectilinearGrid grid;
    for (std::size_t a = 0; a < 2; ++a) grid.axes[a] = meshing::uniform_axis(0, length, n);
    grid.axes[2] = meshing::uniform_axis(0, length / n, 1);
    return grid;
}

/// Velocity component c (1..3) or density (0) of all cells.
inline std::vector<double> field(const Solver& solver, int c) {
    return solver.state().interior(solver.state().view().q[c]);
}

/// Relative L2 error of velocity component c against `exact`: sqrt(sum e^2 / sum ref^2).
inline double relative_l2(const Solver& solver, int c, const std::function<double(const Vec3d&)>& exact) {
    const auto value = field(solver, c);
    double error = 0, reference = 0;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const double e = exact(solver.centre(i));
        error += (value[i] - e) * (value[i] - e);
        reference += e * e;
    }
    return std::sqrt(error / reference);
}

/// Largest difference of a velocity component in a cell between two flows on one grid.
inline double largest_difference(const Solver& a, const Solver& b) {
    double worst = 0;
    for (int c = 1; c < 4; ++c) {
        const auto u = a.values(c), v = b.values(c);
        for (std::size_t i = 0; i < u.size(); ++i) worst = std::max(worst, std::abs(u[i] - v[i]));
    }
    return worst;
}

/// Taylor-Green vortex (3.15, second component with + sign) on a periodic square.
struct TaylorGreen {
    double length, u0, nu;
    double decay_time() const { return length * length / (8 * pi * pi * nu); }
    FlowPoint at(const Vec3d& x, double t) const {
        const double k = 2 * pi / length, f = u0 * std::exp(-t / decay_time());
        const double p = -f * f / 4 * (std::cos(2 * k * x.x) + std::cos(2 * k * x.y));
        return {1 + 3 * p,
                {-f * std::cos(k * x.x) * std::sin(k * x.y), f * std::sin(k * x.x) * std::cos(k * x.y), 0}};
    }
};

/// Prints one row of a convergence table and returns the observed order against the previous row (0 for the
/// first).
class ConvergenceTable {
  public:
    explicit ConvergenceTable(const char* title) {
        std::printf("%s\n%12s %14s %8s\n", title, "size", "error", "order");
    }
    double add(double size, double error) {
        const double order = error_ > 0 ? std::log(error_ / error) / std::log(size_ / size) : 0;
        std::printf("%12.5g %14.6e %8.3f\n", size, error, order);
        size_ = size, error_ = error;
        return order;
    }

  private:
    double size_ = 0, error_ = 0;
};

}  // namespace hemoflux::fluid::test
