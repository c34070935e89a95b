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

/// Factors of I - strength L on one axis. delta: smallest streaming distance of the faces across this axis;
/// where it is less than half the distance s of two centres, the explicit viscous flux is stiffer by s/(2
/// delta), and so is L made. widths: cell widths with `ghosts` ghost cells at either end; periodic: cyclic
/// line; low, high: factor by which a ghost repeats the increment of its border cell (-1 given value, +1 zero
/// gradient).
HostLine factor_line(const std::vector<double>& widths, std::size_t ghosts, double strength, double delta,
                     bool periodic, double low, double high);

}  // namespace hemoflux::fluid
