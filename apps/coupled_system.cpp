// Setting up a coupled run, and its checkpoints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/case_suspension.hpp"
#include "apps/cell_builder.hpp"
#include "apps/cell_surface.hpp"
#include "apps/coupled_run.hpp"
#include "coupling/overlap.hpp"
#include "coupling/packing.hpp"
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

void check_supported(const Case& c) {
    if (!c.shear_rate)
        throw InputError("[shear] rate",
                         "a coupled run takes its clock, the strain, from the shear rate and none is given",
                         "Give a rate");
    if (c.numerics.single_precision)
        throw InputError("numerics.precision \"single\"", "cells exert a body force, which needs double",
                         "Leave numerics.precision out");
    if (c.numerics.gamma != 1.0)
        throw InputError(fmt::format("numerics.gamma {}", c.numerics.gamma.value_or(0)),
                         "preconditioning changes the path in time, and a coupled run is unsteady",
                         "Set it to 1");
    for (const CellInput& cell : c.cells)
        if (cell.membrane_viscosity != 0)
            throw InputError(
                "cell.membrane_viscosity",
                "the explicit membrane viscosity (6.40) is unstable in a viscous fluid at any step",
                "Leave it out or set it to 0 in coupled runs");
}

/// Where the cells are: as listed, or packed at random.
std::vector<coupling::Placement> places_of(const Case& c, const membrane::Cell& cell) {
    std::vector<coupling::Placement> places;
    if (!c.packing) {
        for (const CellInput& one : c.cells)
            places.push_back({{one.position[0], one.position[1], one.position[2]},
                              {one.axis[0], one.axis[1], one.axis[2]}});
        return places;
    }
    const meshing::RectilinearGrid grid = make_grid(c.grid);
    coupling::PackingInput in;
    for (std::size_t q = 0; q < 3; ++q) {
        in.box.lower[q] = grid.axes[q].lower();
        in.box.length[q] = grid.axes[q].length();
        in.box.periodic[q] = c.periodic(q);
    }
    in.shape = cell.positions;
    in.triangles = cell.topology->triangles();
    in.cells = c.cells.size();
    in.seed = static_cast<std::uint64_t>(c.packing->seed);
    in.gap = c.packing->gap;
    return coupling::pack(in);
}

std::unique_ptr<membrane::Batch> make_cells(const Case& c) {
    const membrane::Cell cell = build_cell(c.cells.front());
    auto batch =
        std::make_unique<membrane::Batch>(cell.topology, cell.parameters, cell.reference, c.cells.size());
    const auto places = places_of(c, cell);
    for (std::size_t i = 0; i < c.cells.size(); ++i) {
        const coupling::AxisTurn turn{places[i].axis};
        std::vector<Vec3d> placed;
        for (const Vec3d& r : cell.positions) placed.push_back(turn(r) + places[i].position);
        batch->set_positions(i, placed);
    }
    return batch;
}

/// The cells of a checkpoint with its references, not placed yet.
std::unique_ptr<membrane::Batch> stored_cells(const Case& c, const output::Checkpoint& checkpoint) {
    const CellInput& cell = c.cells.front();
    const auto topology = std::make_shared<const membrane::Topology>(start_shape(cell));
    const std::vector<double>& rest = checkpoint.array("membrane.rest", 5);
    const membrane::Reference reference{
        .area = rest[0],
        .volume = rest[1],
        .curvature = rest[2],
        .total_curvature = rest[3],
        .stretch_ratio = rest[4],
        .triangle_areas = checkpoint.array("membrane.rest_area", topology->triangles().size()),
        .edge_lengths = checkpoint.array("membrane.rest_length", topology->edges().size())};
    return std::make_unique<membrane::Batch>(topology, membrane_parameters(cell), reference, c.cells.size());
}

void load_positions(membrane::Batch& cells, const output::Checkpoint& checkpoint) {
    const std::size_t nodes = cells.x().size();
    cells.x().assign(checkpoint.array("membrane.x", nodes));
    cells.y().assign(checkpoint.array("membrane.y", nodes));
    cells.z().assign(checkpoint.array("membrane.z", nodes));
}

/// The relaxed cells must lie inside the box and must not overlap.
void check_places(const Case& c, const meshing::RectilinearGrid& grid, const membrane::Batch& cells,
                  coupling::Loop& loop) {
    for (std::size_t i = 0; i < cells.cells(); ++i)
        for (const Vec3d& r : cells.positions(i)) {
            const double x[3] = {r.x, r.y, r.z};
            for (std::size_t a = 0; a < 3; ++a)
                if (!c.periodic(a) && (x[a] < grid.axes[a].lower() || x[a] > grid.axes[a].upper()))
                    throw InputError(fmt::format("[[cell]] number {}", i),
                                     "relaxed, it reaches through a side of the box that is not periodic",
                                     "Move it inside or enlarge the box");
        }
    const coupling::Gap gap = loop.cells()->smallest_gap();
    if (gap.distance < 0)
        throw InputError(fmt::format("[[cell]] numbers {} and {}", std::min(gap.cell, gap.other),
                                     std::max(gap.cell, gap.other)),
                         "their membranes cross", "Move them apart");
}

