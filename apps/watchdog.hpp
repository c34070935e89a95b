/// Looks after the membrane cells of a run: volume, area and folds. The solvers themselves look for numbers that are
/// not finite, densities out of range, springs at their contour length and nodes outside the box.
#pragma once

#include <vector>

#include "apps/case_watchdog.hpp"
#include "fluid/flow.hpp"
#include "membrane/batch.hpp"

namespace hemoflux::apps {

/// Throws NumericalError that names the first cell whose density is outside the bounds.
void check_density(const WatchdogInput& in, const fluid::Flow& flow);

/// Bounds on how far the cells may drift from their volume and area.
class Watchdog {
  public:
    /// volume, area: of each cell at the start of the run, um^3 and um^2.
    Watchdog(const WatchdogInput& in, std::vector<double> volume, std::vector<double> area);

    /// Throws NumericalError that names the cell, and the triangle where one is folded over, with a likely cause.
    /// Volume and area are those of the last forces.
    void check(const membrane::Batch& cells) const;

  private:
    void check_drift(const char* what, std::size_t cell, double now, double start, double bound) const;

    WatchdogInput in_;
    std::vector<double> volume_, area_;
};

}  // namespace hemoflux::apps
