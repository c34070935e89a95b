/// Where the blocks of a compact Jacobian and of its incomplete factors lie: one row a cell, one block for every neighbour
/// across a face, and blocks that elimination fills in, up to a level: a block that arises from two of levels a and b has
/// level a + b + 1, those of the matrix have 0 (Saad 2003, section 10.3).
///
/// Rows are renumbered level by level: a row's level is one more than the highest level among its neighbours of lower
/// number. Rows of one level do not depend on each other in an incomplete factorisation or a triangular solve, so they
/// are done in parallel, and the result is that of the sequential order whatever the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "fluid/compact_model.hpp"

namespace hemoflux::fluid {

/// Block rows without their diagonal. Row numbers are the new ones unless said otherwise.
struct CompactPattern {
    /// In left_right and right_left: no block.
    static constexpr std::uint32_t none = 0xffffffffu;

    std::vector<std::uint32_t> level;    ///< first row of every level, and the number of rows
    std::vector<std::uint32_t> cell;     ///< [row] number of the cell
    std::vector<std::uint32_t> first;    ///< [row] first block of a row; one more entry for the end
    std::vector<std::uint32_t> upper;    ///< [row] first block whose column is above the diagonal
    std::vector<std::uint32_t> column;   ///< [block] ascending within a row
    std::vector<std::uint32_t> reverse;  ///< [block] the block (column, row)
    /// Per interior face of the model, in its order: the blocks (left, right) and (right, left), `none` for a face that
    /// repeats a pair of cells, which is left out of the matrix.
    std::vector<std::uint32_t> left_right, right_left;
    std::vector<std::uint32_t> interior;      ///< numbers of the interior faces in the model
    std::vector<std::uint32_t> border;        ///< numbers of the border faces, sorted by row
    std::vector<std::uint32_t> first_border;  ///< [row] first entry of `border`; one more for the end
};

/// Builds the pattern of `cells` cells. fill: level of the blocks that incomplete factors get beside those of the matrix.
CompactPattern make_compact_pattern(std::size_t cells, const std::vector<CompactFace>& faces,
                                    std::uint32_t fill = 0);

/// The level of fill that pays: 4 in a plane or along a line, where a cavity of 129 x 129 cells at Re = 400, gamma = 1 takes
/// 428 residual evaluations instead of 3967, and the factors of a channel four cells long are complete; 0 in space, where
/// they would be many times larger than the matrix.
std::uint32_t default_fill(std::size_t cells, const std::vector<CompactFace>& faces);

}  // namespace hemoflux::fluid
