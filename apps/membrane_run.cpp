// A cell alone, statically: relaxed, or stretched by optical tweezers.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "apps/cell_builder.hpp"
#include "apps/output/atomic_file.hpp"
#include "apps/output/folder.hpp"
#include "apps/output/history.hpp"
#include "apps/output/log.hpp"
#include "apps/output/plot.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/summary.hpp"
#include "apps/output/vtk_writer.hpp"
#include "apps/run.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "membrane/batch.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/stretch.hpp"

namespace hemoflux::apps {
namespace {

constexpr double piconewton = 0.1;         // in 1e-11 N
constexpr double attojoule_per_unit = 10;  // 1e-17 J

/// Observables of a shape at rest.
void describe_shape(const membrane::Cell& cell, const membrane::Batch& batch, output::Summary& summary) {
    const auto positions = batch.positions(0);
    const auto moments = membrane::shape_moments(cell.topology->triangles(), positions);
    const auto disc = membrane::disc_measures(cell.topology->triangles(), positions);
    summary.observables["diameter_um"] = disc.diameter;
    summary.observables["centre_thickness_um"] = disc.centre_thickness;
    summary.observables["greatest_thickness_um"] = disc.greatest_thickness;
    summary.observables["area_um2"] = moments.area;
    summary.observables["volume_um3"] = moments.volume;
    summary.observables["reduced_volume"] = moments.reduced_volume;
    summary.observables["area_offset"] = moments.area / cell.reference.area - 1;
    summary.observables["volume_offset"] = moments.volume / cell.reference.volume - 1;
    summary.observables["energy_aJ"] = batch.energies(0).total() * attojoule_per_unit;
}

/// Root mean square distance of the computed curve, interpolated linearly, from the measured points it spans.
double rms_distance(const std::vector<double>& force, const std::vector<double>& computed,
                    const std::vector<double>& measured_force, const std::vector<double>& measured) {
    double sum = 0;
    int count = 0;
    for (std::size_t m = 0; m < measured.size(); ++m) {
        const auto upper = std::lower_bound(force.begin(), force.end(), measured_force[m]);
        if (upper == force.end() || (upper == force.begin() && *upper != measured_force[m])) {
            continue;
        }
        const auto i = static_cast<std::size_t>(upper - force.begin());
        const double t = i == 0 ? 0 : (measured_force[m] - force[i - 1]) / (force[i] - force[i - 1]);
        const double value = i == 0 ? computed[0] : computed[i - 1] + t * (computed[i] - computed[i - 1]);
        sum += (value - measured[m]) * (value - measured[m]);
        ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : NAN;
}

/// Columns of stretch.csv by name.
struct Curves {
    std::vector<double> force, axial, transverse;
};

/// Distance from the experiment, and the picture of both.
void compare(const MembraneInput& in, const Curves& curves, const output::OutputFolder& folder, bool pictures,
             output::Summary& summary, const output::Log& log) {
    output::PlotSpec spec{
        .title = summary.case_name,
        .x_label = "force / pN",
        .y_label = "diameter / um",
        .curves = {{"axial", curves.force, curves.axial}, {"transverse", curves.force, curves.transverse}}};
    if (!in.experiment.empty()) {
        const output::Table table = output::read_table(in.experiment);
        const std::vector<double> force = table.column("F_pN");
        const std::vector<double> axial = table.column("DA_um");
        const std::vector<double> transverse = table.column("DT_um");
        summary.observables["axial_rms_um"] = rms_distance(curves.force, curves.axial, force, axial);
        summary.observables["transverse_rms_um"] =
            rms_distance(curves.force, curves.transverse, force, transverse);
        spec.curves.push_back({.label = "axial, measured", .x = force, .y = axial, .points = true});
        spec.curves.push_back({.label = "transverse, measured", .x = force, .y = transverse, .points = true});
    }
    if (pictures) {
        if (const auto message = output::plot(spec, folder.path() / "plot_stretch")) {
            log.warn(*message);
        }
    }
}

Curves stretch(const MembraneInput& in, const membrane::RelaxOptions& options, membrane::Batch& batch,
               const output::OutputFolder& folder, output::Summary& summary) {
    const std::vector<membrane::StretchPoint> points = membrane::stretch(batch, in.forces, options);
    output::Table table{{"force_pN", "axial_um", "transverse_um", "iterations", "area_error", "volume_error"},
                        {}};
    Curves curves;
    summary.conservation.area = summary.conservation.volume = 0;
    for (const membrane::StretchPoint& p : points) {
        table.rows.push_back({p.force_pN, p.axial_um, p.transverse_um, static_cast<double>(p.iterations),
                              p.area_error, p.volume_error});
        curves.force.push_back(p.force_pN);
        curves.axial.push_back(p.axial_um);
        curves.transverse.push_back(p.transverse_um);
        summary.conservation.area = std::max(summary.conservation.area, std::abs(p.area_error));
        summary.conservation.volume = std::max(summary.conservation.volume, std::abs(p.volume_error));
    }
    output::write_table(folder.path() / "stretch.csv", table);
    summary.observables["force_pN"] = points.back().force_pN;
    summary.observables["axial_diameter_um"] = points.back().axial_um;
    summary.observables["transverse_diameter_um"] = points.back().transverse_um;
    return curves;
}

}  // namespace

void check_experiment(const MembraneInput& in) {
    if (in.experiment.empty()) return;
    const output::Table table = output::read_table(in.experiment);
    for (const char* column : {"F_pN", "DA_um", "DT_um"}) static_cast<void>(table.column(column));
}

int run_membrane(const Case& c, const RunOptions& options) {
    if (!options.restart.empty()) {
        throw InputError("--restart with a case of kind \"membrane\"",
                         "a static computation has no checkpoints", "Run it anew, it takes seconds");
    }
    check_experiment(c.membrane);
    const auto start = std::chrono::steady_clock::now();
    if (options.threads > 0) {
        exchange::set_threads(options.threads);
    }
    const output::OutputFolder folder(options.output, output::Folder::fresh);
    const output::Log log(folder.log(), options.quiet);
    output::write_file(folder.resolved(), c.resolved);

    output::Summary summary;
    summary.case_name = c.title;
    summary.version = HEMOFLUX_VERSION;
    summary.backend = exchange::backend_name();
    summary.threads = exchange::threads();
    for (const ReferenceInput& r : c.references) {
        summary.references[r.observable] = {r.value, r.low, r.high, r.source};
    }

    const membrane::RelaxOptions relaxation{.tolerance = c.membrane.tolerance * piconewton};
    const membrane::Cell cell = build_cell(c.cells.front(), relaxation);
    membrane::Batch batch(cell.topology, cell.parameters, cell.reference);
    batch.set_positions(0, cell.positions);
    const membrane::RelaxResult rest = membrane::relax(batch, relaxation);
    describe_shape(cell, batch, summary);
    summary.observables["largest_force_pN"] = rest.largest_force / piconewton;
    output::PvdSeries series(folder.cell_series());
    const auto write_cell = [&](double force) {
        const auto file = folder.cell_file(series.next());
        output::write_cells(file, {{batch.positions(0), cell.topology->triangles()}}, {}, force);
        series.add(force, file);
    };
    write_cell(0);
    log.info(fmt::format("relaxed: {} nodes, {} iterations, largest force {:.2g} pN", batch.vertices(),
                         cell.relaxation.iterations + rest.iterations, rest.largest_force / piconewton));
    if (c.membrane.task == MembraneTask::stretch) {
        const Curves curves = stretch(c.membrane, relaxation, batch, folder, summary);
        write_cell(curves.force.back());
        compare(c.membrane, curves, folder, c.output.pictures, summary, log);
    }
    summary.performance.wall_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    summary.performance.cpu_s = output::cpu_seconds();
    summary.performance.peak_rss_mib = output::peak_rss_mib();
    output::write_summary(folder.summary(), summary);
    log.info(output::to_table(summary));
    return static_cast<int>(Exit::done);
}

}  // namespace hemoflux::apps
