/// The one way from a mesh to a cell: mesh, reference, start shape, relaxation (section 6.4).
///
///   sphere mesh -> spheroid of given reduced volume: L_0, A_k0 -> disc, by either route
///               -> that disc's own L_0, A_k0 (stress-free), or one L_0 and one A_k0 for all -> disc again
///
/// The literal route of section 6.4, a sphere deflated to 0.95 of its volume, inverts a cap; the analytic
/// spheroid takes its place.
#pragma once

#include <memory>
#include <vector>

#include "exchange/vec3.hpp"
#include "membrane/parameters.hpp"
#include "membrane/reference.hpp"
#include "membrane/relax.hpp"
#include "membrane/topology.hpp"

namespace hemoflux::membrane {

/// Where a cell takes the rest lengths of its springs and the rest areas of its triangles from.
enum class ReferenceKind {
    spheroid,        ///< oblate spheroid of the area A_0
    stress_free,     ///< its own relaxed disc (Table 6.1), or the imported shape
    uniform_length,  ///< one length for all springs and one area for all triangles (Table 6.2)
    coarse_grained,  ///< the same with the length of a coarse-grained spectrin network
    given,           ///< ShapeOptions::reference_shape
};

/// The way to the minimum; both end in the same disc.
enum class Route {
    evans_fung,  ///< from the analytic disc (6.44)
    deflation,   ///< from the spheroid, the volume reduced in 12 steps
};

/// What cell to make.
struct ShapeOptions {
    ReferenceKind reference = ReferenceKind::stress_free;
    Parameters parameters{};
    RestState rest{};
    Route route = Route::evans_fung;
    double reduced_volume = reference_reduced_volume;  ///< of the spheroid
    double spring_length = 0;  ///< of ReferenceKind::uniform_length, um; 0: 1.16 x the disc's mean_edge()
    /// Height (um) by which the middle of the start shape stands above its rim: an up-down symmetric start
    /// stays so, although a cup may have less energy.
    double camber = 0;
    std::vector<Vec3d> reference_shape = {};  ///< um, the mesh's vertices, for ReferenceKind::given
    RelaxOptions relaxation{};
};

/// A cell, all that a Batch needs.
struct Cell {
    std::shared_ptr<const Topology> topology;
    Parameters parameters;
    Reference reference;
    std::vector<Vec3d> positions;  ///< um, volume centroid at the origin; a disc's axis is along z
    RelaxResult relaxation;        ///< of the last relaxation
};

/// Relaxed discocyte on a mesh of a sphere about the origin, of any radius. Every kind of reference starts
/// from the disc of the spheroid reference with the same moduli, and without camber keeps what symmetries (symmetry.hpp)
/// sphere and reference have. InputError on bad parameters or a reference shape that does not fit, else as relax().
Cell make_discocyte(const meshing::SurfaceMesh& sphere, const ShapeOptions& options = {});

/// The same on the icosphere of a level (1: 42, 2: 162, 3: 642, 4: 2562, 5: 10242 vertices).
Cell make_discocyte(int level, const ShapeOptions& options = {});

/// A cell that has the given shape, not relaxed: ReferenceKind::stress_free, uniform_length and
/// coarse_grained take it for the disc. The directions of its vertices are the sphere of
/// ReferenceKind::spheroid. Errors as above.
Cell make_cell(const meshing::SurfaceMesh& shape, const ShapeOptions& options = {});

}  // namespace hemoflux::membrane
