/// Reads the tables of a case that describe membranes.
#pragma once

#include "apps/case.hpp"
#include "apps/toml_input.hpp"

namespace hemoflux::apps {

/// One [[cell]], [tweezers] and [membrane], from resolved tables.
CellInput read_cell(const Section& in);
TweezersInput read_tweezers(const Section& in);
MembraneInput read_membrane(const Section& in);

}  // namespace hemoflux::apps
