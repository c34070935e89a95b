/// What follows from a case before it is run: dimensionless numbers, step, and about how long it takes.
#pragma once

#include <string>

#include "apps/case.hpp"

namespace hemoflux::apps {

/// Sets the case up, refuses what check_run() refuses, and measures a few steps. Returns lines, each a comment of a case
/// file ("# ..."): Reynolds, capillary and Mach number, nu/h, step and number of steps, and estimates of run time
/// (seconds of this machine with the threads set now) and memory, labelled as such.
std::string derived_numbers(const Case& c);

}  // namespace hemoflux::apps
