/// Relaxation that keeps the point symmetry r -> -r of its start.
///
/// Where mesh, reference and shape have that symmetry the force has it too, F(-r) = -F(r), so that the way
/// downhill never leaves it, but for rounding, which decides whether the shape leaves a saddle. A disc bent into
/// a cup has lost the symmetry; held to it, a biconcave disc is a minimum even where the cup has less energy.
#pragma once

#include <vector>

#include "exchange/vec3.hpp"
#include "membrane/batch.hpp"
#include "membrane/reference.hpp"
#include "membrane/relax.hpp"
#include "membrane/topology.hpp"

namespace hemoflux::membrane {

/// For each vertex the one opposite to it through the mean of all; empty unless vertices and triangles lie in
/// such pairs, to 1e-9 of the mesh's size. Those of an icosphere do.
std::vector<int> antipodes(const meshing::SurfaceMesh& mesh);

/// Whether L_0 and A_k0 are equal on opposite edges and triangles, to 1e-9. `antipode` is that of the mesh and
/// not empty.
bool point_symmetric(const Topology& topology, const std::vector<int>& antipode, const Reference& reference);

/// As relax() without loads, with opposite vertices at r and -r (um) from the start, where each takes the mean
/// of itself and the other's image, to the end. The batch's reference must be point_symmetric(): then nothing is
/// held by force, and RelaxResult::largest_force, that of the membrane itself, meets the tolerance. Errors as
/// relax(); InputError when `antipode` is not of the batch's size.
RelaxResult relax_symmetric(Batch& batch, const std::vector<int>& antipode, const RelaxOptions& options = {});

}  // namespace hemoflux::membrane
