// Cases of kind membrane: the frame around their tasks.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "apps/cell_builder.hpp"
#include "apps/cell_file.hpp"
#include "apps/membrane_task.hpp"
#include "apps/output/atomic_file.hpp"
#include "apps/output/history.hpp"
#include "apps/run.hpp"
#include "apps/run_files.hpp"
#include "apps/tweezers.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/fields.hpp"

namespace hemoflux::apps {
namespace {

/// thickness.csv: how thick the cell is at each distance from its axis.
void write_thickness(const MembraneRun& run, const membrane::Batch& batch) {
    output::Table table{{"radius_um", "mean_um", "least_um", "greatest_um"}, {}};
    for (const auto& s : membrane::thickness_profile(batch.topology().triangles(), batch.positions(0)))
        table.rows.push_back({s.radius, s.mean, s.least, s.greatest});
    output::write_table(run.folder.path() / "thickness.csv", table);
}

}  // namespace

std::string MembraneRun::label(std::size_t cell) const {
    const std::string& name = input.cells[cell].name;
    return name.empty() ? std::to_string(cell) : name;
}

std::string MembraneRun::prefix(std::size_t cell) const {
    return input.cells.size() == 1 ? "" : label(cell) + ".";
}

membrane::Batch MembraneRun::rest(const CellInput& input_cell, const std::string& name) {
    const membrane::Cell cell = build_cell(input_cell, relaxation);
    membrane::Batch batch(cell.topology, cell.parameters, cell.reference);
    batch.set_positions(0, cell.positions);
    const membrane::RelaxResult result = membrane::relax(batch, relaxation);
    log.info(fmt::format("relaxed{}{}: {} nodes, {} iterations, largest force {:.2g} pN",
                         name.empty() ? "" : " ", name, batch.vertices(),
                         cell.relaxation.iterations + result.iterations, result.largest_force / piconewton));
    return batch;
}

std::filesystem::path MembraneRun::frame(const membrane::Batch& batch, double position) {
    const auto file = folder.cell_file(series.next());
    const membrane::VertexFields vertex = membrane::vertex_fields(batch, 0);
    const membrane::TriangleFields triangle = membrane::triangle_fields(batch, 0);
    const auto in_si = [](std::vector<double> tension) {
        for (double& t : tension) t *= micronewton_per_unit;
        return tension;
    };
    write_cell(file, batch.topology(), batch.reference(), batch.positions(0), position,
               {{"curvature_per_um", 1, vertex.curvature}, {"area_strain", 1, vertex.area_strain}},
               {{"triangle_area_strain", 1, triangle.area_strain},
                {"major_stretch", 1, triangle.major_stretch},
                {"minor_stretch", 1, triangle.minor_stretch},
                {"major_tension_uN_per_m", 1, in_si(triangle.major_tension)},
                {"minor_tension_uN_per_m", 1, in_si(triangle.minor_tension)},
                {"area_tension_uN_per_m", 1, in_si(triangle.area_tension)}});
    series.add(position, file);
    return file;
}

void MembraneRun::describe(const membrane::Batch& batch, const std::string& prefix) {
    const auto positions = batch.positions(0);
    const auto& triangles = batch.topology().triangles();
    const auto moments = membrane::shape_moments(triangles, positions);
    const auto disc = membrane::disc_measures(triangles, positions);
    const membrane::Energies energy = batch.energies(0);
    const auto put = [&](const char* name, double value) { summary.observables[prefix + name] = value; };
    put("diameter_um", disc.diameter);
    put("centre_thickness_um", disc.centre_thickness);
    put("greatest_thickness_um", disc.greatest_thickness);
    put("area_um2", moments.area);
    put("volume_um3", moments.volume);
    put("reduced_volume", moments.reduced_volume);
    for (std::size_t i = 0; i < 3; ++i)
        put(("gyration_" + std::to_string(i + 1) + "_um").c_str(), std::sqrt(moments.moments[i]));
    put("deformation_index", membrane::minimum_rectangle(positions).deformation_index());
    put("taylor_d", membrane::taylor_deformation(moments));
    put("taylor_d_volume", membrane::taylor_deformation_volume(moments));
    put("taylor_d_extent", membrane::taylor_deformation_extent(positions, moments.centroid));
    put("area_offset", moments.area / batch.reference().area - 1);
    put("volume_offset", moments.volume / batch.reference().volume - 1);
    put("energy_aJ", energy.total() * attojoule_per_unit);
    put("energy_bending_aJ", energy.bending * attojoule_per_unit);
    put("energy_area_difference_aJ", energy.area_difference * attojoule_per_unit);
    put("energy_shear_aJ", energy.shear * attojoule_per_unit);
    put("energy_local_area_aJ", energy.local_area * attojoule_per_unit);
    put("energy_area_aJ", energy.area * attojoule_per_unit);
    put("energy_volume_aJ", energy.volume * attojoule_per_unit);
}

void MembraneRun::plot(const output::PlotSpec& spec, const std::string& stem) const {
    if (!input.output.pictures) return;
    if (const auto message = output::plot(spec, folder.path() / stem)) log.warn(*message);
}

void MembraneRun::gallery(const output::GallerySpec& spec, const std::string& stem) const {
    if (!input.output.pictures) return;
    if (const auto message = output::draw_gallery(spec, folder.path() / (stem + ".png"))) log.warn(*message);
}

void run_relax(MembraneRun& run) {
    output::GallerySpec gallery{.title = run.input.title, .items = {}};
    for (std::size_t i = 0; i < run.input.cells.size(); ++i) {
        const bool alone = run.input.cells.size() == 1;
        const membrane::Batch batch = run.rest(run.input.cells[i], alone ? "" : run.label(i));
        run.describe(batch, run.prefix(i));
        if (alone) write_thickness(run, batch);
        const std::string energy = fmt::format("{:.4g} aJ", batch.energies(0).total() * attojoule_per_unit);
        gallery.items.push_back(
            {run.frame(batch, static_cast<double>(i)), alone ? energy : run.label(i) + "\n" + energy});
    }
    run.gallery(gallery, "picture_shapes");
}

void check_experiment(const MembraneInput& in) {
    if (!in.experiment.empty()) static_cast<void>(read_experiment(in.experiment));
    for (const std::string& file : in.recovery) {
        const output::Table table = output::read_table(file);
        for (const char* column : {"t", "L_W"}) static_cast<void>(table.column(column));
    }
}

int run_membrane(const Case& c, const RunOptions& options) {
    if (!options.restart.empty()) {
        throw InputError("--restart with a case of kind \"membrane\"",
                         "a computation of seconds has no checkpoints",
                         "Run it anew; --file results/x/cells_0000.vtp starts from a shape it has written");
    }
    check_experiment(c.membrane);
    const auto start = std::chrono::steady_clock::now();
    const double cpu_before = output::cpu_seconds();
    if (options.threads > 0) {
        exchange::set_threads(options.threads);
    }
    const output::OutputFolder folder(options.output, output::Folder::fresh);
    output::write_file(folder.resolved(), c.resolved);
    const output::Log log(folder.log(), options.quiet);
    note_environment(log);
    output::Summary summary = start_summary(c);
    MembraneRun run{c,
                    folder,
                    log,
                    summary,
                    {.tolerance = c.membrane.tolerance * piconewton},
                    output::PvdSeries(folder.cell_series())};
    constexpr void (*tasks[])(MembraneRun&) = {run_relax,  run_stretch,  run_shapes,
                                               run_moduli, run_recovery, run_calibration};
    return watched(log, [&] {
        tasks[static_cast<std::size_t>(c.membrane.task)](run);
        summary.performance.wall_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        summary.performance.cpu_s = output::cpu_seconds() - cpu_before;
        summary.performance.peak_rss_mib = output::peak_rss_mib();
        output::write_summary(folder.summary(), summary);
        log.info(output::to_table(summary));
        log.info(closing_line(folder.path()));
        return static_cast<int>(Exit::done);
    });
}

}  // namespace hemoflux::apps
