/// Readers of the tables of a case that concern its flow, from resolved tables.
#pragma once

#include "apps/case.hpp"
#include "apps/toml_input.hpp"

namespace hemoflux::apps {

/// [fluid]; sheared: whether [shear] is given.
FluidInput read_fluid(const Section& in, bool sheared);
GridInput read_grid(const Section& in);
/// One side of [boundary].
PatchInput read_patch(const Section& in);
MeshInput read_mesh(const Section& in);
/// [boundary] of a mesh; "x" stands for the patches x- and x+.
std::map<std::string, PatchInput> read_patches(const Section& in);
SteadyInput read_steady(const Section& in);
BodyForceInput read_body_force(const Section& in);
AnalyticalInput read_analytical(const Section& in);
/// [sweep] with its table of values as it was parsed, which knows the order of its keys in the file.
SweepInput read_sweep(const Section& in, const toml::table& listed);

}  // namespace hemoflux::apps
