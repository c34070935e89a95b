/// What the accuracy of a solution on an unstructured grid hangs on.
///
///   non-orthogonality   angle between S and d, the vector from the left to the right cell's centre
///   skewness            |r_f - (the point where d meets the plane of the face)| / |d|
///   aspect ratio        of the extents of a cell, directions of one cell left out
///   growth              larger over smaller volume of two neighbours
///
/// All are perfect (0, 0, 1, 1) on equal cubes. Border faces, whose neighbour is a mirror image, do not count.
#pragma once

#include <cstddef>
#include <string>

#include "meshing/hex_grid.hpp"

namespace hemoflux::meshing {

/// Largest values with the cell (its number in the mesh) where they are found, and means.
struct HexQuality {
    std::size_t cells = 0, faces = 0;
    double volume = 0, smallest_volume = 0, largest_volume = 0;  ///< um^3
    double nonorthogonality = 0, mean_nonorthogonality = 0;      ///< degrees
    double skewness = 0, mean_skewness = 0;
    double aspect = 1, growth = 1;
    double smallest_delta = 0, largest_delta = 0;  ///< streaming distances, um
    std::size_t bandwidth = 0;                     ///< largest difference of two neighbours' numbers
    std::size_t nonorthogonal_cell = 0, skew_cell = 0, aspect_cell = 0, growth_cell = 0;
};

/// The quality numbers of a grid.
HexQuality quality(const HexGrid& grid);

/// The report `hemoflux mesh hex` prints: one quantity a line, lengths in `unit`.
std::string report(const HexQuality& quality, const std::string& unit = "um");

}  // namespace hemoflux::meshing
