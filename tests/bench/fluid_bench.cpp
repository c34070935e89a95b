#include <fmt/format.h>

#include <cmath>

#include "benchmarks.hpp"
#include "fluid/factored.hpp"
#include "fluid/hex_solver.hpp"
#include "fluid/roofline.hpp"
#include "fluid/single_residual.hpp"
#include "fluid_problem.hpp"
#include "meshing/hex_box.hpp"
#include "scalar_lbfs.hpp"

namespace hemoflux::bench {
namespace {

using benchmark::RegisterBenchmark;

/// Rates of operations and of memory traffic beside items_per_second.
void count(benchmark::State& state, std::size_t cells, const fluid::Work& work) {
    const double items = static_cast<double>(cells) * static_cast<double>(state.iterations());
    using benchmark::Counter;
    state.counters["FLOP/s"] = Counter(items * work.operations, Counter::kIsRate);
    state.counters["B/s"] = Counter(items * work.bytes, Counter::kIsRate);
}

void residual(benchmark::State& state, int n, Features features, int threads) {
    const FluidProblem problem({n, n, n}, features);
    measure(state, threads, problem.cells(), [&] { problem.evaluate(); });
    count(state, problem.cells(), features == Features::plain ? fluid::cubic_work : fluid::full_work);
}

/// In single precision; the state is rounded once.
void residual_single(benchmark::State& state, int n, int threads) {
    const FluidProblem problem({n, n, n}, Features::plain);
    fluid::SingleResidual single(problem.grid.view());
    single.round(problem.state.view());
    measure(state, threads, problem.cells(),
            [&] { single.evaluate_rounded(problem.boundary.view(), problem.parameters); });
    count(state, problem.cells(), fluid::single_work);
}

/// With ghost cells and gradients, on a box of shuffled hexahedra.
void residual_unstructured(benchmark::State& state, int n, int threads) {
    const double edge = n * FluidProblem::width;
    meshing::BoxDistortion shuffled;
    shuffled.shuffle = true;
    fluid::HexPatches walls;
    for (const char* name : {"x-", "x+", "y-", "y+", "z-", "z+"}) walls[name] = fluid::wall_patch();
    fluid::SolverOptions options;
    options.nu = 0.5 * FluidProblem::width;
    fluid::HexSolver solver(
        meshing::make_hex_grid(meshing::box_mesh({0, 0, 0}, {edge, edge, edge}, {n, n, n}, shuffled)), walls,
        options);
    solver.initialise([&](const Vec3d& x) {
        return fluid::FlowPoint{1, {0.05 * std::sin(6 * x.y / edge), 0.05 * std::sin(6 * x.z / edge), 0}};
    });
    measure(state, threads, solver.cells(), [&] { solver.evaluate(); });
    count(state, solver.cells(), fluid::unstructured_work);
}

void residual_by_cell(benchmark::State& state, int n, Features features) {
    const FluidProblem problem({n, n, n}, features);
    measure(state, 1, problem.cells(), [&] { problem.evaluate_by_cell(); });
}

void residual_scalar(benchmark::State& state, int n) {
    const FluidProblem problem({n, n, n}, Features::plain);
    const auto side = static_cast<std::size_t>(n);
    ScalarFlow scalar({side, side, side}, FluidProblem::width, problem.parameters.nu);
    for (std::size_t c = 0; c < 4; ++c)
        scalar.fields()[c] = problem.state.interior(problem.state.view().q[c]);
    measure(state, 1, problem.cells(), [&] { scalar.evaluate(); });
}

void ghost_fill(benchmark::State& state, int n, int threads) {
    const FluidProblem problem({n, n, n}, Features::full);
    measure(state, threads, problem.cells(),
            [&] { problem.boundary.fill(problem.grid.view(), problem.state.view()); });
}

void factored_solve(benchmark::State& state, int n, int threads) {
    const FluidProblem problem({n, n, n}, Features::full);
    // Zero-gradient sides, a constant and dt = 1: the solution is the constant again, so that however many
    // solves follow each other the numbers neither grow nor fade into denormals.
    fluid::Patches open;
    open.fill(fluid::open_patch());
    const fluid::Boundary boundary(open, problem.grid);
    const fluid::Factored factored(problem.grid, boundary, problem.parameters.nu, 1.0);
    fluid::State increment(problem.grid.view().layout, false, false, 0);
    const auto& q = increment.view().q;
    for (double* component : q) increment.set_interior(component, std::vector<double>(problem.cells(), 1.0));
    measure(state, threads, problem.cells(), [&] { factored.solve({{q[0], q[1], q[2], q[3]}}); });
}

}  // namespace

void add_fluid_benchmarks() {
    for (const int n : {30, 40, 100}) {
        for (const Features features : {Features::plain, Features::full}) {
            const char* name = features == Features::plain ? "plain" : "full";
            for (const int threads : thread_counts())
                RegisterBenchmark(fmt::format("residual/{}/{}/{}", n, name, threads).c_str(), residual, n,
                                  features, threads)
                    ->UseRealTime()
                    ->Unit(benchmark::kMillisecond);
            RegisterBenchmark(fmt::format("residual_by_cell/{}/{}", n, name).c_str(), residual_by_cell, n,
                              features)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
        }
        RegisterBenchmark(fmt::format("residual_scalar/{}/plain", n).c_str(), residual_scalar, n)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
        for (const int threads : thread_counts()) {
            RegisterBenchmark(fmt::format("residual_single/{}/{}", n, threads).c_str(), residual_single, n,
                              threads)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
            RegisterBenchmark(fmt::format("residual_unstructured/{}/{}", n, threads).c_str(),
                              residual_unstructured, n, threads)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
            RegisterBenchmark(fmt::format("ghost_fill/{}/{}", n, threads).c_str(), ghost_fill, n, threads)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
            RegisterBenchmark(fmt::format("factored_solve/{}/{}", n, threads).c_str(), factored_solve, n,
                              threads)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
        }
    }
}

}  // namespace hemoflux::bench
