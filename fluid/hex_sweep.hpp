/// The order in which the residual visits an unstructured grid, in stages that keep what they share in the cache.
///
/// Cells are numbered so that neighbours are near each other (meshing/cell_order.hpp), and faces here by their left, lower,
/// cell. A stage completes the balances of a few cells: it computes the fluxes through the faces whose left cells these
/// are, and before them the gradients these fluxes need, of cells a bandwidth ahead. Faces to lower cells were computed by
/// earlier stages. A record or flux is not needed for longer than the sweep takes to pass a bandwidth, so that its place is
/// used again: records and fluxes live in rings of a few bandwidths and never reach the memory.
///
/// Threads share out the stages, each a piece of the sweep in rings of its own. A piece begins with the gradients and fluxes
/// of the stages before that its first balances need, which are thus computed twice. What is computed for a cell or a face
/// does not depend on the stages or pieces, so neither do results.
#pragma once

#include <cstdint>
#include <vector>

#include "exchange/pack.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::fluid {

/// Faces a block of face data holds.
inline constexpr std::size_t face_block = exchange::on_gpu ? 32 : exchange::row_alignment;
/// Cells whose gradients one task computes; their records lie side by side.
inline constexpr std::size_t gradient_block = exchange::on_gpu ? 1 : 64;

/// first <= i < last.
struct HexRange {
    std::size_t first = 0, last = 0;
};

/// What one stage computes, in this order. All stages together compute everything once.
struct HexStage {
    HexRange gradients;  ///< cells; from a multiple of gradient_block on
    HexRange ghosts;  ///< border faces, by their places in HexSweep::border, whose ghost records are filled
    HexRange faces;   ///< faces in the order of the sweep; whole blocks
    HexRange cells;   ///< cells whose balances are complete
    std::size_t lowest = 0;   ///< no cell before it, a multiple of gradient_block, lies at one of the faces
    std::size_t warm_up = 0;  ///< stage that computes the first flux these and later balances need
};

/// The stages of a grid and the sizes of its rings.
struct HexSweep {
    /// Numbers in the grid of the faces, in the order of the sweep: by left cell, then by number.
    std::vector<std::uint32_t> faces;
    /// The border faces, counted from the first, in the order of the sweep.
    std::vector<std::uint32_t> border;
    std::vector<HexStage> stages;
    /// Places for records of cells and of ghost cells and for fluxes. Cell c has the place c % cell_records, the k-th ghost
    /// of the sweep cell_records + k % ghost_records, and the k-th face of the sweep k % fluxes.
    std::size_t cell_records = 0, ghost_records = 0, fluxes = 0;
};

/// Plans a sweep with `stage_cells` cells a stage, the last stage perhaps fewer.
HexSweep plan_sweep(const meshing::HexGrid& grid, std::size_t stage_cells);

}  // namespace hemoflux::fluid
