/// The table [watchdog] of a case: what ends a run that has gone wrong.
#pragma once

#include <array>
#include <optional>

namespace hemoflux::apps {

class Section;

/// [watchdog]
struct WatchdogInput {
    int interval = 25;                           ///< steps between two looks
    std::array<double, 2> density = {0.5, 1.5};  ///< of the fluid, over its reference density
    double volume_drift = 0.05;                  ///< of a cell, over its volume at the start
    double area_drift = 0.5;                     ///< of a cell, over its area at the start
    bool folds = true;                           ///< whether a folded triangle ends the run
    std::optional<int> patience;                 ///< of steady runs, in iterations; empty: by the method
    bool operator==(const WatchdogInput&) const = default;
};

/// Reads the resolved table.
WatchdogInput read_watchdog(const Section& in);

}  // namespace hemoflux::apps
