/// Many runs of one case: [sweep] lists values of any keys, each run has its own folder, and one table, one plot and
/// fitted orders of convergence come of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/case.hpp"
#include "apps/run.hpp"

namespace hemoflux::apps {

/// One run of a sweep: the values of the swept keys as TOML text, in the order of SweepInput::keys.
using SweepPoint = std::vector<std::string>;

/// All points, in the order in which they run: lists side by side, or each value with each (the first key fastest).
std::vector<SweepPoint> sweep_points(const SweepInput& sweep);

/// Place of a point on the axis of a plot: a number or quantity as it is, in the unit of `first` (the first value of
/// the key); of a list its largest number; NaN for words.
double abscissa(const std::string& value, const std::string& first);

/// Exponent p of y ~ x^p by least squares over the points where both are positive numbers; NaN for fewer than two.
double fitted_order(const std::vector<double>& x, const std::vector<double>& y);

/// Runs the sweep of a case file. Runs that are finished in the output folder and belong to the same case are taken over,
/// interrupted ones continued. Returns the exit code; a run that fails numerically leaves a gap and the code 3. Throws
/// InputError when the case has no [sweep] or a point cannot be run, before anything is written.
int run_sweep(const std::filesystem::path& file, const RunOptions& options, bool check_only);

}  // namespace hemoflux::apps
