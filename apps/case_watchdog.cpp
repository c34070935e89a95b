// The table [watchdog]: its keys, and reading it.
#include "apps/case_watchdog.hpp"

#include "apps/toml_input.hpp"

namespace hemoflux::apps {

Table watchdog_table() {
    const Form drift = number().above(0, "a run without any drift does not exist");
    return {
        "watchdog",
        "What ends a run that has gone wrong: it then keeps the last good state, names the place and ends "
        "with "
        "exit code 3. Numbers that are not finite, springs at their contour length and nodes outside the box "
        "always do.",
        {{"interval",
          {integer().within(1, 1000000, "a run is looked at now and then")},
          "25",
          "steps between two looks; records, frames and checkpoints are preceded by one too"},
         {"density",
          {number().within(0.5, 1.5, "the solver itself stops outside 0.5 .. 1.5").of(2)},
          "[0.5, 1.5]",
          "lowest and highest density of the fluid, over its reference density"},
         {"volume_drift", {drift}, "0.05", "kind coupled: change of a cell's volume, over that at the start"},
         {"area_drift",
          {drift},
          "0.5",
          "kind coupled: change of a cell's area, over that at the start; membranes without area modulus "
          "grow"},
         {"folds", {flag()}, "true", "kind coupled: whether a triangle that is folded over ends the run"},
         {"patience",
          {automatic(), integer().within(2, 1000000000, "a residual must be able to fall")},
          "\"auto\"",
          "[steady]: iterations without a new lowest residual after which the run has stalled; auto: 40 "
          "implicit, "
          "5000 local steps"}}};
}

WatchdogInput read_watchdog(const Section& in) {
    WatchdogInput w;
    w.interval = in.integer("interval");
    const std::vector<double> density = in.numbers("density");
    w.density = {density[0], density[1]};
    w.volume_drift = in.number("volume_drift");
    w.area_drift = in.number("area_drift");
    w.folds = in.flag("folds");
    if (const auto patience = in.maybe("patience")) w.patience = static_cast<int>(*patience);
    return w;
}

}  // namespace hemoflux::apps
