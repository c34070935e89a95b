/// What a case says of many cells and of the channel they flow in.
#pragma once

#include <optional>

#include "apps/case.hpp"
#include "apps/toml_input.hpp"
#include "fluid/duct.hpp"

namespace hemoflux::apps {

/// [contact] and [packing], from resolved tables.
ContactInput read_contact(const Section& in);
PackingInput read_packing(const Section& in);

/// The flow that the body force of a case drives through its box without cells, um and s: between no-slip walls, along an
/// axis that is periodic, or through a round pipe (grid.mesh) that repeats. Nothing for any other case.
std::optional<fluid::DuctFlow> undisturbed_flow(const Case& c);

/// Largest speed of the undisturbed flow over the shear rate of the case, um: `sheared`, the distance of a sheared wall
/// from the plane at rest, or what the flow in a channel has instead.
double flow_reach(const Case& c, double sheared);

/// Completes a case after its tables are read: the clock of a flow driven by a force is the wall rate of the undisturbed
/// flow, and packed cells become a list. Throws InputError when a force drives a coupled flow that has no steady state,
/// or when there is no cell to pack, or more than one.
void complete_suspension(Case& c, bool initial_chosen);

/// The cells of a packed case.
std::size_t packed_cells(const Case& c);

}  // namespace hemoflux::apps
