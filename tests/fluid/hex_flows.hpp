/// Meshes and helpers for tests of the unstructured solver.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "fluid/hex_solver.hpp"
#include "meshing/hex_box.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::fluid::test {

/// Pairs of opposite patches of a box that are periodic; axes is a string such as "xz".
inline std::vector<meshing::PeriodicPair> pairs(const std::string& axes) {
    std::vector<meshing::PeriodicPair> all;
    for (const char a : axes) all.push_back({std::string(1, a) + "-", std::string(1, a) + "+"});
    return all;
}

/// The conditions of a rectilinear box by patch names, periodic ones left out.
inline HexPatches by_name(const Patches& patches) {
    const char* names[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    HexPatches all;
    for (std::size_t p = 0; p < 6; ++p)
        if (patches[p].velocity != VelocityCondition::periodic) all[names[p]] = patches[p];
    return all;
}

/// Walls at rest on all patches.
inline HexPatches walls(const meshing::HexGrid& grid) {
    HexPatches patches;
    for (const auto& p : grid.patches) patches[p.name] = wall_patch();
    return patches;
}

/// A box from the origin of n equal or distorted cells.
inline meshing::HexGrid box_grid(const Vec3d& length, const std::array<int, 3>& n,
                                 const std::string& periodic, const meshing::BoxDistortion& distortion = {}) {
    return meshing::make_hex_grid(meshing::box_mesh(Vec3d{0, 0, 0}, length, n, distortion), pairs(periodic));
}

/// For every cell of an undistorted box, the number (x fastest) of the rectilinear cell at the same place.
inline std::vector<std::size_t> same_cells(const Flow& hex, const Flow& rectilinear) {
    std::map<std::tuple<long, long, long>, std::size_t> place;
    const auto key = [](const Vec3d& x) {
        return std::make_tuple(std::lround(1e6 * x.x), std::lround(1e6 * x.y), std::lround(1e6 * x.z));
    };
    for (std::size_t i = 0; i < rectilinear.cells(); ++i) place[key(rectilinear.centre(i))] = i;
    std::vector<std::size_t> same;
    for (std::size_t i = 0; i < hex.cells(); ++i) same.push_back(place.at(key(hex.centre(i))));
    return same;
}

}  // namespace hemoflux::fluid::test
