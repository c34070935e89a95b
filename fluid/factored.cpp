#include "fluid/factored.hpp"

#include <algorithm>

#include "fluid/factored_lines.hpp"
#include "fluid/line_solver.hpp"
#include "fluid/time_step.hpp"

namespace hemoflux::fluid {
namespace {

/// Factor by which a ghost repeats the increment of its border cell.
double repeat(const Patch& patch, std::size_t axis, std::size_t component) {
    if (patch.velocity == VelocityCondition::given) return -1;
    if (patch.velocity == VelocityCondition::symmetry && axis == component) return -1;
    return 1;
}

/// Half the greatest width of cells along the other two axes, of those that are resolved.
double half_of_widest(const Grid& grid, std::size_t axis) {
    double widest = 0;
    for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3}) {
        const auto widths = grid.rectilinear().axes[other].widths();
        if (widths.size() > 1) widest = std::max(widest, *std::max_element(widths.begin(), widths.end()));
    }
    return widest > 0 ? widest / 2 : 1e300;
}

/// Factor by which a ghost repeats the density's increment.
double repeat(const Patch& patch) { return patch.density == DensityCondition::given ? -1 : 1; }

}  // namespace

Factored::Factored(const Grid& grid, const Boundary& boundary, double nu, double dt)
    : layout_(grid.view().layout),
      nu_(nu),
      dt_(dt),
      implicit_density_(dt > factored_limit * grid.rectilinear().smallest()) {
    const auto keep = [&](const std::vector<double>& values) {
        buffers_.emplace_back(values);
        return buffers_.back().data();
    };
    const auto factors = [&](const HostLine& line) {
        LineFactors f{keep(line.lower), keep(line.pivot), keep(line.upper),
                      nullptr,          line.cyclic_last, line.cyclic_scale};
        if (!line.cyclic.empty()) f.cyclic = keep(line.cyclic);
        return f;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Patch &first = boundary.patches()[2 * axis], &last = boundary.patches()[2 * axis + 1];
        density_factors_[axis] = factors(factor_line(density_operator(
            grid.ghosted_widths(static_cast<int>(axis)), exchange::ghosts, dt, half_of_widest(grid, axis),
            grid.periodic()[axis], repeat(first), repeat(last))));
        widths_[axis] = grid.rectilinear().axes[axis].widths();
        for (std::size_t c = 0; c < 3; ++c) {
            const auto widths = grid.ghosted_widths(static_cast<int>(axis));
            const double strength = dt * nu * (axis == c ? 2 : 1),
                         delta = grid.smallest_delta(static_cast<int>(axis)),
                         low = repeat(boundary.patches()[2 * axis], axis, c),
                         high = repeat(boundary.patches()[2 * axis + 1], axis, c);
            const bool periodic = grid.periodic()[axis];
            operators_[axis][c] =
                line_operator(widths, exchange::ghosts, strength, delta, periodic, low, high);
            factors_[axis][c] = factors(factor_line(operators_[axis][c]));
        }
    }
}

void Factored::solve(const ResidualView& r) const {
    solve_factors<3>(layout_, [&](std::size_t axis) {
        return Lines<3>{layout_,
                        {r.r[1], r.r[2], r.r[3]},
                        {factors_[axis][0], factors_[axis][1], factors_[axis][2]},
                        axis == 0 ? dt_ : 1.0};
    });
}

}  // namespace hemoflux::fluid
