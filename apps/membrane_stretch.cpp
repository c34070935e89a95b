// Optical tweezers: every cell of the case under every force.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/membrane_task.hpp"
#include "apps/output/history.hpp"
#include "apps/tweezers.hpp"
#include "membrane/recovery.hpp"

namespace hemoflux::apps {
namespace {

/// Most surfaces in one gallery.
constexpr std::size_t most_shapes = 24;

/// One cell pulled with all forces.
struct Pull {
    std::vector<membrane::StretchPoint> points;
    std::vector<output::GalleryItem> shapes;
};

/// Overdamped motion at each force until the cell rests, in place of the static solver.
std::vector<membrane::StretchPoint> stretch_in_time(
    const MembraneRun& run, const CellInput& cell, membrane::Batch& batch,
    const std::function<void(const membrane::StretchPoint&)>& done) {
    constexpr int steps = 400;
    const MembraneInput& in = run.input.membrane;
    const double radius = membrane::RestState{.area = batch.reference().area}.radius();
    const membrane::DynamicsOptions options{
        .drag = membrane::stokes_drag(in.fluid_viscosity * pascal_second,
                                      cell.cytosol_viscosity * pascal_second, radius),
        .step = in.duration * second / steps,
        .steps = steps};
    const membrane::PulledVertices pulled = membrane::pulled_vertices(batch.positions(0), in.grip);
    batch.compute_forces();
    const double area = batch.sums(0).area, volume = batch.sums(0).volume;
    std::vector<membrane::StretchPoint> points;
    for (const double force : in.forces) {
        const auto path = membrane::pull_in_time(batch, pulled, force, options);
        membrane::StretchPoint point = membrane::stretch_point(batch, force, area, volume);
        point.iterations = static_cast<int>(path.size()) - 1;
        points.push_back(point);
        done(point);
    }
    return points;
}

Pull pull(MembraneRun& run, std::size_t index) {
    const MembraneInput& in = run.input.membrane;
    const CellInput& cell = run.input.cells[index];
    membrane::Batch batch = run.rest(cell, run.prefix(index).empty() ? "" : run.label(index));
    run.describe(batch, run.prefix(index));
    Pull result;
    const auto done = [&](const membrane::StretchPoint& p) {
        result.shapes.push_back(
            {run.frame(batch, p.force_pN), fmt::format("{:g} pN\naxial {:.2f}, transverse {:.2f} \xC2\xB5m",
                                                       p.force_pN, p.axial_um, p.transverse_um)});
    };
    result.points = in.dynamic ? stretch_in_time(run, cell, batch, done)
                               : membrane::stretch(batch, in.forces, run.relaxation, in.grip, done);
    return result;
}

/// At most `count` items, evenly spread, the first and the last among them.
std::vector<output::GalleryItem> spread(const std::vector<output::GalleryItem>& items, std::size_t count) {
    if (items.size() <= count) return items;
    std::vector<output::GalleryItem> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(items[i * (items.size() - 1) / (count - 1)]);
    return chosen;
}

/// The curve of one diameter, ascending in force, of forces given in any order.
DiameterCurve curve_of(const std::vector<membrane::StretchPoint>& points,
                       double membrane::StretchPoint::*diameter) {
    std::vector<membrane::StretchPoint> sorted = points;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.force_pN < b.force_pN; });
    DiameterCurve curve;
    for (const membrane::StretchPoint& p : sorted) {
        curve.force.push_back(p.force_pN);
        curve.value.push_back(p.*diameter);
    }
    return curve;
}

/// Diameters at single forces, those only that the case has references for.
void report_points(MembraneRun& run, const std::string& prefix,
                   const std::vector<membrane::StretchPoint>& points) {
    for (const membrane::StretchPoint& p : points) {
        const std::string at = fmt::format("_um_at_{:g}_pN", p.force_pN);
        for (const auto& [name, value] :
             {std::pair{prefix + "axial" + at, p.axial_um}, {prefix + "transverse" + at, p.transverse_um}})
            if (run.summary.references.contains(name)) run.summary.observables[name] = value;
    }
}

void report_distance(MembraneRun& run, const std::string& prefix, const char* name, const Distance& d) {
    run.summary.observables[prefix + name + "_rms_um"] = d.rms_um;
    run.summary.observables[prefix + name + "_points"] = d.points;
    if (d.with_bars) run.summary.observables[prefix + name + "_inside_bars"] = d.inside;
}

}  // namespace

void run_stretch(MembraneRun& run) {
    const MembraneInput& in = run.input.membrane;
    output::Table table{
        {"cell", "force_pN", "axial_um", "transverse_um", "iterations", "area_error", "volume_error"}, {}};
    output::PlotSpec plot{.title = run.input.title,
                          .x_label = "pulling force, pN",
                          .y_label = "diameter, \xC2\xB5m",
                          .curves = {}};
    Experiment experiment;
    if (!in.experiment.empty()) {
        experiment = read_experiment(in.experiment);
        plot.curves.push_back(measured_curve("measured", experiment.force, experiment.axial));
        plot.curves.push_back(measured_curve("", experiment.force, experiment.transverse));
    }
    auto& conservation = run.summary.conservation;
    conservation.area = conservation.volume = 0;
    for (std::size_t i = 0; i < run.input.cells.size(); ++i) {
        const Pull result = pull(run, i);
        for (const membrane::StretchPoint& p : result.points) {
            table.rows.push_back({static_cast<double>(i), p.force_pN, p.axial_um, p.transverse_um,
                                  static_cast<double>(p.iterations), p.area_error, p.volume_error});
            conservation.area = std::max(conservation.area, std::abs(p.area_error));
            conservation.volume = std::max(conservation.volume, std::abs(p.volume_error));
        }
        const DiameterCurve axial = curve_of(result.points, &membrane::StretchPoint::axial_um),
                            transverse = curve_of(result.points, &membrane::StretchPoint::transverse_um);
        const bool alone = run.input.cells.size() == 1;
        const int colour = static_cast<int>(i);
        plot.curves.push_back({.label = alone ? "axial" : run.label(i) + ", axial",
                               .x = axial.force,
                               .y = axial.value,
                               .colour = colour});
        plot.curves.push_back({.label = "transverse",
                               .x = transverse.force,
                               .y = transverse.value,
                               .colour = colour,
                               .dashed = true});
        run.summary.observables[run.prefix(i) + "force_pN"] = result.points.back().force_pN;
        run.summary.observables[run.prefix(i) + "axial_diameter_um"] = result.points.back().axial_um;
        run.summary.observables[run.prefix(i) + "transverse_diameter_um"] =
            result.points.back().transverse_um;
        report_points(run, run.prefix(i), result.points);
        if (!in.experiment.empty()) {
            report_distance(run, run.prefix(i), "axial", distance(axial, experiment.force, experiment.axial));
            report_distance(run, run.prefix(i), "transverse",
                            distance(transverse, experiment.force, experiment.transverse));
        }
        const auto shapes = spread(result.shapes, most_shapes);
        run.gallery({.title = alone ? run.input.title : run.input.title + ": " + run.label(i),
                     .items = shapes,
                     .columns = shapes.size() > 8 ? 7 : 4,
                     .colour = "area_strain",
                     .legend = "area strain"},
                    alone ? "picture_stretch" : fmt::format("picture_stretch_{}", i));
    }
    output::write_table(run.folder.path() / "stretch.csv", table);
    run.plot(plot, "plot_stretch");
}

}  // namespace hemoflux::apps