coupling::ContactOptions contact_options(const Case& c, const membrane::Batch& cells, double smallest_cell) {
    constexpr double pressure_unit = 10, energy_per_area_unit = 1e-5;  // Pa, J/m^2
    coupling::ContactOptions o;
    o.pressure = c.contact->pressure / pressure_unit;
    o.range = c.contact->range.value_or(
        std::max(membrane::mean_edge(cells.topology(), cells.positions(0)), smallest_cell));
    o.adhesion = c.contact->adhesion / energy_per_area_unit;
    o.adhesion_distance = c.contact->adhesion_distance.value_or(o.range);
    o.adhesion_scale = c.contact->adhesion_scale;
    o.walls = c.contact->walls;
    return o;
}

std::unique_ptr<fluid::Solver> make_fluid(const Case& c, const meshing::RectilinearGrid& grid,
                                          const coupling::Numerics& n, const Scales& scales) {
    fluid::SolverOptions o;
    o.nu = n.nu;
    o.largest_nu = n.largest_nu;
    o.with_force = true;
    o.with_viscosity = std::any_of(c.cells.begin(), c.cells.end(), [&](const CellInput& cell) {
        return cell.cytosol_viscosity != c.fluid.viscosity;
    });
    for (const CellInput& cell : c.cells)
        o.smallest_nu = std::min(o.smallest_nu > 0 ? o.smallest_nu : n.nu,
                                 n.nu * cell.cytosol_viscosity / c.fluid.viscosity);
    set_body_force(c, scales, o);
    o.tau_floor = c.numerics.tau_floor;
    o.scheme = scheme_of(c.time.scheme);
    auto solver = std::make_unique<fluid::Solver>(grid, make_patches(c, scales, n.rate), o);
    solver->initialise(initial_flow(c, n.rate, scales));
    return solver;
}

std::unique_ptr<coupling::Loop> make_loop(const Case& c, const coupling::Numerics& n, fluid::Solver& fluid,
                                          membrane::Batch& cells) {
    coupling::LoopOptions o;
    o.kernel = kernel_of(c.coupling.kernel);
    o.force_factor = n.force_factor;
    o.recentre = c.coupling.recentre;
    o.smoothing.local_cells = c.coupling.smoothing;
    if (c.contact) o.contact = contact_options(c, cells, fluid.grid().rectilinear().smallest());
    if (fluid.options().with_viscosity)
        for (const CellInput& cell : c.cells)
            o.nu_inside.push_back(n.nu * cell.cytosol_viscosity / c.fluid.viscosity);
    return std::make_unique<coupling::Loop>(fluid, cells, o);
}

constexpr const char* fluid_names[4] = {"fluid.density", "fluid.u", "fluid.v", "fluid.w"};

}  // namespace

double strain_of(const Case& c) {
    return c.time.strain ? *c.time.strain : *c.time.duration * c.shear_rate.value_or(0);
}

coupling::Numerics numerics_of(const Case& c, const meshing::RectilinearGrid& grid) {
    check_supported(c);
    const CellInput& cell = c.cells.front();
    coupling::PhysicalCase p;
    p.density = c.fluid.density;
    p.viscosity = c.fluid.viscosity;
    for (const CellInput& each : c.cells)
        p.largest_cytosol = std::max(p.largest_cytosol, each.cytosol_viscosity);
    p.shear_rate = *c.shear_rate;
    p.shear_modulus = cell.shear_modulus;
    p.radius = rest_state(cell).radius();
    p.wall_distance = flow_reach(c, grid);
    p.smallest_cell = grid.smallest();
    coupling::NumericsChoice choice;
    choice.lattice_viscosity = c.numerics.lattice_viscosity.value_or(0.5);
    choice.reynolds = c.numerics.reynolds.value_or(2);
    choice.mach = c.numerics.mach.value_or(0);
    choice.step_strain = c.time.step ? *c.time.step * *c.shear_rate : c.numerics.step_strain.value_or(0);
    choice.kernel = kernel_of(c.coupling.kernel);
    choice.scheme = scheme_of(c.time.scheme);
    return coupling::choose_numerics(p, choice);
}

