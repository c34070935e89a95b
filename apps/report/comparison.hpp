/// Several runs on one page.
#pragma once

#include <string>
#include <vector>

#include "apps/report/charts.hpp"
#include "apps/report/run_record.hpp"

namespace hemoflux::report {

/// Observables, conservation and speed, a column for each run; values with an accepted interval carry their verdict.
std::string comparison_table(const std::vector<RunRecord>& runs);

/// The charts of all runs; those of equal key and axes laid over each other, a colour for each run.
std::vector<Chart> overlaid(const std::vector<RunRecord>& runs, const std::vector<RunCharts>& charts);

}  // namespace hemoflux::report
