// The run times of Table 3.18: steady square cavities between Chebyshev points and on the uniform grid.
#include <chrono>
#include <cmath>

#include "apps/speed.hpp"
#include "fluid/solver.hpp"
#include "fluid/steady.hpp"

namespace hemoflux::apps {
namespace {

constexpr double lid_speed = 0.1 / 1.7320508075688772;  // Mach number 0.1
constexpr double tolerance = 1e-7;                      // of the momentum's residual, as in the shipped cases

double seconds_to_steady_state(const meshing::Axis& axis, int reynolds, fluid::GradientMethod gradient) {
    fluid::Patches patches;
    patches.fill(fluid::wall_patch());
    patches[3] = fluid::velocity_patch([](const Vec3d&) { return Vec3d{lid_speed, 0, 0}; });
    patches[4] = patches[5] = fluid::periodic_patch();
    meshing::RectilinearGrid grid;
    grid.axes[0] = grid.axes[1] = axis;
    grid.axes[2] = meshing::uniform_axis(0, 1e-2, 1);
    fluid::SolverOptions options;
    options.nu = lid_speed / reynolds;  // the cavity's edge is 1
    options.gradient = gradient;
    const auto start = std::chrono::steady_clock::now();
    fluid::Solver solver(grid, patches, options);
    fluid::SteadyOptions steady;
    steady.tolerance = tolerance;
    const fluid::SteadyResult result = fluid::find_steady_state(solver, steady);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result.end == fluid::SteadyEnd::converged ? seconds : std::nan("");
}

}  // namespace

std::vector<SteadyCavity> steady_cavities(bool quick) {
    using fluid::GradientMethod;
    std::vector<SteadyCavity> cavities;
    struct Row {
        int reynolds, edge;
        double gauss, least_squares, uniform;
    };
    constexpr Row rows[] = {{100, 61, 153.24, 148.33, 0},  {400, 61, 177.09, 192.25, 0},
                            {1000, 81, 500.57, 542.68, 0}, {3200, 101, 1219.71, 1366.36, 0},
                            {100, 129, 0, 0, 1177.27},     {400, 129, 0, 0, 2704.46},
                            {1000, 129, 0, 0, 3984.87},    {3200, 129, 0, 0, 8463.08}};
    for (const Row& row : rows) {
        if (quick && row.reynolds > 100) continue;
        const int edge = quick ? row.edge / 4 : row.edge;
        const bool uniform = row.uniform > 0;
        const meshing::Axis axis =
            uniform ? meshing::uniform_axis(0, 1, edge) : meshing::chebyshev_axis(0, 1, edge);
        SteadyCavity cavity{row.reynolds, edge * edge, uniform, {row.gauss, row.least_squares}, {0, 0}};
        if (uniform) cavity.thesis[0] = cavity.thesis[1] = row.uniform;
        cavity.ours[1] = seconds_to_steady_state(axis, row.reynolds, GradientMethod::least_squares);
        // on equal cells both operators are one
        cavity.ours[0] = uniform ? cavity.ours[1]
                                 : seconds_to_steady_state(axis, row.reynolds, GradientMethod::green_gauss);
        cavities.push_back(cavity);
    }
    return cavities;
}

}  // namespace hemoflux::apps
