/// What a sweep leaves behind: table, fitted orders, plot, summary.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/sweep.hpp"

namespace hemoflux::apps {

/// Observables of every run; an empty row where a run failed.
struct SweepResults {
    SweepInput sweep;
    std::vector<SweepPoint> points;
    std::vector<std::map<std::string, double>> rows;
    std::vector<std::map<std::string, std::string>> labels = {};  ///< of every run, or none at all
};

/// Orders of convergence and limits of the observables the case asks for, by name: order_NAME and limit_NAME, with the
/// values of the other keys behind it where they are combined as a product. Counted as positive when the observable
/// falls with finer cells or shorter steps.
std::map<std::string, double> sweep_orders(const SweepResults& results);

/// Writes sweep.csv, summary.json and plot_sweep.svg/png into the folder, and prints the table.
void report(const Case& base, const SweepResults& results, const RunOptions& options);

}  // namespace hemoflux::apps
