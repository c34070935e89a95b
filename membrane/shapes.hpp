/// From an icosphere to a relaxed red blood cell: references, start shapes and relaxation in one call.
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
    spheroid,        ///< oblate spheroid of the area and 0.95 of the volume of the sphere
    stress_free,     ///< its own relaxed disc (Table 6.1)
    uniform_length,  ///< one length for all springs and one area for all triangles (Table 6.2)
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
    Route route = Route::evans_fung;
    double spring_length = 0;  ///< of ReferenceKind::uniform_length, um; 0: 1.16 x the disc's mean_edge()
    RelaxOptions relaxation{};
};

/// A relaxed cell, all that a Batch needs.
struct Cell {
    std::shared_ptr<const Topology> topology;
    Parameters parameters;
    Reference reference;
    std::vector<Vec3d> positions;  ///< um, volume centroid at the origin, the disc's axis along z
    RelaxResult relaxation;        ///< of the last relaxation
};

/// Relaxed discocyte on the icosphere of a level (1: 42, 2: 162, 3: 642, 4: 2562, 5: 10242 vertices). Every
/// kind starts from the disc of the spheroid reference with the same moduli. Throws InputError on a bad level
/// or bad parameters, NumericalError when a relaxation fails.
Cell make_discocyte(int level, const ShapeOptions& options = {});

}  // namespace hemoflux::membrane
