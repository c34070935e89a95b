/// A box of hexahedra, straight or distorted: for tests, benchmarks and simple channels.
#pragma once

#include <array>
#include <cstdint>

#include "meshing/hex_mesh.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::meshing {

/// How a box is distorted. Its border stays where it is, and a direction of one cell stays straight.
struct BoxDistortion {
    /// Smooth skew: a node moves along each axis by this fraction of the box times sin(2 pi x / L) over all axes.
    double skew = 0;
    /// Every inner node moves along each axis by up to this fraction of its smaller cell width, at random.
    double random = 0;
    /// Cells and their nodes are listed in random order and every cell is turned at random, so that nothing of the
    /// rows remains.
    bool shuffle = false;
    std::uint64_t seed = 1;
};

/// The hexahedra of a rectilinear grid, with the patches x-, x+, y-, y+, z-, z+. InputError unless
/// |skew| <= 0.1 and 0 <= random <= 0.45.
HexMesh box_mesh(const RectilinearGrid& grid, const BoxDistortion& distortion = {});

/// Equal cells between two corners.
HexMesh box_mesh(const Vec3d& lower, const Vec3d& upper, const std::array<int, 3>& cells,
                 const BoxDistortion& distortion = {});

}  // namespace hemoflux::meshing
