// The conditions on the sides of a flow: from the case to the patches of the fluid solver.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/expression.hpp"
#include "apps/flow_setup.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

constexpr double metre_per_um = 1e-6;

Vec3d in_metres(const Vec3d& x) { return metre_per_um * x; }

/// Inflow of a duct (5.22): the product of parabolas along the axes of the side whose own sides are not periodic.
std::function<Vec3d(const Vec3d&)> parabola(const Case& c, const meshing::RectilinearGrid& grid,
                                            std::size_t axis, double speed_inward, std::size_t side) {
    std::array<double, 3> lower{}, length{};
    for (std::size_t a = 0; a < 3; ++a) {
        lower[a] = grid.axes[a].lower();
        length[a] = a == axis || c.periodic(a) ? 0 : grid.axes[a].length();
    }
    const double speed = side == 0 ? speed_inward : -speed_inward;
    return [=](const Vec3d& x) {
        const double at[3] = {x.x, x.y, x.z};
        double u = speed;
        for (std::size_t a = 0; a < 3; ++a) {
            if (!(length[a] > 0)) continue;
            const double s = (at[a] - lower[a]) / length[a];
            u *= 4 * s * (1 - s);
        }
        return Vec3d{axis == 0 ? u : 0, axis == 1 ? u : 0, axis == 2 ? u : 0};
    };
}

/// parabola: the inflow profile of the side, where it has one. where: the patch in messages.
void set_velocity(fluid::Patch& p, const PatchInput& in, const Scales& scales, double rate,
                  const std::string& where, const std::function<Vec3d(const Vec3d&)>& parabola = {}) {
    const double lattice = 1 / scales.velocity_um_per_s;
    switch (in.velocity) {
        case VelocityCondition::periodic:
        case VelocityCondition::no_slip:
            break;
        case VelocityCondition::symmetry:
            p.velocity = fluid::VelocityCondition::symmetry;
            break;
        case VelocityCondition::zero_gradient:
            p.velocity = fluid::VelocityCondition::zero_gradient;
            break;
        case VelocityCondition::shear:
            p.velocity_profile = [rate](const Vec3d& x) { return Vec3d{rate * x.y, 0, 0}; };
            break;
        case VelocityCondition::parabolic:
            p.velocity_profile = parabola;
            break;
        case VelocityCondition::vector: {
            const Vec3d u = lattice * Vec3d{in.vector[0], in.vector[1], in.vector[2]};
            p.velocity_profile = [u](const Vec3d&) { return u; };
            break;
        }
        case VelocityCondition::expression: {
            std::array<std::function<double(const Vec3d&, double)>, 3> u;
            for (std::size_t a = 0; a < 3; ++a)
                u[a] = expression(in.velocity_expression[a], where + ".velocity_expression");
            p.unsteady_velocity = [u, scale = lattice / metre_per_um, second = scales.time_s()](
                                      const Vec3d& x, double t) {
                const Vec3d at = in_metres(x);
                return scale * Vec3d{u[0](at, t * second), u[1](at, t * second), u[2](at, t * second)};
            };
            break;
        }
    }
}

void set_density(fluid::Patch& p, const PatchInput& in, const Scales& scales, double gamma,
                 const std::string& where) {
    // p = gamma rho / 3 (3.8, corrected), counted from the reference density 1
    const double per_pascal = 3 / (gamma * scales.pressure_pa);
    switch (in.density) {
        case DensityCondition::zero_gradient:
            return;
        case DensityCondition::gradient: {
            p.density = fluid::DensityCondition::given_gradient;
            const double gradient = per_pascal * metre_per_um * in.value;
            p.density_profile = [gradient](const Vec3d&) { return gradient; };
            return;
        }
        case DensityCondition::expression: {
            p.density = fluid::DensityCondition::given;
            const auto pressure = expression(in.pressure_expression, where + ".pressure_expression");
            p.unsteady_density = [=, second = scales.time_s()](const Vec3d& x, double t) {
                return 1 + per_pascal * pressure(in_metres(x), t * second);
            };
            return;
        }
        case DensityCondition::density:
        case DensityCondition::pressure: {
            p.density = fluid::DensityCondition::given;
            const double rho =
                in.density == DensityCondition::pressure ? 1 + per_pascal * in.value : in.value;
            p.density_profile = [rho](const Vec3d&) { return rho; };
            return;
        }
    }
}

