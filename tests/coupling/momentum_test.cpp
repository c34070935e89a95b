#include "coupling/momentum.hpp"

#include <gtest/gtest.h>

#include "exchange/backend.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::coupling {
namespace {

/// A stretched cell in a channel of uneven cells, along x, driven by a force and by a moving wall, with a cytosol of its
/// own. Returns the largest error of the balance over some steps, and the last step.
std::pair<double, MomentumStep> balance(fluid::Scheme scheme, bool walls_in_z, double cells_per_step) {
    exchange::set_threads(1);
    const membrane::Cell cell = membrane::make_discocyte(2);
    membrane::Batch cells(cell.topology, cell.parameters, cell.reference, 1);
    std::vector<Vec3d> at;
    for (const Vec3d& r : cell.positions) at.push_back({1.1 * r.x, r.z, -r.y});
    cells.set_positions(0, at);
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(-5.5, 5.5, 14), meshing::plateau_axis(-5.5, 5.5, 18, 5, 0.3),
                 meshing::uniform_axis(-6, 6, 16)};
    const double h = grid.smallest();
    fluid::Patches patches;
    patches.fill(fluid::periodic_patch());
    patches[2] = fluid::wall_patch();
    patches[3] = fluid::velocity_patch([](const Vec3d&) { return Vec3d{0.01, 0, 0}; });
    if (walls_in_z) patches[4] = patches[5] = fluid::wall_patch();
    fluid::SolverOptions o;
    o.nu = 0.5 * h;
    o.with_force = o.with_viscosity = true;
    o.uniform_force[0] = 1e-5;
    o.scheme = scheme;
    fluid::Solver fluid(grid, patches, o);
    LoopOptions l;
    l.force_factor = 0.05;
    l.nu_inside = {0.3 * o.nu};
    Loop loop(fluid, cells, l);
    MomentumBalance balance(fluid, loop);
    const double dt = cells_per_step * h;
    double worst = 0;
    MomentumStep last;
    for (int s = 0; s < 8; ++s) {
        balance.before();
        loop.step(dt);
        last = balance.after(dt);
        worst = std::max(worst, last.error());
    }
    return {worst, last};
}

}  // namespace

TEST(MomentumBalance, ClosesToRoundingWithWalls) {
    using fluid::Scheme;
    for (const auto& [scheme, step] :
         {std::pair{Scheme::euler, 0.1}, {Scheme::factored, 0.5}, {Scheme::factored, 1.2}})
        for (const bool duct : {false, true}) {
            const auto [error, last] = balance(scheme, duct, step);
            EXPECT_LT(error, 1e-11) << duct << step;
            // no part is trivial
            EXPECT_GT(norm(last.gained), 1e-4 * last.gross);
            EXPECT_GT(norm(last.sides), 1e-4 * last.gross);
            EXPECT_GT(norm(last.force), 1e-6 * last.gross);
        }
}

TEST(MomentumBalance, LeavesTheFluidAsItIs) {
    fluid::Patches patches;
    patches.fill(fluid::wall_patch());
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 4, 8), meshing::uniform_axis(0, 4, 8),
                 meshing::uniform_axis(0, 4, 8)};
    fluid::SolverOptions o;
    o.nu = 0.2;
    o.with_force = true;
    o.uniform_force[1] = 1e-3;
    o.scheme = fluid::Scheme::factored;
    fluid::Solver fluid(grid, patches, o);
    Loop loop(fluid, Kernel::phi4);
    MomentumBalance balance(fluid, loop);
    for (int s = 0; s < 3; ++s) {
        balance.before();
        loop.step(0.1);
        const auto before = fluid.values(2);
        EXPECT_LT(balance.after(0.1).error(), 1e-12);
        EXPECT_EQ(fluid.values(2), before);
    }
}

}  // namespace hemoflux::coupling