CoupledSystem::CoupledSystem(const Case& c)
    : numerics(numerics_of(c, make_grid(c.grid))), plan(strain_of(c), numerics.step_strain) {
    const meshing::RectilinearGrid grid = make_grid(c.grid);
    numerics.step_strain = plan.step;
    numerics.step = plan.step / numerics.rate;
    numerics.step_seconds = plan.step / *c.shear_rate;
    scales = {numerics.velocity_um_per_s, c.fluid.viscosity * *c.shear_rate / (numerics.nu * numerics.rate),
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
    fluid = make_fluid(c, grid, numerics, scales);
    static_cast<void>(coupling::CellGrid(grid, fluid->grid().periodic()));  // refuses too few cells
}

void CoupledSystem::add_cells(const Case& c, const output::Checkpoint* checkpoint) {
    if (checkpoint) {
        cells = stored_cells(c, *checkpoint);
        load_positions(*cells, *checkpoint);
    } else {
        cells = make_cells(c);
    }
    loop = make_loop(c, numerics, *fluid, *cells);
    if (!checkpoint) check_places(c, fluid->grid().rectilinear(), *cells, *loop);
    if (!c.bodies.empty())
        bodies = std::make_unique<RigidBodies>(c, scales, fluid->grid().rectilinear(), *loop);
}

void CoupledSystem::save(output::Checkpoint& checkpoint) const {
    for (int q = 0; q < 4; ++q)
        checkpoint.put(fluid_names[q], fluid->state().interior(fluid->state().view().q[q]));
    checkpoint.put("membrane.x", cells->x().to_host());
    checkpoint.put("membrane.y", cells->y().to_host());
    checkpoint.put("membrane.z", cells->z().to_host());
    const membrane::Reference& r = cells->reference();
    checkpoint.put("membrane.rest_length", r.edge_lengths);
    checkpoint.put("membrane.rest_area", r.triangle_areas);
    checkpoint.put("membrane.rest", {r.area, r.volume, r.curvature, r.total_curvature, r.stretch_ratio});
    const coupling::CellMemory memory = loop->memory();
    checkpoint.put("loop.viscosity_x", memory.viscosity_nodes[0]);
    checkpoint.put("loop.viscosity_y", memory.viscosity_nodes[1]);
    checkpoint.put("loop.viscosity_z", memory.viscosity_nodes[2]);
    if (bodies) bodies->save(checkpoint);
    checkpoint.put("loop.target", {memory.target.begin(), memory.target.end()});
    checkpoint.put("loop.shift", {memory.shift.begin(), memory.shift.end()});
}

void CoupledSystem::load(const output::Checkpoint& checkpoint) {
    const std::size_t grid_cells = fluid->grid().view().layout.cells();
    for (int q = 0; q < 4; ++q)
        fluid->state().set_interior(fluid->state().view().q[q], checkpoint.array(fluid_names[q], grid_cells));
    load_positions(*cells, checkpoint);
    if (bodies) bodies->load(checkpoint);
    coupling::CellMemory memory;
    memory.viscosity_nodes = {checkpoint.array("loop.viscosity_x"), checkpoint.array("loop.viscosity_y"),
                              checkpoint.array("loop.viscosity_z")};
    const auto& target = checkpoint.array("loop.target", 3);
    std::copy(target.begin(), target.end(), memory.target.begin());
    const auto& shift = checkpoint.array("loop.shift", 3);
    std::copy(shift.begin(), shift.end(), memory.shift.begin());
    loop->restore(memory);
}

std::string describe(const Case& c, const CoupledSystem& s) {
    const coupling::Numerics& n = s.numerics;
    const auto& axes = s.fluid->grid().rectilinear().axes;
    std::string text = fmt::format(
        "{}\n"
        "  grid          {} x {} x {} cells, smallest {:.4g} um\n"
        "  cells         {} of {} nodes, viscosity ratio {:.3g}\n"
        "  physical      G = {:.4g} 1/s, Ca = G mu R0/K_S = {:.4g}, Re_G = {:.3g}\n"
        "  chosen        nu/h = {:.3g}, Re_G = {:.3g}, Ma = {:.3g}, kernel and scheme as in the case\n"
        "  step          G dt = {:.4g} ({} steps of {:.4g} s; limit: {})\n"
        "  conversion    length 1 um; velocity c = {:.4g} um/s; lattice time = {:.4g} s; stress = {:.4g} "
        "Pa;\n"
        "                membrane force 1e-11 N = {:.4g} lattice units\n"
        "  errors        ",
        c.title, axes[0].cells(), axes[1].cells(), axes[2].cells(), s.fluid->grid().rectilinear().smallest(),
        s.cells->cells(), s.cells->vertices(), c.cells.front().cytosol_viscosity / c.fluid.viscosity,
        *c.shear_rate, n.capillary, n.physical_reynolds, n.lattice_viscosity, n.reynolds, n.mach,
        n.step_strain, s.plan.steps, n.step_seconds, n.step_limit, n.velocity_um_per_s, s.scales.time_s(),
        s.scales.pressure_pa, n.force_factor);
    for (const auto& [cause, error] : n.errors) text += fmt::format("{} {:.1f} %; ", cause, 100 * error);
    text += "(estimated)";
    if (s.bodies) text += s.bodies->describe();
    text += "\n  exchanged     ";
    for (const auto& field : s.loop->fields().list()) text += fmt::format("{} [{}] ", field.name, field.unit);
    return text;
}

}  // namespace hemoflux::apps
