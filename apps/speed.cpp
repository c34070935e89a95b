#include "apps/speed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "exchange/backend.hpp"
#include "exchange/pack.hpp"
#include "fluid/hex_solver.hpp"
#include "fluid/solver.hpp"
#include "meshing/hex_box.hpp"

namespace hemoflux::apps {
namespace {

constexpr double width = 1;  // of a cell; speeds depend on no length

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "unknown";
}

/// Calls per second settled, then samples.
struct Sampler {
    int samples;
    double least;
    explicit Sampler(bool quick) : samples(quick ? 1 : 5), least(quick ? 0.005 : 0.2) {}
};

double seconds_of(const std::function<void()>& work, std::size_t calls) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    for (std::size_t i = 0; i < calls; ++i) work();
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Median time of one call, and how many were made.
std::pair<double, std::size_t> sample(const std::function<void()>& work, int samples, double least) {
    std::size_t calls = 1, made = 0;
    double time = seconds_of(work, calls);
    for (made = 1; time < least; made += calls) {
        calls = static_cast<std::size_t>(std::ceil(
            static_cast<double>(calls) * std::clamp(1.2 * least / std::max(time, 1e-9), 1.5, 100.0)));
        time = seconds_of(work, calls);
    }
    std::vector<double> times{time / static_cast<double>(calls)};
    for (int s = 1; s < samples; ++s, made += calls)
        times.push_back(seconds_of(work, calls) / static_cast<double>(calls));
    std::nth_element(times.begin(), times.begin() + samples / 2, times.end());
    return {times[static_cast<std::size_t>(samples / 2)], made};
}

fluid::FlowPoint wave(const Vec3d& x, double length) {
    const double turn = 2 * M_PI / length;
    return {1 + 0.01 * std::sin(turn * x.x) * std::cos(turn * x.y),
            {0.05 * std::sin(turn * x.y), 0.05 * std::cos(turn * x.z), 0.05 * std::sin(turn * x.x)}};
}

meshing::RectilinearGrid cube(int n, bool stretched) {
    const double half = n * width / 2;
    meshing::RectilinearGrid grid;
    for (meshing::Axis& axis : grid.axes)
        axis = stretched ? meshing::plateau_axis(-half, half, n, n / 3.0, 6.0 / n)
                         : meshing::uniform_axis(-half, half, n);
    return grid;
}

/// Evaluates the residual alone, the ghost cells being filled.
std::function<void()> residual_of(fluid::Solver& solver) {
    solver.evaluate();
    const fluid::SolverOptions& o = solver.options();
    const auto& r = solver.residual().view().q;
    fluid::FlowParameters p;
    p.nu = o.nu;
    p.with_force = o.with_force;
    p.with_viscosity = o.with_viscosity;
    return [&solver, p, out = fluid::ResidualView{{r[0], r[1], r[2], r[3]}}] {
        fluid::evaluate_residual(solver.grid().view(), solver.state().view(), solver.boundary().view(), p,
                                 out);
    };
}

fluid::SolverOptions options_of(double nu) {
    fluid::SolverOptions o;
    o.nu = nu;
    return o;
}

fluid::Patch lid(double speed) {
    return fluid::velocity_patch([speed](const Vec3d&) { return Vec3d{speed, 0, 0}; });
}

constexpr double lid_speed = 0.1, cavity_reynolds = 100, stages = 4;

/// Steps of the cavity of n cells an edge.
CavityCost cost_of(fluid::Flow& flow, bool quick) {
    const Sampler s(quick);
    // cost does not depend on the step; this one is well within what is stable
    const auto [seconds, made] = sample([&] { flow.step(0.1 * width); }, s.samples, s.least);
    return {flow.cells(), made, seconds};
}

}  // namespace

Machine this_machine() {
    return {processor_name(), exchange::backend_name(), static_cast<int>(std::thread::hardware_concurrency()),
            exchange::threads(), exchange::pack_lanes};
}

double median_seconds(const std::function<void()>& work, int samples, double least) {
    return sample(work, samples, least).first;
}

std::vector<Timing> time_kernels(const std::vector<int>& sizes, bool quick) {
    const Sampler s(quick);
    std::vector<Timing> timings;
    for (const int n : sizes) {
        const auto cells =
            static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
        const auto add = [&](const char* kernel, double part, const fluid::Work& work,
                             const std::function<void()>& call) {
            timings.push_back({kernel, cells, median_seconds(call, s.samples, s.least) / part, work});
        };
        const auto flow = [&](const Vec3d& x) { return wave(x, n * width); };
        {
            fluid::Patches periodic;
            periodic.fill(fluid::periodic_patch());
            fluid::Solver solver(cube(n, false), periodic, options_of(0.5 * width));
            solver.initialise(flow);
            add("residual, cubic cells", 1, fluid::cubic_work, residual_of(solver));
            add("Runge-Kutta step, a stage", stages, {}, [&] { solver.step(0.01 * width); });
        }
        {
            fluid::Patches walls;
            walls.fill(fluid::wall_patch());
            walls[3] = lid(lid_speed);
            fluid::SolverOptions o = options_of(0.5 * width);
            o.with_force = o.with_viscosity = true;
            fluid::Solver solver(cube(n, true), walls, o);
            solver.initialise(flow);
            add("residual, stretched, viscosity and force fields", 1, fluid::full_work, residual_of(solver));
        }
        fluid::HexPatches walls;
        for (const char* name : {"x-", "x+", "y-", "z-", "z+"}) walls[name] = fluid::wall_patch();
        walls["y+"] = lid(lid_speed);
        fluid::HexSolver solver(meshing::make_hex_grid(meshing::box_mesh(cube(n, false))), walls,
                                options_of(0.5 * width));
        solver.initialise(flow);
        add("residual, unstructured, ghost cells and gradients", 1, fluid::unstructured_work,
            [&] { solver.evaluate(); });
    }
    return timings;
}

CavityCost structured_cavity(int n, bool quick) {
    fluid::Patches walls;
    walls.fill(fluid::wall_patch());
    walls[3] = lid(lid_speed);
    fluid::Solver solver(cube(n, false), walls, options_of(lid_speed * n * width / cavity_reynolds));
    return cost_of(solver, quick);
}

CavityCost unstructured_cavity(int n, bool quick) {
    fluid::HexPatches walls;
    for (const char* name : {"x-", "x+", "y-", "z-", "z+"}) walls[name] = fluid::wall_patch();
    walls["y+"] = lid(lid_speed);
    fluid::HexSolver solver(meshing::make_hex_grid(meshing::box_mesh(cube(n, false))), walls,
                            options_of(lid_speed * n * width / cavity_reynolds));
    return cost_of(solver, quick);
}

}  // namespace hemoflux::apps
