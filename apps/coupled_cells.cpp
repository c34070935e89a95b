// The cells of a coupled run: placed, or read from a checkpoint, and joined to the fluid.
#include <fmt/format.h>

#include <algorithm>

#include "apps/case_suspension.hpp"
#include "apps/cell_builder.hpp"
#include "apps/cell_surface.hpp"
#include "apps/coupled_run.hpp"
#include "coupling/overlap.hpp"
#include "coupling/packing.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

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

/// The relaxed cells must lie inside the grid and must not overlap.
void check_places(const membrane::Batch& cells, coupling::Loop& loop) {
    for (std::size_t i = 0; i < cells.cells(); ++i)
        for (const Vec3d& r : cells.positions(i))
            if (!loop.grid().contains(r))
                throw InputError(fmt::format("[[cell]] number {}", i),
                                 "relaxed, it reaches through a side of the grid that is not periodic",
                                 "Move it inside or enlarge the grid");
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

/// Force along x on every node of the batch, 1e-11 N, of [tweezers]: those of a checkpoint, or by the shape as it is.
std::vector<double> pull_of(const Case& c, const membrane::Batch& cells,
                            const output::Checkpoint* checkpoint) {
    if (!c.tweezers) return {};
    std::vector<double> pull(cells.cells() * cells.stride(), 0.0);
    if (checkpoint) return checkpoint->array("loop.pull", pull.size());
    const auto at = cells.positions(0);
    const auto load = membrane::pulling_loads(membrane::pulled_vertices(at, c.tweezers->grip), at.size(),
                                              c.tweezers->force);
    for (std::size_t v = 0; v < load.size(); ++v) pull[v] = load[v].x;
    return pull;
}

}  // namespace

std::unique_ptr<coupling::Loop> CoupledSystem::make_loop(const Case& c, std::vector<double> pull) {
    const coupling::Numerics& n = numerics;
    coupling::LoopOptions o;
    o.pull = std::move(pull);
    o.surface_nu = surface_viscosity_in_fluid(c, n);
    if (c.coupling.membrane_viscosity == MembraneViscosityForm::springs &&
        c.cells.front().membrane_viscosity > 0) {
        o.membrane_time = n.step_seconds / n.step * 1e5;  // the membrane counts time in 1e-5 s
        // as stiff as the step allows, so that the elements yield in much less than a strain unit
        constexpr double length = 1e-6, tension_unit = 1e-5;  // m, N/m
        o.maxwell_stiffness = length * c.fluid.viscosity / n.step_seconds / tension_unit;
    }
    o.kernel = kernel_of(c.coupling.kernel);
    o.force_factor = n.force_factor;
    o.constraint_damping = n.constraint_damping;
    o.damped_step = n.step;
    o.recentre = c.coupling.recentre;
    o.smoothing.local_cells = c.coupling.smoothing;
    if (c.contact) o.contact = contact_options(c, *cells, smallest());
    const auto& options = box_solver() ? box_solver()->options() : mesh_solver()->options();
    if (options.with_viscosity)
        for (const CellInput& cell : c.cells)
            o.nu_inside.push_back(n.nu * cell.cytosol_viscosity / c.fluid.viscosity);
    return box_solver() ? std::make_unique<coupling::Loop>(*box_solver(), *cells, o)
                        : std::make_unique<coupling::Loop>(*mesh_solver(), *cells, o);
}

void CoupledSystem::add_cells(const Case& c, const output::Checkpoint* checkpoint) {
    if (checkpoint) {
        cells = stored_cells(c, *checkpoint);
        load_positions(*cells, *checkpoint);
    } else {
        cells = make_cells(c);
    }
    loop = make_loop(c, pull_of(c, *cells, checkpoint));
    if (!checkpoint) check_places(*cells, *loop);
    if (!c.bodies.empty())
        bodies = std::make_unique<RigidBodies>(
            c, scales, *loop, box_solver() ? box_solver()->options() : mesh_solver()->options());
}

void CoupledSystem::save(output::Checkpoint& checkpoint) const {
    save_flow(*fluid, checkpoint);
    checkpoint.put_number("fluid.time", fluid->time());
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
    checkpoint.put("loop.pull", memory.pull);
    checkpoint.put("loop.viscous_tension", memory.viscous.tension);
    checkpoint.put("loop.viscous_length", memory.viscous.length);
    checkpoint.put("loop.shift", {memory.shift.begin(), memory.shift.end()});
}

void CoupledSystem::load(const output::Checkpoint& checkpoint) {
    load_flow(*fluid, checkpoint);
    fluid->set_time(checkpoint.number("fluid.time"));
    load_positions(*cells, checkpoint);
    if (bodies) bodies->load(checkpoint);
    coupling::CellMemory memory;
    const auto nodes_or_none = [&](const char* name) {
        return checkpoint.array(name).empty() ? std::vector<double>()
                                              : checkpoint.array(name, cells->x().size());
    };
    memory.viscosity_nodes = {nodes_or_none("loop.viscosity_x"), nodes_or_none("loop.viscosity_y"),
                              nodes_or_none("loop.viscosity_z")};
    const auto& target = checkpoint.array("loop.target", 3);
    std::copy(target.begin(), target.end(), memory.target.begin());
    memory.viscous = {checkpoint.array("loop.viscous_tension"), checkpoint.array("loop.viscous_length")};
    const auto& shift = checkpoint.array("loop.shift", 3);
    std::copy(shift.begin(), shift.end(), memory.shift.begin());
    loop->restore(memory);
}

}  // namespace hemoflux::apps
