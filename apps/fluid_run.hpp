/// A run of the fluid alone.
#pragma once

#include "apps/case.hpp"
#include "apps/run.hpp"

namespace hemoflux::apps {

/// Runs a case of kind fluid; see run_case().
int run_fluid(const Case& c, const RunOptions& options);

}  // namespace hemoflux::apps
