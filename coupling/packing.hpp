/// Many cells of one shape in a box, placed and turned at random without overlap.
///
/// First each cell is put where it fits (random sequential addition). Where the box fills up before all are placed, the
/// cells start small instead, and random moves and turns alternate with growth until they have their size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coupling/node_bins.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// The shortest turn that takes the z axis to the unit vector `axis` (Rodrigues): v -> v + k x v + k x (k x v)/(1 + a_z),
/// k = z x a; half a turn about x where a = -z.
struct AxisTurn {
    Vec3d axis{0, 0, 1};
    /// v turned.
    [[nodiscard]] Vec3d operator()(const Vec3d& v) const;
    /// v turned by the reverse.
    [[nodiscard]] Vec3d back(const Vec3d& v) const;
};

/// Where a cell is and where its axis points.
struct Placement {
    Vec3d position{0, 0, 0}, axis{0, 0, 1};
};

/// What is packed.
struct PackingInput {
    NodeBox box;
    std::vector<Vec3d> shape;  ///< vertices about the origin, axis along z
    std::vector<std::array<int, 3>> triangles;
    std::size_t cells = 0;
    std::uint64_t seed = 1;
    double gap = 0.2;    ///< between any two cells, and from walls, um
    int patience = 200;  ///< moves of every cell without progress before it is given up
};

/// Places the cells; the same for the same input everywhere. Throws InputError that says how far it came when no
/// arrangement was found.
std::vector<Placement> pack(const PackingInput& input);

}  // namespace hemoflux::coupling
