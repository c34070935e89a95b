// One red blood cell in shear flow, fluid and membrane coupled by hand: neither solver knows of the other, and the loop at
// the end is all that joins them. Says how the cell stands after three strain units and returns 0 if that is as it
// should be.
#include <cmath>
#include <cstdio>
#include <vector>

#include "coupling/interpolate.hpp"
#include "coupling/motion.hpp"
#include "coupling/scaling.hpp"
#include "coupling/spread.hpp"
#include "fluid/solver.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/shapes.hpp"

using namespace hemoflux;

int main() {
    // The membrane: a relaxed discocyte of 642 nodes, K_S = 6.1 uN/m, turned so that the axis of its disc is y.
    const membrane::Cell shape =
        membrane::make_discocyte(3, {.reference = membrane::ReferenceKind::uniform_length,
                                     .parameters = membrane::pre_stressed_parameters()});
    membrane::Batch cell(shape.topology, shape.parameters, shape.reference);
    std::vector<Vec3d> nodes = shape.positions;
    for (Vec3d& r : nodes) r = {r.x, r.z, -r.y};
    cell.set_positions(0, nodes);

    // The numbers: a physical case (22 mPa s, 3 /s) in lattice units that keep its capillary number.
    const meshing::Axis axis = meshing::plateau_axis(-6, 6, 24, 8, 0.25);
    const meshing::RectilinearGrid box{{axis, axis, axis}};
    const coupling::Numerics n = coupling::choose_numerics({.viscosity = 22e-3,
                                                            .shear_rate = 3,
                                                            .shear_modulus = 6.1e-6,
                                                            .radius = membrane::red_blood_cell::radius(),
                                                            .wall_distance = 6,
                                                            .smallest_cell = box.smallest()},
                                                           {});

    // The fluid: u = G y on all six sides and at the start, a force field for the membrane to write into.
    const auto shear = [&](const Vec3d& x) { return Vec3d{n.rate * x.y, 0, 0}; };
    fluid::Patches sides;
    sides.fill(fluid::velocity_patch(shear));
    fluid::SolverOptions options{.nu = n.nu, .with_force = true, .scheme = fluid::Scheme::factored};
    fluid::Solver flow(box, sides, options);
    flow.initialise([&](const Vec3d& x) { return fluid::FlowPoint{1, shear(x)}; });

    // What joins them: the fluid's fields, a stencil for every node, a velocity for every node.
    exchange::FieldTable fields;
    flow.offer(fields);
    const auto velocity = fields.read("fluid.velocity", exchange::Shape::vector, "c");
    const auto force = fields.read("fluid.force_density", exchange::Shape::vector, "rho_0 c^2 / um");
    const coupling::CellGrid grid(box, flow.grid().periodic());
    coupling::StencilSet stencils(grid, coupling::Kernel::lagrange, cell.stride());
    coupling::Spreader spreader(stencils);
    exchange::Buffer<double> u(cell.stride()), v(cell.stride()), w(cell.stride());
    double *x = cell.x().data(), *y = cell.y().data(), *z = cell.z().data();

    const auto start = membrane::shape_moments(cell.topology().triangles(), cell.positions(0));
    for (double strain = 0; strain < 3; strain += n.step_strain) {
        cell.compute_forces();     // membrane: -grad E
        stencils.update(x, y, z);  // where the nodes are
        spreader.spread(cell.fx().data(), cell.fy().data(), cell.fz().data(), n.force_factor, force);
        flow.step(n.step);                                                             // fluid: one step
        coupling::interpolate(stencils, velocity, u.data(), v.data(), w.data());       // its new velocity,
        coupling::move(cell.stride(), n.step, u.data(), v.data(), w.data(), x, y, z);  // with which nodes go
    }

    // Shear turns the disc clockwise and stretches it along 45 degrees; a cell that treads rests in between.
    const auto end = membrane::shape_moments(cell.topology().triangles(), cell.positions(0));
    const double volume_error = end.volume / start.volume - 1, angle = membrane::inclination(end);
    std::printf("inclination %.2f degrees, volume changed by %.1e, centre moved by %.1e um\n", angle,
                volume_error, norm(end.centroid - start.centroid));
    return std::abs(volume_error) < 1e-3 && angle > 10 && angle < 30 && norm(end.centroid) < 0.1 ? 0 : 1;
}
