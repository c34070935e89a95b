#include "apps/fluid_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/mesh_case.hpp"
#include "exchange/error.hpp"
#include "fluid/preconditioning.hpp"

namespace hemoflux::apps {
namespace {

/// Mach number of the fastest wall (or estimated stream) where the case gives none.
constexpr double default_mach = 0.1;
/// Share of the largest stable step that is used where the case gives none.
constexpr double step_share = 0.9;
constexpr const char* field_names[4] = {"fluid.density", "fluid.u", "fluid.v", "fluid.w"};

/// What the boundary conditions say about pressure: lowest and highest given one, Pa.
struct PressureRange {
    double low = 1e300, high = -1e300;
    explicit PressureRange(const Case& c) {
        const auto include = [this](const PatchInput& p) {
            if (p.density == DensityCondition::pressure)
                low = std::min(low, p.value), high = std::max(high, p.value);
        };
        for (const auto& sides : c.boundary)
            for (const PatchInput& p : sides) include(p);
        for (const auto& [name, p] : c.patches) include(p);
    }
};

/// Largest speed that the boundary conditions, the shear, the driving force or the exact solution suggest, um/s. A
/// driven stream is taken as plane Poiseuille flow between the closest sides that are not periodic: u = f w^2/(8 mu);
/// an oscillating one, where that is less, as a freely swinging one, f T/(2 pi rho).
double fastest(const Case& c, const FluidDomain& domain) {
    if (c.numerics.speed) return *c.numerics.speed;
    double speed = fastest_side(c);
    if (c.shear_rate)
        speed = std::max(speed, *c.shear_rate * std::max(std::abs(domain.bounds.lower.y),
                                                         std::abs(domain.bounds.upper.y)));
    if (c.analytical) speed = std::max(speed, largest_exact_speed(c, *domain.box));
    const auto length = [](const Triple& v) { return std::hypot(v[0], v[1], v[2]); };
    speed = std::max(speed, length(c.fluid.initial_velocity));
    constexpr double per_um = 1e-6;                                      // m
    const double oscillating = length(c.body_force.amplitude) * per_um;  // Pa/um
    double drive = c.fluid.density * length(c.body_force.acceleration) * per_um, width = 1e300;
    const PressureRange pressure(c);
    const Vec3d extent = domain.bounds.upper - domain.bounds.lower;
    if (pressure.high > pressure.low) drive += (pressure.high - pressure.low) / extent.x;
    const double along[3] = {extent.x, extent.y, extent.z};
    for (std::size_t a = 0; a < 3; ++a)
        if (c.mesh ? a > 0 : !c.periodic(a)) width = std::min(width, along[a]);
    const double resistance = width * width / (8 * c.fluid.viscosity);
    if (width < 1e300) speed = std::max(speed, drive * resistance);
    if (!c.analytical && oscillating > 0) {
        const double free = length(c.body_force.amplitude) / c.fluid.density * c.body_force.period /
                            (2 * std::numbers::pi) / per_um;
        speed = std::max(speed, width < 1e300 ? std::min(free, oscillating * resistance) : free);
    }
    if (!(speed > 0))
        throw InputError(
            "the flow", "no side moves, no pressure differs and no force acts, so nothing will flow",
            "Give a velocity, a pressure difference, [shear] or [body_force], or numerics.speed");
    return speed;
}

double duration(const Case& c, const FluidDomain& domain) {
    if (c.time.duration) return *c.time.duration;
    if (c.time.strain) return *c.time.strain / *c.shear_rate;
    return c.analytical->times.back() * exact_clock(c, *domain.box);
}

StepPlan make_plan(const Case& c, const FluidSystem& s) {
    if (c.steady) return {1, 1};
    const double end = duration(c, s.domain);
    if (c.time.step) return {end, *c.time.step};
    if (c.numerics.step_strain) return {end, *c.numerics.step_strain / *c.shear_rate};
    const double u = s.mach / std::sqrt(3.0);
    const fluid::SolverOptions& o = s.options();
    const double stable = s.box_solver()
                              ? fluid::stable_step(s.box_solver()->grid(), o.scheme, o.nu, u, o.gamma)
                              : dynamic_cast<const fluid::HexSolver&>(*s.flow).largest_step(u);
    return {end, step_share * s.scales.time_s() * stable};
}

}  // namespace

FluidDomain::FluidDomain(const Case& c) {
    if (!c.mesh) {
        box = make_grid(c.grid);
        const auto& [x, y, z] = box->axes;
        bounds = {{x.lower(), y.lower(), z.lower()}, {x.upper(), y.upper(), z.upper()}};
        return;
    }
    mesh = make_mesh(*c.mesh);
    bounds = {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
    for (const Vec3d& n : mesh->nodes) {
        bounds.lower = {std::min(bounds.lower.x, n.x), std::min(bounds.lower.y, n.y),
                        std::min(bounds.lower.z, n.z)};
        bounds.upper = {std::max(bounds.upper.x, n.x), std::max(bounds.upper.y, n.y),
                        std::max(bounds.upper.z, n.z)};
    }
}

FluidSystem::FluidSystem(const Case& c)
    : domain(c),
      speed(fastest(c, domain)),
      mach(c.numerics.mach.value_or(default_mach)),
      scales(fluid_scales(c, std::sqrt(3.0) * speed / mach)),
      flow(make_flow(c)),
      plan(make_plan(c, *this)) {
    flow->initialise(initial_flow(c, c.shear_rate.value_or(0) / scales.velocity_um_per_s, scales));
    if (!c.bodies.empty()) {
        const coupling::Kernel kernel = kernel_of(c.coupling.kernel);
        if (domain.box)
            loop = std::make_unique<coupling::Loop>(dynamic_cast<fluid::Solver&>(*flow), kernel);
        else
            loop = std::make_unique<coupling::Loop>(dynamic_cast<fluid::HexSolver&>(*flow), kernel);
        bodies = std::make_unique<RigidBodies>(c, scales, *loop, options());
    }
    if (!c.analytical) return;
    errors.emplace(c, *domain.box, scales, plan);
    if (c.fluid.initial == InitialFlow::analytical)
        flow->initialise([this](const Vec3d& x) { return errors->at_start(x); });
}

void FluidSystem::step(double dt) {
    if (loop)
        loop->step(dt);
    else
        flow->step(dt);
}

double FluidSystem::gamma_of(const Case& c, const fluid::SolverOptions& o, const meshing::HexGrid* grid) {
    if (!c.steady) return c.numerics.gamma.value_or(1);
    const auto shapes = grid ? fluid::cell_shapes(*grid) : fluid::cell_shapes(*domain.box);
    const fluid::PreconditioningChoice choice = fluid::choose_preconditioning(
        shapes, {mach / std::sqrt(3.0), o.nu, o.tau_floor, c.numerics.gamma.value_or(0)});
    reasoning = choice.reasoning;
    return choice.gamma;
}

std::unique_ptr<fluid::Flow> FluidSystem::make_flow(const Case& c) {
    const double rate = c.shear_rate.value_or(0) / scales.velocity_um_per_s;
    fluid::SolverOptions o;
    o.nu = c.fluid.viscosity / scales.viscosity_pa_s;
    set_body_force(c, scales, o);
    o.with_force = o.with_force || !c.bodies.empty();
    o.tau_floor = c.numerics.tau_floor;
    // a body's forces hold for a step, so its explicit steps are Euler's, at a quarter of the cost
    const fluid::Scheme explicit_scheme = c.bodies.empty() ? fluid::Scheme::rk4 : fluid::Scheme::euler;
    o.scheme = c.steady                                          ? fluid::Scheme::rk4
               : c.mesh && c.time.scheme == TimeScheme::factored ? explicit_scheme
                                                                 : scheme_of(c.time.scheme);
    o.single_precision = c.numerics.single_precision;
    o.gradient = gradient_of(c.numerics.gradient);
    if (domain.box) {
        o.gamma = gamma_of(c, o, nullptr);
        return std::make_unique<fluid::Solver>(*domain.box, make_patches(c, scales, rate, o.gamma), o);
    }
    meshing::HexGrid grid = make_hex_grid(c, *domain.mesh);
    o.gamma = gamma_of(c, o, &grid);
    return std::make_unique<fluid::HexSolver>(std::move(grid), make_hex_patches(c, scales, rate, o.gamma), o);
}

std::string describe(const Case& c, const FluidSystem& s) {
    return fmt::format(
               "{}\n  grid          {}, smallest {:.4g} um\n"
               "  fluid         nu/h = {:.3g}, Ma = {:.3g} at {:.4g} um/s, gamma = {:.3g}\n"
               "  conversion    length 1 um; velocity c = {:.4g} um/s; lattice time = {:.4g} s; "
               "stress = {:.4g} Pa",
               c.title, s.describe_grid(), s.smallest(), s.options().nu / s.smallest(), s.mach, s.speed,
               s.options().gamma, s.scales.velocity_um_per_s, s.scales.time_s(), s.scales.pressure_pa) +
           (s.bodies ? s.bodies->describe() : "");
}

void add_performance(output::Summary& summary, const FluidSystem& system, double steps, double wall_s,
                     double cpu_s) {
    summary.performance.wall_s = wall_s;
    summary.performance.cpu_s = cpu_s;
    summary.performance.steps = steps;
    summary.performance.cell_residuals_per_s =
        static_cast<double>(system.flow->evaluations()) * static_cast<double>(system.flow->cells()) / wall_s;
    summary.performance.peak_rss_mib = output::peak_rss_mib();
    summary.errors_estimated["compressibility"] = system.mach * system.mach;
}

void save_flow(const fluid::Flow& flow, output::Checkpoint& checkpoint) {
    for (int q = 0; q < 4; ++q) checkpoint.put(field_names[q], flow.values(q));
}

void load_flow(fluid::Flow& flow, const output::Checkpoint& checkpoint) {
    for (int q = 0; q < 4; ++q) flow.set_values(q, checkpoint.array(field_names[q], flow.cells()));
}

const fluid::SolverOptions& FluidSystem::options() const {
    if (const fluid::Solver* solver = box_solver()) return solver->options();
    return dynamic_cast<const fluid::HexSolver&>(*flow).options();
}

double FluidSystem::smallest() const {
    if (domain.box) return domain.box->smallest();
    double volume = 1e300;
    for (std::size_t i = 0; i < flow->cells(); ++i) volume = std::min(volume, flow->volume(i));
    return std::cbrt(volume);
}

std::string FluidSystem::describe_grid() const {
    if (!domain.box) return fmt::format("{} hexahedra", flow->cells());
    const auto& axes = domain.box->axes;
    return fmt::format("{} x {} x {} cells", axes[0].cells(), axes[1].cells(), axes[2].cells());
}

}  // namespace hemoflux::apps
