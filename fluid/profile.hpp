/// Values along a line: samples, extrema and zeros.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fluid/probe.hpp"

namespace hemoflux::fluid {

/// Samples of density and velocity along a straight line.
struct Profile {
    std::vector<Vec3d> at;
    std::vector<std::array<double, 4>> values;
};

/// `points` (two or more) equally spaced samples from one end to the other, both ends among them.
Profile sample(const Probe& probe, const Vec3d& from, const Vec3d& to, int points);

/// Where a function is extreme, and its value there.
struct Extremum {
    double at, value;
};

/// Smallest value of f on [low, high]: the best of `samples` points (three or more), then golden sections between its
/// two neighbours down to rounding.
Extremum minimum(const std::function<double(double)>& f, double low, double high, int samples = 401);

/// First point of [low, high] at which f passes from negative to not negative; f is sampled at `samples` points (two
/// or more) and the interval bisected to rounding.
std::optional<double> first_rise_through_zero(const std::function<double(double)>& f, double low, double high,
                                              int samples = 401);

}  // namespace hemoflux::fluid
