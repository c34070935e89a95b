/// Relaxation that keeps the symmetries of its start under (x, y, z) -> (+-x, +-y, +-z).
///
/// Where mesh, reference and shape have such a symmetry the forces have it too, so that the way downhill never
/// leaves it, but for rounding, which decides when a shape slides off a saddle. The mirrors of an icosphere leave
/// a disc no way to bend: held to them, a biconcave disc is a minimum even where bent shapes have less energy.
#pragma once

#include <vector>

#include "exchange/vec3.hpp"
#include "membrane/batch.hpp"
#include "membrane/reference.hpp"
#include "membrane/relax.hpp"
#include "membrane/topology.hpp"

namespace hemoflux::membrane {

/// A change of signs of the coordinates that maps a mesh onto itself.
struct Symmetry {
    Vec3d sign{1, 1, 1};     ///< +-1 each
    std::vector<int> image;  ///< the vertex that each vertex goes to

    /// Where the point goes.
    [[nodiscard]] Vec3d operator()(const Vec3d& r) const {
        return {sign.x * r.x, sign.y * r.y, sign.z * r.z};
    }
};

/// The symmetries of a mesh about the origin besides the identity: each image lies within 1e-9 of the mesh's
/// size from a vertex, and triangles go to triangles. All seven for the icosphere: three mirrors, three half
/// turns, and the point.
std::vector<Symmetry> symmetries(const meshing::SurfaceMesh& mesh);

/// Whether L_0 and A_k0 are equal, to 1e-9, on edges and triangles that a symmetry of the mesh exchanges.
bool is_symmetric(const Topology& topology, const Reference& reference, const Symmetry& symmetry);

/// As relax() without loads, with the symmetries of the mesh that the batch's reference has: the vertices are
/// moved to the mean of their images first, and stay symmetric. Nothing is held by force: largest_force of
/// the result, that of the membrane itself, meets the tolerance as well. Errors as relax(); InputError when a
/// symmetry is one of another mesh.
RelaxResult relax_symmetric(Batch& batch, const std::vector<Symmetry>& symmetries,
                            const RelaxOptions& options = {});

}  // namespace hemoflux::membrane
