/// A flow iterated to its steady state.
#pragma once

#include "apps/case.hpp"
#include "apps/fluid_system.hpp"
#include "apps/run.hpp"
#include "apps/run_files.hpp"

namespace hemoflux::apps {

/// Runs a case of kind fluid with [steady]; see run_case(). InputError for --restart: the residual is measured against
/// that of the first iteration.
int run_steady(const Case& c, const RunOptions& options);

/// Writes the flow of either kind as the next frame.
void write_frame(RunFiles& files, const Case& c, const FluidSystem& system, double position);

}  // namespace hemoflux::apps
