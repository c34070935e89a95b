#include "fluid/hex_sweep.hpp"

#include <algorithm>
#include <numeric>

namespace hemoflux::fluid {
namespace {

using exchange::round_up;

/// For every cell the first face in the order of the sweep that it or a later cell has.
std::vector<std::size_t> first_needed_face(const meshing::HexGrid& grid, const HexSweep& sweep) {
    std::vector<std::size_t> first(grid.cells() + 1, grid.faces());
    for (std::size_t k = grid.faces(); k-- > 0;) {
        const std::uint32_t f = sweep.faces[k];
        first[grid.left[f]] = k;
        if (grid.right[f] < grid.cells()) first[grid.right[f]] = k;
    }
    for (std::size_t c = grid.cells(); c-- > 0;) first[c] = std::min(first[c], first[c + 1]);
    return first;
}

}  // namespace

HexSweep plan_sweep(const meshing::HexGrid& grid, std::size_t stage_cells) {
    HexSweep sweep;
    const std::size_t cells = grid.cells(), faces = grid.faces(), interior = grid.interior_faces(),
                      padded = round_up(faces, face_block);
    sweep.faces.resize(faces);
    std::iota(sweep.faces.begin(), sweep.faces.end(), 0u);
    std::stable_sort(sweep.faces.begin(), sweep.faces.end(),
                     [&grid](std::uint32_t a, std::uint32_t b) { return grid.left[a] < grid.left[b]; });
    const std::vector<std::size_t> first_needed = first_needed_face(grid, sweep);
    HexStage stage;
    for (std::size_t first = 0; first < cells; first += stage_cells) {
        stage.gradients.first = stage.gradients.last;
        stage.ghosts.first = stage.ghosts.last;
        stage.faces.first = stage.faces.last;
        stage.cells = {first, std::min(first + stage_cells, cells)};
        std::size_t k = stage.faces.first, last_cell = 0;
        stage.lowest =
            (k < faces ? grid.left[sweep.faces[k]] : stage.gradients.first) / gradient_block * gradient_block;
        // up to a whole block, which may begin the next stage's faces
        for (; k < faces && (grid.left[sweep.faces[k]] < stage.cells.last || k % face_block != 0); ++k) {
            const std::uint32_t f = sweep.faces[k];
            last_cell = std::max<std::size_t>(last_cell, grid.left[f]);
            if (f < interior)
                last_cell = std::max<std::size_t>(last_cell, grid.right[f]);
            else
                sweep.border.push_back(static_cast<std::uint32_t>(f - interior));
        }
        stage.faces.last = k < faces ? k : padded;
        stage.ghosts.last = sweep.border.size();
        stage.gradients.last =
            stage.cells.last == cells
                ? cells
                : std::min(std::max(stage.gradients.first, round_up(last_cell + 1, gradient_block)), cells);
        sweep.cell_records = std::max(sweep.cell_records, stage.gradients.last - stage.lowest);
        sweep.ghost_records = std::max(sweep.ghost_records, stage.ghosts.last - stage.ghosts.first);
        const std::size_t needed = std::min(first_needed[first], stage.faces.first);
        sweep.fluxes = std::max(sweep.fluxes, stage.faces.last - needed);
        stage.warm_up = sweep.stages.size();
        while (stage.warm_up > 0 && needed < sweep.stages[stage.warm_up - 1].faces.last) --stage.warm_up;
        sweep.stages.push_back(stage);
    }
    sweep.cell_records = round_up(sweep.cell_records, gradient_block);
    sweep.fluxes = round_up(sweep.fluxes, face_block);
    return sweep;
}

}  // namespace hemoflux::fluid
