// The numbers of a coupled run: its clock, the capillary scaling, and the start-up summary of both.
#include <fmt/format.h>

#include <algorithm>

#include "apps/case_suspension.hpp"
#include "apps/cell_surface.hpp"
#include "apps/coupled_run.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

constexpr double metre_per_um = 1e-6;

void check_supported(const Case& c) {
    if (c.numerics.single_precision)
        throw InputError("numerics.precision \"single\"", "cells exert a body force, which needs double",
                         "Leave numerics.precision out");
    if (c.numerics.gamma != 1.0)
        throw InputError(fmt::format("numerics.gamma {}", c.numerics.gamma.value_or(0)),
                         "preconditioning changes the path in time, and a coupled run is unsteady",
                         "Set it to 1");
    if (c.tweezers && c.cells.size() > 1)
        throw InputError(fmt::format("[tweezers] with {} cells", c.cells.size()), "they hold one",
                         "Keep one [[cell]]");
}

const char* name_of(fluid::Scheme scheme) {
    return scheme == fluid::Scheme::euler ? "euler" : scheme == fluid::Scheme::rk4 ? "rk4" : "factored";
}

}  // namespace

double surface_viscosity_in_fluid(const Case& c, const coupling::Numerics& n) {
    if (c.coupling.membrane_viscosity != MembraneViscosityForm::fluid) return 0;
    return n.nu * c.cells.front().membrane_viscosity / (c.fluid.viscosity * metre_per_um);
}

fluid::Scheme coupled_scheme(const Case& c) {
    // forces hold for a step, so an explicit step is Euler's, at a quarter of the cost of RK4
    if (c.mesh && c.time.scheme == TimeScheme::factored) return fluid::Scheme::euler;
    return scheme_of(c.time.scheme);
}

double clock_rate(const Case& c) {
    if (c.shear_rate) return *c.shear_rate;
    const CellInput& cell = c.cells.front();
    return cell.shear_modulus / (c.fluid.viscosity * rest_state(cell).radius() * metre_per_um);
}

double strain_of(const Case& c) { return c.time.strain ? *c.time.strain : *c.time.duration * clock_rate(c); }

coupling::Numerics numerics_of(const Case& c, double smallest, double sheared) {
    check_supported(c);
    const CellInput& cell = c.cells.front();
    coupling::PhysicalCase p;
    p.density = c.fluid.density;
    p.viscosity = c.fluid.viscosity;
    for (const CellInput& each : c.cells)
        p.largest_cytosol = std::max(p.largest_cytosol, each.cytosol_viscosity);
    p.shear_rate = clock_rate(c);
    p.shear_modulus = cell.shear_modulus;
    p.area_modulus = cell.area_modulus;
    p.local_area_modulus = cell.local_area_modulus;
    p.radius = rest_state(cell).radius();
    p.wall_distance = c.shear_rate ? flow_reach(c, sheared) : p.radius;
    p.smallest_cell = smallest;
    coupling::NumericsChoice choice;
    choice.lattice_viscosity = c.numerics.lattice_viscosity.value_or(0.5);
    choice.reynolds = c.numerics.reynolds.value_or(2);
    choice.mach = c.numerics.mach.value_or(0);
    choice.step_strain = c.time.step ? *c.time.step * p.shear_rate : c.numerics.step_strain.value_or(0);
    choice.kernel = kernel_of(c.coupling.kernel);
    choice.scheme = coupled_scheme(c);
    return coupling::choose_numerics(p, choice);
}

std::string errors_text(const coupling::Numerics& n) {
    std::string text;
    for (const auto& [cause, error] : n.errors)
        text += fmt::format("{}{} {:.1f} %", text.empty() ? "" : "; ", cause, 100 * error);
    return text + " (estimated)";
}

std::string describe(const Case& c, const CoupledSystem& s) {
    const coupling::Numerics& n = s.numerics;
    std::string grid = fmt::format("{} hexahedra", s.fluid->cells());
    if (s.domain.box) {
        const auto& axes = s.domain.box->axes;
        grid = fmt::format("{} x {} x {} cells", axes[0].cells(), axes[1].cells(), axes[2].cells());
    }
    std::string text = fmt::format(
        "{}\n"
        "  grid          {}, smallest {:.4g} um\n"
        "  cells         {} of {} nodes, viscosity ratio {:.3g}\n"
        "  physical      {} = {:.4g} 1/s, Ca = G mu R0/K_S = {:.4g}, Re_G = {:.3g}\n"
        "  chosen        nu/h = {:.3g}, Re_G = {:.3g}, Ma = {:.3g}, kernel as in the case, scheme {}\n"
        "  step          G dt = {:.4g} ({} steps of {:.4g} s; limit: {}{})\n"
        "  conversion    length 1 um; velocity c = {:.4g} um/s; lattice time = {:.4g} s; stress = {:.4g} "
        "Pa;\n"
        "                membrane force 1e-11 N = {:.4g} lattice units\n"
        "  errors        ",
        c.title, grid, s.smallest(), s.cells->cells(), s.cells->vertices(),
        c.cells.front().cytosol_viscosity / c.fluid.viscosity,
        c.shear_rate ? "G" : "no shear, clock G = K_S/(mu R0)", s.clock, n.capillary, n.physical_reynolds,
        n.lattice_viscosity, n.reynolds, n.mach, name_of(coupled_scheme(c)), n.step_strain, s.plan.steps,
        n.step_seconds, n.step_limit,
        fmt::format("{}{}", n.constraint_damping > 0 ? ", penalties damped" : "",
                    c.time.adaptive ? "; adaptive, this is the longest" : ""),
        n.velocity_um_per_s, s.scales.time_s(), s.scales.pressure_pa, n.force_factor);
    text += errors_text(n);
    if (s.bodies) text += s.bodies->describe();
    text += "\n  exchanged     ";
    for (const auto& field : s.loop->fields().list()) text += fmt::format("{} [{}] ", field.name, field.unit);
    return text;
}

}  // namespace hemoflux::apps
