#include "apps/run.hpp"

#include "apps/coupled_run.hpp"
#include "apps/fluid_run.hpp"

namespace hemoflux::apps {

int run_case(const Case& c, const RunOptions& options) {
    return c.kind == CaseKind::coupled ? run_coupled(c, options) : run_fluid(c, options);
}

}  // namespace hemoflux::apps
