#include "apps/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "apps/cell_surface.hpp"
#include "apps/coupled_run.hpp"
#include "apps/fluid_system.hpp"
#include "apps/output/summary.hpp"
#include "apps/run.hpp"
#include "exchange/backend.hpp"

namespace hemoflux::apps {
namespace {

/// A membrane node costs about as much time as this many grid cells (forces, stencils, spreading, interpolation), and
/// takes about this much memory.
constexpr double cells_per_node = 4, mib_per_node = 3.0 / 1024;

/// Wall seconds of one call: the shortest of several, at most a third of a second in all after the first.
double seconds_of(const std::function<void()>& call) {
    using clock = std::chrono::steady_clock;
    const auto seconds = [](clock::time_point from) {
        return std::chrono::duration<double>(clock::now() - from).count();
    };
    call();  // warm caches
    const auto start = clock::now();
    double least = 1e300;
    for (int n = 0; n < 20 && (n == 0 || seconds(start) < 0.3); ++n) {
        const auto begin = clock::now();
        call();
        least = std::min(least, seconds(begin));
    }
    return least;
}

std::string time_text(double s) {
    if (s < 120) return fmt::format("{:.2g} s", s);
    return s < 7200 ? fmt::format("{:.3g} min", s / 60) : fmt::format("{:.3g} h", s / 3600);
}

std::string line(const char* name, const std::string& value) {
    return fmt::format("#   {:<20} {}\n", name, value);
}

std::string estimates(double seconds, double nodes, const std::string& how) {
    return line("estimated run time",
                fmt::format("{} on {} threads ({})", time_text(seconds), exchange::threads(), how)) +
           line("estimated memory", fmt::format("{:.0f} MiB", output::peak_rss_mib() + nodes * mib_per_node));
}

std::string of_coupled(const Case& c) {
    CoupledSystem s(c);
    const coupling::Numerics& n = s.numerics;
    const double cells = static_cast<double>(s.fluid->cells()), steps = static_cast<double>(s.plan.steps);
    double nodes = 0;
    for (const CellInput& cell : c.cells)
        nodes += cell.shape == CellShape::file ? static_cast<double>(start_shape(cell).vertices.size())
                                               : cell.nodes;
    const double step = seconds_of([&] { s.fluid->step(n.step); });
    return line("clock",
                fmt::format("{} = {:.4g} 1/s", c.shear_rate ? "shear rate G" : "G = K_S/(mu R0)", s.clock)) +
           line("capillary number", fmt::format("Ca = G mu R0/K_S = {:.4g}", n.capillary)) +
           line("Reynolds number",
                fmt::format("Re = {:.3g} of the case, {:.3g} computed", n.physical_reynolds, n.reynolds)) +
           line("Mach number", fmt::format("Ma = {:.3g}", n.mach)) +
           line("lattice viscosity", fmt::format("nu/h = {:.3g}", n.lattice_viscosity)) +
           line("smallest fluid cell", fmt::format("{:.4g} um", s.smallest())) +
           line("errors", errors_text(n)) +
           line("step", fmt::format("{:.4g} s, in strain {:.4g}; limit: {}", n.step_seconds, n.step_strain,
                                    n.step_limit)) +
           line("steps", fmt::format("{}{}", c.time.adaptive ? "adaptive, at least " : "", s.plan.steps)) +
           estimates(
               steps * step * (1 + cells_per_node * nodes / cells), nodes,
               fmt::format(
                   "an estimate: steps of the fluid were measured, {:.0f} nodes are counted as {:.0f} cells "
                   "each; relaxing the cells and writing come on top",
                   nodes, cells_per_node));
}

std::string of_fluid(const Case& c) {
    FluidSystem s(c);
    const double length = std::min({s.domain.bounds.upper.x - s.domain.bounds.lower.x,
                                    s.domain.bounds.upper.y - s.domain.bounds.lower.y});
    constexpr double metre_per_um = 1e-6;
    const double reynolds =
        c.fluid.density * s.speed * metre_per_um * length * metre_per_um / c.fluid.viscosity;
    std::string text =
        line("Reynolds number",
             fmt::format("Re = {:.4g} at {:.4g} um/s and {:.4g} um, the shorter of the extents along x and y",
                         reynolds, s.speed, length)) +
        line("Mach number", fmt::format("Ma = {:.3g}", s.mach)) +
        line("lattice viscosity", fmt::format("nu/h = {:.3g}", s.options().nu / s.smallest()));
    if (c.steady) {
        const double evaluation = seconds_of([&] { s.flow->evaluate(); });
        return text +
               line("estimated run time", fmt::format("{} for every thousand residual evaluations on {} "
                                                      "threads (an estimate: some were measured; "
                                                      "how many it takes is not known before)",
                                                      time_text(1000 * evaluation), exchange::threads())) +
               line("estimated memory",
                    fmt::format("{:.0f} MiB, and the matrix of the implicit method", output::peak_rss_mib()));
    }
    const double step = seconds_of([&] { s.step(s.plan.step / s.scales.time_s()); });
    return text + line("step", fmt::format("{:.4g} s", s.plan.step)) +
           line("steps", fmt::format("{}", s.plan.steps)) +
           estimates(static_cast<double>(s.plan.steps) * step, 0,
                     "an estimate: some steps were measured; writing comes on top");
}

}  // namespace

std::string derived_numbers(const Case& c) {
    switch (c.kind) {
        case CaseKind::coupled:
            return "# Derived numbers\n" + of_coupled(c);
        case CaseKind::fluid:
            return "# Derived numbers\n" + of_fluid(c);
        case CaseKind::membrane:
            break;
    }
    check_run(c);
    return "";
}

}  // namespace hemoflux::apps
