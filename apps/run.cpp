#include "apps/run.hpp"

#include "apps/coupled_run.hpp"
#include "apps/fluid_run.hpp"
#include "apps/fluid_system.hpp"
#include "apps/interrupt.hpp"

namespace hemoflux::apps {

void prepare_stop(const RunOptions& options) {
    if (!options.watch) catch_interrupts();
}

bool stop_asked(const RunOptions& options, const RunPoint& point) {
    return options.watch ? !options.watch(point) : interrupted();
}

void check_run(const Case& c) {
    switch (c.kind) {
        case CaseKind::coupled:
            static_cast<void>(CoupledSystem(c));
            return;
        case CaseKind::fluid:
            static_cast<void>(FluidSystem(c));
            return;
        case CaseKind::membrane:
            check_experiment(c.membrane);
            return;
    }
}

int run_case(const Case& c, const RunOptions& options) {
    return c.kind == CaseKind::coupled ? run_coupled(c, options) : run_fluid(c, options);
}

}  // namespace hemoflux::apps
