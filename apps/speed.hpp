/// How fast this machine computes: times of the fluid's main kernels, and the thesis's timing problems.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "fluid/roofline.hpp"

namespace hemoflux::apps {

/// The machine and the build.
struct Machine {
    std::string processor, backend;
    int cores = 0, threads = 0;
    std::size_t lanes = 0;  ///< doubles side by side in one register
};
Machine this_machine();

/// One kernel on one grid.
struct Timing {
    std::string kernel;
    std::size_t cells = 0;
    double seconds = 0;  ///< of one evaluation of all cells, median
    fluid::Work work;    ///< of one cell, counted by hand
    /// Million cells per second and thread.
    [[nodiscard]] double rate(int threads) const {
        return static_cast<double>(cells) / seconds / threads * 1e-6;
    }
};

/// Median wall time of one call of `work`, s: `samples` samples, each of as many calls as take `least` seconds.
double median_seconds(const std::function<void()>& work, int samples, double least);

/// Times the residual of cubic cells, of stretched cells with force, viscosity field and given velocities, and of
/// unstructured cells, and a Runge-Kutta step per stage, on n^3 cells for each n. quick: one short sample.
std::vector<Timing> time_kernels(const std::vector<int>& sizes, bool quick);

/// One Runge-Kutta iteration of the lid-driven cavity of Table 8.4, measured on `measured_cells` cells.
struct CavityCost {
    std::size_t measured_cells = 0, iterations = 0;  ///< iterations: measured, all samples together
    double seconds = 0;                              ///< of one iteration of measured_cells cells
    /// Seconds of 25,000 iterations of 1,000,000 cells, in proportion.
    [[nodiscard]] double table_seconds() const {
        return seconds * 25000 * 1e6 / static_cast<double>(measured_cells);
    }
};
/// n: cells along each edge.
CavityCost structured_cavity(int n, bool quick);
CavityCost unstructured_cavity(int n, bool quick);

/// One steady cavity of Table 3.18. Seconds of whole solutions, [0] with Green-Gauss, [1] with least-squares gradients,
/// which are one on uniform grids; NaN where the steady state was not reached.
struct SteadyCavity {
    int reynolds, cells;
    bool uniform;
    double thesis[2], ours[2];
};
/// Solves the cavities of Table 3.18 from rest, with the implicit method and to the tolerance of the shipped cases.
/// quick: Re 100 alone, on coarse grids.
std::vector<SteadyCavity> steady_cavities(bool quick);

/// The machine and timings as text tables and as JSON.
std::string describe(const Machine& machine);
std::string table(const Machine& machine, const std::vector<Timing>& timings);
std::string to_json(const Machine& machine, const std::vector<Timing>& timings);
/// Table 8.4 with the thesis's columns beside ours.
std::string table_8_4(const Machine& machine, const CavityCost& structured, const CavityCost& unstructured);
/// Table 3.18, the same way.
std::string table_3_18(const Machine& machine, const std::vector<SteadyCavity>& cavities);

}  // namespace hemoflux::apps
