/// Which charts a run gets.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/chart_svg.hpp"
#include "apps/report/run_record.hpp"

namespace hemoflux::report {

/// Charts of what changes during a run (history.csv): cells, bodies, flow, convergence, with reference bands.
std::vector<Chart> history_charts(const RunRecord& run);

/// Charts of the other tables: stretch curves, profiles, coefficients on a wall, errors, the observables of a sweep.
std::vector<Chart> table_charts(const RunRecord& run);

/// All charts of a run, and the plot_*.svg that none of them replaces.
struct RunCharts {
    std::vector<Chart> charts;
    std::vector<std::filesystem::path> plots;
};
RunCharts charts_of(const RunRecord& run);

}  // namespace hemoflux::report
