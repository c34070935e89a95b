/// SIGINT and SIGTERM ask a run to stop after the current step.
#pragma once

namespace hemoflux::apps {

/// From now on the two signals set a flag instead of ending the program; a second one ends it.
void catch_interrupts();

/// Whether one has arrived.
bool interrupted();

}  // namespace hemoflux::apps
