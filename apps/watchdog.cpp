#include "apps/watchdog.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "exchange/error.hpp"
#include "fluid/cell_report.hpp"
#include "membrane/relax.hpp"

namespace hemoflux::apps {

void check_density(const WatchdogInput& in, const fluid::Flow& flow) {
    const std::size_t bad = fluid::first_density_outside(flow, in.density[0], in.density[1]);
    if (bad == flow.cells()) return;
    throw NumericalError(
        fluid::describe_cell(flow, bad),
        fmt::format("its density is outside {} .. {} (watchdog.density): sound waves have grown, or "
                    "pressures differ by more than a nearly incompressible flow bears",
                    in.density[0], in.density[1]),
        "lower numerics.mach or numerics.reynolds, or shorten the step");
}

Watchdog::Watchdog(const WatchdogInput& in, std::vector<double> volume, std::vector<double> area)
    : in_(in), volume_(std::move(volume)), area_(std::move(area)) {}

void Watchdog::check_drift(const char* what, std::size_t cell, double now, double start, double bound) const {
    const double drift = now / start - 1;
    if (std::abs(drift) <= bound) return;
    throw NumericalError(
        fmt::format("the {} of cell {} has changed by {:.3g} %, to {:.6g} um^{}", what, cell, 100 * drift,
                    now, what[0] == 'v' ? 3 : 2),
        fmt::format("more than {:.3g} % is a leak or an overstretched membrane, not a red blood cell "
                    "(watchdog.{}_drift)",
                    100 * bound, what),
        fmt::format(
            "raise cell.{}_modulus, refine the grid around the membrane, or shorten numerics.step_strain",
            what));
}

void Watchdog::check(const membrane::Batch& cells) const {
    for (std::size_t c = 0; c < cells.cells(); ++c) {
        check_drift("volume", c, cells.sums(c).volume, volume_.at(c), in_.volume_drift);
        check_drift("area", c, cells.sums(c).area, area_.at(c), in_.area_drift);
        if (!in_.folds) continue;
        const auto& triangles = cells.topology().triangles();
        const std::vector<Vec3d> positions = cells.positions(c);
        const std::size_t fold = membrane::folded_triangle(cells.topology(), positions);
        if (fold == triangles.size()) continue;
        const meshing::Triangle& t = triangles[fold];
        const Vec3d at = positions[static_cast<std::size_t>(t[0])];
        throw NumericalError(
            fmt::format(
                "triangle {} of cell {} (vertices {}, {}, {}) at ({:.3f}, {:.3f}, {:.3f}) um is folded over",
                fold, c, t[0], t[1], t[2], at.x, at.y, at.z),
            "the membrane has turned inside out there, most often because it buckles at a scale below its "
            "mesh",
            "give it more nodes, membrane_viscosity or a larger bending_modulus, or shorten "
            "numerics.step_strain; "
            "watchdog.folds = false goes on");
    }
}

}  // namespace hemoflux::apps
