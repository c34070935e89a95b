// The fluid of a coupled run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/case_suspension.hpp"
#include "apps/coupled_run.hpp"
#include "apps/mesh_case.hpp"
#include "coupling/cell_grid.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

/// All cells share one topology and one set of moduli: they may differ in place, axis and cytosol only.
void check_same_kind(const std::vector<CellInput>& cells) {
    for (std::size_t i = 1; i < cells.size(); ++i) {
        CellInput same = cells[i];
        same.name = cells[0].name;
        same.position = cells[0].position;
        same.axis = cells[0].axis;
        same.cytosol_viscosity = cells[0].cytosol_viscosity;
        if (!(same == cells[0]))
            throw InputError(
                fmt::format("[[cell]] number {}", i),
                "cells of one run share mesh, shape, reference and moduli, and it differs from the first",
                "Let it differ in position, axis and cytosol_viscosity only");
    }
}

fluid::SolverOptions solver_options(const Case& c, double smallest, const coupling::Numerics& n,
                                    const Scales& scales) {
    fluid::SolverOptions o;
    o.nu = n.nu;
    o.largest_nu = n.largest_nu;
    o.with_force = true;
    const double surface_nu = surface_viscosity_in_fluid(c, n);
    o.with_viscosity =
        surface_nu > 0 || std::any_of(c.cells.begin(), c.cells.end(), [&](const CellInput& cell) {
            return cell.cytosol_viscosity != c.fluid.viscosity;
        });
    o.largest_nu += surface_nu / (c.coupling.smoothing * smallest);
    for (const CellInput& cell : c.cells)
        o.smallest_nu = std::min(o.smallest_nu > 0 ? o.smallest_nu : n.nu,
                                 n.nu * cell.cytosol_viscosity / c.fluid.viscosity);
    set_body_force(c, scales, o);
    o.tau_floor = c.numerics.tau_floor;
    o.scheme = coupled_scheme(c);
    o.gradient = gradient_of(c.numerics.gradient);
    return o;
}

/// Smallest width of a cell; on a mesh the smallest cube root of a volume.
double smallest_of(const FluidDomain& domain, const std::optional<meshing::HexGrid>& grid) {
    return domain.box ? domain.box->smallest()
                      : std::cbrt(*std::min_element(grid->volume.begin(), grid->volume.end()));
}

}  // namespace

void CoupledSystem::make_flow(const Case& c, const std::optional<meshing::HexGrid>& grid) {
    const fluid::SolverOptions o = solver_options(c, smallest_, numerics, scales);
    if (!grid) {
        auto solver = std::make_unique<fluid::Solver>(*domain.box, make_patches(c, scales, numerics.rate), o);
        static_cast<void>(
            coupling::CellGrid(*domain.box, solver->grid().periodic()));  // refuses too few cells
        fluid = std::move(solver);
    } else {
        fluid = std::make_unique<fluid::HexSolver>(*grid, make_hex_patches(c, scales, numerics.rate, 1), o);
    }
    fluid->initialise(initial_flow(c, numerics.rate, scales));
}

CoupledSystem::CoupledSystem(const Case& c) : domain(c), clock(clock_rate(c)), plan(1, 1) {
    std::optional<meshing::HexGrid> grid;
    if (domain.mesh) grid = make_hex_grid(c, *domain.mesh);
    smallest_ = smallest_of(domain, grid);
    numerics =
        numerics_of(c, smallest_, std::max(std::abs(domain.bounds.lower.y), std::abs(domain.bounds.upper.y)));
    scales = {numerics.velocity_um_per_s, c.fluid.viscosity * clock / (numerics.nu * numerics.rate),
              c.fluid.viscosity / numerics.nu, c.fluid.density};
    check_same_kind(c.cells);
    const double mach = std::sqrt(3.0) * fastest_side(c) / scales.velocity_um_per_s;
    if (!(mach < 0.3))
        throw InputError(fmt::format("a side moves at Mach {:.3g}", mach),
                         "the equilibrium is an expansion for small Mach numbers, useful up to 0.3",
                         "Lower its velocity, numerics.reynolds or numerics.lattice_viscosity");
    const auto window = c.output.window_strain;
    if (window && !((*window)[0] < strain_of(c)))
        throw InputError(
            fmt::format("output.window_strain = [{}, {}]", (*window)[0], (*window)[1]),
            fmt::format("the run ends at strain {:.4g}, so no observable would be taken", strain_of(c)),
            "Let the window begin earlier, or run longer");
    make_flow(c, grid);
    if (grid && numerics.step_limit != "given") limit_step();
    plan = StepPlan(strain_of(c), numerics.step_strain);
    numerics.step_strain = plan.step;
    numerics.step = plan.step / numerics.rate;
    numerics.step_seconds = plan.step / clock;
}

void CoupledSystem::limit_step() {
    constexpr double share = 0.9;
    const double stable = share * numerics.rate * mesh_solver()->largest_step(numerics.mach / std::sqrt(3.0));
    if (stable >= numerics.step_strain) return;
    numerics.step_strain = stable;
    numerics.step_limit = "smallest hexahedra";
}

}  // namespace hemoflux::apps
