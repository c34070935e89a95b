// A stretched cell let go, in overdamped motion, against Hochmuth, Worthy and Evans 1979.
#include <fmt/format.h>

#include <cmath>

#include "apps/membrane_task.hpp"
#include "apps/output/history.hpp"
#include "exchange/error.hpp"
#include "membrane/recovery.hpp"

namespace hemoflux::apps {
namespace {

constexpr int steps = 400;

membrane::DynamicsOptions motion_of(const MembraneRun& run, const CellInput& cell,
                                    const membrane::Reference& reference) {
    const MembraneInput& in = run.input.membrane;
    const double radius = membrane::RestState{.area = reference.area}.radius();
    return {.drag = membrane::stokes_drag(in.fluid_viscosity * pascal_second,
                                          cell.cytosol_viscosity * pascal_second, radius),
            .step = in.duration * second / steps,
            .steps = steps};
}

/// Measured points as the library's, with width 1.
std::vector<membrane::RecoveryPoint> measured_points(const output::Table& table) {
    std::vector<membrane::RecoveryPoint> points;
    const auto t = table.column("t"), ratio = table.column("L_W");
    for (std::size_t i = 0; i < t.size(); ++i) points.push_back({t[i] - t[0], ratio[i], 1});
    return points;
}

/// Adds the measured curves to the plot and their time constants to the summary.
void compare(MembraneRun& run, output::PlotSpec& plot) {
    const auto& files = run.input.membrane.recovery;
    double sum = 0;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto points = measured_points(output::read_table(files[i]));
        output::Curve& curve = plot.curves.emplace_back(
            output::Curve{.label = fmt::format("measured {}", i + 1), .x = {}, .y = {}, .points = true});
        for (const auto& p : points) {
            curve.x.push_back(p.time_s);
            curve.y.push_back(p.axial_um / p.transverse_um);
        }
        // the measured cells end longer than wide; Hochmuth's fit takes that as their rest
        const double time =
            membrane::recovery_time(points, points.back().axial_um / points.back().transverse_um);
        run.summary.observables[fmt::format("measured_{}_recovery_s", i + 1)] = time;
        sum += time;
    }
    if (!files.empty()) {
        const double mean = sum / static_cast<double>(files.size());
        run.summary.observables["measured_recovery_s"] = mean;
        if (!run.summary.references.contains("recovery_s"))
            run.summary.references["recovery_s"] = {mean, {}, {}, "mean of the measured curves"};
    }
}

}  // namespace

void run_recovery(MembraneRun& run) {
    const CellInput& cell = run.input.cells.front();
    const MembraneInput& in = run.input.membrane;
    if (!(cell.membrane_viscosity > 0))
        run.log.warn("cell.membrane_viscosity is 0: the cell recovers against the fluid alone");
    membrane::Batch batch = run.rest(cell, "");
    run.describe(batch, "");
    const auto rest = membrane::stretch(batch, {0}, run.relaxation, in.grip).front();
    const double rest_ratio = rest.axial_um / rest.transverse_um;
    membrane::stretch(batch, in.forces, run.relaxation, in.grip);
    run.frame(batch, 0);
    const membrane::DynamicsOptions motion = motion_of(run, cell, batch.reference());
    const auto points = membrane::relax_back(batch, motion);
    run.frame(batch, points.back().time_s);

    output::Table table{{"time_s", "axial_um", "transverse_um", "length_over_width"}, {}};
    output::PlotSpec plot{.title = run.input.title,
                          .x_label = "time, s",
                          .y_label = "length over width",
                          .curves = {{.label = "computed", .x = {}, .y = {}}}};
    for (const auto& p : points) {
        const double ratio = p.axial_um / p.transverse_um;
        table.rows.push_back({p.time_s, p.axial_um, p.transverse_um, ratio});
        plot.curves.front().x.push_back(p.time_s);
        plot.curves.front().y.push_back(ratio);
    }
    const double time = membrane::recovery_time(points, rest_ratio);
    run.summary.observables["recovery_s"] = time;
    run.summary.observables["start_length_over_width"] = table.rows.front()[3];
    run.summary.observables["rest_length_over_width"] = rest_ratio;
    compare(run, plot);
    output::write_table(run.folder.path() / "recovery.csv", table);
    run.plot(plot, "plot_recovery");
    run.log.info(fmt::format(
        "Assumed of the fluid: no inertia, the same drag everywhere, 2 (mu_o + mu_i)/R0 per area and "
        "velocity\n"
        "with mu_o = {:g} and mu_i = {:g} mPa s; membrane viscosity {:g} uPa s m; no flow inside is solved.",
        in.fluid_viscosity * 1e3, cell.cytosol_viscosity * 1e3, cell.membrane_viscosity * 1e6));
}

}  // namespace hemoflux::apps
