#include <fmt/format.h>

#include "benchmarks.hpp"
#include "coupling/interpolate.hpp"
#include "coupling/spread.hpp"
#include "coupling/stencil.hpp"
#include "coupling/viscosity.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::bench {
namespace {

using exchange::Buffer;

/// The tank-treading case's grid, 12 um and 30^3 cells, and a disc of 2562 nodes at its centre.
struct CoupledProblem {
    CoupledProblem()
        : surface(meshing::evans_fung(meshing::icosphere(4, 1.0))), grid(box(), {false, false, false}) {
        std::vector<double> host[3];
        for (const Vec3d& r : surface.vertices)
            host[0].push_back(r.x), host[1].push_back(r.y), host[2].push_back(r.z);
        for (std::size_t a = 0; a < 3; ++a) {
            position[a] = Buffer<double>(host[a]);
            force[a] = Buffer<double>(std::vector<double>(nodes(), 1e-3));
            velocity[a] = Buffer<double>(nodes());
            field[a] = Buffer<double>(grid.view().layout.size);
        }
    }
    static meshing::RectilinearGrid box() {
        const meshing::Axis axis = meshing::plateau_axis(-6, 6, 30, 10, 0.2);
        return {{axis, axis, axis}};
    }
    [[nodiscard]] std::size_t nodes() const { return surface.vertices.size(); }
    void update(coupling::StencilSet& stencils) const {
        stencils.update(position[0].data(), position[1].data(), position[2].data());
    }
    exchange::FieldView view() {
        return {{field[0].data(), field[1].data(), field[2].data()}, grid.view().layout.size};
    }

    meshing::SurfaceMesh surface;
    coupling::CellGrid grid;
    Buffer<double> position[3], force[3], velocity[3], field[3];
};

void stencil(benchmark::State& state, coupling::Kernel kernel, int threads) {
    const CoupledProblem problem;
    coupling::StencilSet stencils(problem.grid, kernel, problem.nodes());
    measure(state, threads, problem.nodes(), [&] { problem.update(stencils); });
}

void spread(benchmark::State& state, coupling::Kernel kernel, int threads) {
    CoupledProblem problem;
    coupling::StencilSet stencils(problem.grid, kernel, problem.nodes());
    problem.update(stencils);
    coupling::Spreader spreader(stencils);
    const auto& f = problem.force;
    measure(state, threads, problem.nodes(),
            [&] { spreader.spread(f[0].data(), f[1].data(), f[2].data(), 1.0, problem.view()); });
}

void interpolate(benchmark::State& state, coupling::Kernel kernel, int threads) {
    CoupledProblem problem;
    coupling::StencilSet stencils(problem.grid, kernel, problem.nodes());
    problem.update(stencils);
    auto& v = problem.velocity;
    measure(state, threads, problem.nodes(),
            [&] { coupling::interpolate(stencils, problem.view(), v[0].data(), v[1].data(), v[2].data()); });
}

enum class Recompute { always, when_moved };

void viscosity(benchmark::State& state, Recompute when, int threads) {
    CoupledProblem problem;
    coupling::InteriorViscosity interior(problem.grid, problem.surface.triangles, problem.nodes(), {0.05},
                                         0.2);
    double* const nu = problem.field[0].data();
    const auto& p = problem.position;
    interior.recompute(p[0].data(), p[1].data(), p[2].data(), nu);
    measure(state, threads, problem.nodes(), [&] {
        if (when == Recompute::always)
            interior.recompute(p[0].data(), p[1].data(), p[2].data(), nu);
        else
            interior.update(p[0].data(), p[1].data(), p[2].data(), nu);
    });
}

template <class Function, class Choice>
void add(const std::string& name, Function function, Choice choice) {
    for (const int threads : thread_counts())
        benchmark::RegisterBenchmark(fmt::format("{}/{}", name, threads).c_str(), function, choice, threads)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
}

}  // namespace

void add_coupling_benchmarks() {
    using coupling::Kernel;
    for (const auto& [name, kernel] : {std::pair{"phi2", Kernel::phi2},
                                       {"phi3", Kernel::phi3},
                                       {"phi4", Kernel::phi4},
                                       {"lagrange", Kernel::lagrange}}) {
        add(fmt::format("stencil/{}", name), stencil, kernel);
        add(fmt::format("spread/{}", name), spread, kernel);
        add(fmt::format("interpolate/{}", name), interpolate, kernel);
    }
    add("viscosity_recompute", viscosity, Recompute::always);
    add("viscosity_check", viscosity, Recompute::when_moved);
}

}  // namespace hemoflux::bench
