/// Factors of the tridiagonal lines of the AF scheme, computed on the host (see factored.hpp).
#pragma once

#include <cstddef>
#include <vector>

namespace hemoflux::fluid {

/// Host copy of LineFactors.
struct HostLine {
    std::vector<double> lower, pivot, upper, cyclic;
    double cyclic_last = 0, cyclic_scale = 0;
};

/// I - strength L on one axis, by what a cell exchanges with its neighbours:
/// ((I - strength L) x)_i = x_i + down_i (x_i - x_{i-1}) + up_i (x_i - x_{i+1}).
struct LineOperator {
    std::vector<double> down, up;  ///< of every cell
    bool periodic = false;
    double low = 1, high = 1;  ///< factor by which a ghost repeats its border cell
};

/// I - strength L on one axis. delta: smallest streaming distance of the faces across this axis; where it is less than half
/// the distance s of two centres, the explicit viscous flux is stiffer by s/(2 delta), and so is L made. widths: cell
/// widths with `ghosts` ghost cells at either end; periodic: cyclic line; low, high: factor by which a ghost repeats the
/// increment of its border cell (-1 given value, +1 zero gradient).
LineOperator line_operator(const std::vector<double>& widths, std::size_t ghosts, double strength,
                           double delta, bool periodic, double low, double high);

/// The same of the density, I - dt M: what streaming exchanges across a face is delta_f/3 times the gradient, delta_f at
/// most the smaller width of the two cells and `lateral`, half the greatest width of cells along the face. Like nu it may be
/// larger than what acts.
LineOperator density_operator(const std::vector<double>& widths, std::size_t ghosts, double dt,
                              double lateral, bool periodic, double low, double high);

/// Factors of an operator on its line.
HostLine factor_line(const LineOperator& op);

}  // namespace hemoflux::fluid
