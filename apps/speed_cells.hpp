/// The thesis's timing problems with cells: Tables 8.5, 8.6 and 7.1.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/speed.hpp"

namespace hemoflux::apps {

/// A run of Table 7.1, with a cell of 2562 nodes: the thesis's figures and ours.
struct CellRun {
    std::string problem;
    double simulated_s;                        ///< of the whole run
    std::size_t cells;                         ///< of the fluid, the thesis's number
    double thesis_iterations, thesis_seconds;  ///< on a Volta V100
    long long steps = 0;                       ///< of ours, for the same time
    double step_seconds = 0;                   ///< measured
    /// Of the whole run, in proportion.
    [[nodiscard]] double seconds() const { return static_cast<double>(steps) * step_seconds; }
};

/// Seconds of one iteration (Tables 8.5 and 8.6) and the runs of Table 7.1.
struct CellSpeed {
    std::size_t nodes = 0;
    double membrane_seconds = 0;  ///< forces of one cell, and its nodes moved
    std::vector<CellRun> runs;    ///< optical tweezers first: its step is that of Table 8.6
};

/// Sets the problems up with the thesis's numbers of cells and nodes and measures some steps of each. Lattice
/// viscosity, Re_G and the step are ours. quick: few nodes and cells, one short sample.
CellSpeed time_cells(bool quick);

/// Tables 8.5, 8.6 and 7.1 with the thesis's columns beside ours.
std::string table_8_5_and_8_6(const Machine& machine, const CellSpeed& speed);
std::string table_7_1(const Machine& machine, const CellSpeed& speed);

}  // namespace hemoflux::apps
