#include "apps/rigid_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/cell_surface.hpp"
#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"
#include "meshing/surface_io.hpp"

namespace hemoflux::apps {
namespace {

/// Extent of a body from its centre, um, at most.
double reach(const RigidInput& b) {
    if (!b.file.empty()) return 0;
    if (b.shape == RigidShape::spheroid) return b.diameter / 2 * std::max(1.0, b.aspect);
    return b.diameter / 2;
}

meshing::SurfaceMesh ball(const RigidInput& b, double h) {
    const double polar = b.shape == RigidShape::spheroid ? b.aspect : 1, radius = b.diameter / 2;
    const meshing::SpheroidAxes axes{radius, radius * polar};
    int level = 1;
    if (b.nodes)
        level = meshing::icosphere_level(static_cast<int>(*b.nodes));
    else
        while (level < meshing::icosphere_max_level &&
               (10 * std::pow(4, level) + 2) * h * h < fewest_nodes * meshing::area(axes))
            ++level;
    return meshing::spheroid(meshing::icosphere(level, 1), axes);
}

coupling::BodySurface cylinder(const RigidInput& b, double h) {
    const double around = std::numbers::pi * b.diameter;
    const double nodes = b.nodes.value_or(std::ceil(around * b.length * 1.5 / (h * h)));
    const int n = std::max(8, static_cast<int>(std::lround(std::sqrt(nodes * around / b.length))));
    const int along = std::max(1, static_cast<int>(std::lround(nodes / n)));
    return coupling::cylinder_mantle(b.diameter, b.length, {b.axis[0], b.axis[1], b.axis[2]}, n, along);
}

}  // namespace

double cells_around(const RigidInput& b, const coupling::FluidGrid& grid) {
    double volume = 1e300;
    const double r = reach(b);
    for (const double sx : {-1.0, 0.0, 1.0})
        for (const double sy : {-1.0, 0.0, 1.0})
            for (const double sz : {-1.0, 0.0, 1.0})
                volume = std::min(volume, grid.cell_volume({b.position[0] + sx * r, b.position[1] + sy * r,
                                                            b.position[2] + sz * r}));
    return std::cbrt(volume);
}

coupling::BodySurface make_surface(const RigidInput& b, double h) {
    if (b.file.empty() && b.shape == RigidShape::cylinder) return cylinder(b, h);
    meshing::SurfaceMesh mesh = b.file.empty() ? ball(b, h) : meshing::read_surface(b.file);
    place(mesh, b.axis, {0, 0, 0});
    return coupling::closed_surface(std::move(mesh));
}

double retraction(const RigidInput& b, Kernel kernel, bool hexahedra) {
    if (b.retraction) return *b.retraction;
    switch (kernel) {
        case Kernel::phi2:
            return 0.34;
        case Kernel::phi3:
            return 0.38;
        case Kernel::phi4:
            return 0.51;
        case Kernel::lagrange:
            break;
    }
    return hexahedra ? 0.19 : 0.12;
}

void check_inside(const Case& c, std::size_t index, const coupling::BodySurface& surface,
                  const coupling::FluidGrid& grid) {
    const Triple& centre = c.bodies[index].position;
    for (const Vec3d& x : surface.mesh.vertices) {
        const Vec3d at = Vec3d{centre[0], centre[1], centre[2]} + x;
        if (grid.contains(at)) continue;
        throw InputError(
            fmt::format("body.{} reaches through the border of the grid", index),
            fmt::format("a node at ({:.4g}, {:.4g}, {:.4g}) um is outside of it", at.x, at.y, at.z),
            "Move the body, enlarge the grid, or make this direction periodic");
    }
}

double reference_area(const RigidInput& b, const coupling::BodySurface& surface) {
    if (b.reference_area) return *b.reference_area;
    if (!b.file.empty())
        return std::numbers::pi * std::pow(0.75 * surface.volume / std::numbers::pi, 2.0 / 3);
    if (b.shape == RigidShape::cylinder) return b.diameter * b.length;
    return std::numbers::pi / 4 * b.diameter * b.diameter;
}

double fluid_speed(const RigidInput& b, const coupling::BodyState& state, fluid::Flow& fluid) {
    return std::max(fluid.largest_speed(), norm(state.velocity) + reach(b) * norm(state.angular_velocity));
}

double pressure_difference(const coupling::RigidBody& body, const Vec3d& direction,
                           const coupling::FluidGrid& grid, const fluid::SolverOptions& fluid,
                           const fluid::Probe& probe) {
    const coupling::BodyState& state = body.state();
    const coupling::Matrix3 turn = coupling::rotation(state.orientation);
    double end = 0;
    for (const Vec3d& x : body.surface().mesh.vertices) end = std::max(end, dot(turn * x, direction));
    const Vec3d force{fluid.uniform_force[0], fluid.uniform_force[1], fluid.uniform_force[2]};
    double pressure[2];
    for (const int side : {0, 1}) {
        const Vec3d outward = side == 0 ? -direction : direction, surface = state.centre + end * outward;
        const Vec3d wall = state.velocity + cross(state.angular_velocity, end * outward);
        const double h = grid.width(surface, outward);
        double p[3], bend[3];
        for (int k = 0; k < 3; ++k) {
            const double n = k + 2;
            const Vec3d at = surface + (n * h) * outward;
            if (!grid.contains(at)) return NAN;
            const std::array<double, 4> q = probe(at);
            p[k] = fluid.gamma * (q[0] - 1) / 3;
            bend[k] = dot(Vec3d{q[1], q[2], q[3]} - wall, outward) / (n * n);
        }
        const double a = 6 * bend[0] - 8 * bend[1] + 3 * bend[2];  // parabola through 2, 3, 4 taken at 0
        const double slope = 2 * a * fluid.nu / h + h * dot(force - state.acceleration, outward);
        for (int k = 0; k < 3; ++k) p[k] -= (k + 2) * slope;
        pressure[side] = (36 * p[0] - 32 * p[1] + 9 * p[2]) / 13;  // b + c n^2 + d n^3 taken at 0
    }
    return pressure[0] - pressure[1];
}

}  // namespace hemoflux::apps