/// Largest speed that a side's expression takes at points of the side and times of the run, um/s.
double fastest_expression(const Case& c, const PatchInput& in, const meshing::RectilinearGrid& grid,
                          std::size_t axis, std::size_t side) {
    fluid::Patch p;
    set_velocity(p, in, fluid_scales(c, 1), 0, fmt::format("boundary.{}{}", "xyz"[axis], "-+"[side]));
    const double end = c.time.duration.value_or(c.shear_rate ? c.time.strain.value_or(0) / *c.shear_rate : 0);
    constexpr int samples = 16;
    const auto place = [&](std::size_t along, int n) {
        return grid.axes[along].lower() + grid.axes[along].length() * n / samples;
    };
    double speed = 0;
    for (int i = 0; i <= samples; ++i)
        for (int j = 0; j <= samples; ++j)
            for (int k = 0; k <= samples; ++k) {
                double x[3];
                x[axis] = side == 0 ? grid.axes[axis].lower() : grid.axes[axis].upper();
                x[(axis + 1) % 3] = place((axis + 1) % 3, i);
                x[(axis + 2) % 3] = place((axis + 2) % 3, j);
                const double here = norm(p.velocity_at({x[0], x[1], x[2]}, end * k / samples));
                if (!std::isfinite(here))
                    throw InputError(
                        fmt::format("boundary.{}{}.velocity_expression", "xyz"[axis], "-+"[side]),
                        fmt::format("it is not a finite number at ({:.4g}, {:.4g}, {:.4g}) um, {:.4g} s",
                                    x[0], x[1], x[2], end * k / samples),
                        "Write a formula that has a value everywhere on the side");
                speed = std::max(speed, here);
            }
    return speed;
}

}  // namespace

fluid::Patches make_patches(const Case& c, const Scales& scales, double rate, double gamma) {
    const meshing::RectilinearGrid grid = make_grid(c.grid);
    fluid::Patches patches;
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t side = 0; side < 2; ++side) {
            fluid::Patch& p = patches[2 * a + side];
            if (c.periodic(a)) {
                p = fluid::periodic_patch();
                continue;
            }
            const PatchInput& in = c.boundary[a][side];
            const std::string where = fmt::format("boundary.{}{}", "xyz"[a], "-+"[side]);
            set_velocity(p, in, scales, rate, where,
                         parabola(c, grid, a, in.speed / scales.velocity_um_per_s, side));
            set_density(p, in, scales, gamma, where);
        }
    return patches;
}

fluid::HexPatches make_hex_patches(const Case& c, const Scales& scales, double rate, double gamma) {
    fluid::HexPatches patches;
    for (const auto& [name, in] : c.patches) {
        if (in.periodic()) continue;
        set_velocity(patches[name], in, scales, rate, "boundary." + name);
        set_density(patches[name], in, scales, gamma, "boundary." + name);
    }
    return patches;
}

double fastest_side(const Case& c) {
    double speed = 0;
    const auto include = [&](const PatchInput& in) {
        if (in.velocity == VelocityCondition::vector)
            speed = std::max(speed, std::hypot(in.vector[0], in.vector[1], in.vector[2]));
        if (in.velocity == VelocityCondition::parabolic) speed = std::max(speed, std::abs(in.speed));
    };
    for (const auto& [name, in] : c.patches) {
        include(in);
        if (in.velocity == VelocityCondition::expression && !c.numerics.speed)
            throw InputError(fmt::format("boundary.{} has velocity = \"expression\"", name),
                             "on a mesh nothing says how fast it will be", "Give numerics.speed");
    }
    if (c.mesh || c.kind == CaseKind::membrane) return speed;
    const meshing::RectilinearGrid grid = make_grid(c.grid);
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t side = 0; side < 2; ++side) {
            const PatchInput& in = c.boundary[a][side];
            include(in);
            if (in.velocity == VelocityCondition::expression)
                speed = std::max(speed, fastest_expression(c, in, grid, a, side));
        }
    return speed;
}

}  // namespace hemoflux::apps
