// K_S and c0 of the cell whose stretch curve is nearest to a measured one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/cell_builder.hpp"
#include "apps/cell_surface.hpp"
#include "apps/membrane_task.hpp"
#include "apps/output/history.hpp"
#include "apps/tweezers.hpp"
#include "membrane/fit.hpp"
#include "membrane/stretch.hpp"

namespace hemoflux::apps {
namespace {

constexpr double micronewton = 1e-6;  // N/m

/// Half the error bar of a measured diameter, um; 1 where it has none.
double deviation(const Experiment::Diameter& d, std::size_t i) {
    return d.low.empty() || d.high.empty() ? 1 : (d.high[i] - d.low[i]) / 2;
}

/// Diameters of the cell with these values at the forces of the experiment.
std::vector<membrane::StretchPoint> curve(const MembraneRun& run, const std::vector<double>& parameters,
                                          const std::vector<double>& forces) {
    CellInput cell = run.input.cells.front();
    cell.shear_modulus = parameters[0] * micronewton;
    cell.spontaneous_curvature = parameters[1];
    const membrane::Cell built = build_cell(cell, run.relaxation);
    membrane::Batch batch(built.topology, built.parameters, built.reference);
    batch.set_positions(0, built.positions);
    return membrane::stretch(batch, forces, run.relaxation, run.input.membrane.grip);
}

std::vector<double> residuals(const std::vector<membrane::StretchPoint>& points, const Experiment& e) {
    std::vector<double> r;
    for (std::size_t i = 0; i < points.size(); ++i) {
        r.push_back((points[i].axial_um - e.axial.value[i]) / deviation(e.axial, i));
        r.push_back((points[i].transverse_um - e.transverse.value[i]) / deviation(e.transverse, i));
    }
    return r;
}

void report(MembraneRun& run, const membrane::FitResult& fit) {
    const char* names[] = {"shear_modulus_uN_per_m", "spontaneous_curvature"};
    std::string text =
        "optimum, with standard errors from the error bars and from the scatter, 95 % interval";
    for (std::size_t i = 0; i < 2; ++i) {
        run.summary.observables[names[i]] = fit.parameters[i];
        run.summary.observables[std::string(names[i]) + "_error_bars"] = fit.by_weights[i];
        run.summary.observables[std::string(names[i]) + "_error_scatter"] = fit.by_scatter[i];
        run.summary.observables[std::string(names[i]) + "_half_95"] = fit.half_95[i];
        text += fmt::format("\n  {:<24}{:>9.4g}  +- {:.3g}  +- {:.3g}  {:.4g} .. {:.4g}{}", names[i],
                            fit.parameters[i], fit.by_weights[i], fit.by_scatter[i],
                            fit.parameters[i] - fit.half_95[i], fit.parameters[i] + fit.half_95[i],
                            fit.at_bound[i] ? "  (at its bound)" : "");
    }
    run.summary.observables["correlation"] = fit.correlation;
    run.summary.observables["chi2"] = fit.chi2;
    run.summary.observables["chi2_per_degree_of_freedom"] =
        fit.chi2 / static_cast<double>(fit.residuals.size() - 2);
    text += fmt::format("\n  chi2 {:.4g} of {} diameters, correlation {:.2f}, {} curves computed", fit.chi2,
                        fit.residuals.size(), fit.correlation, fit.evaluations);
    run.log.info(text);
}

}  // namespace

void run_calibration(MembraneRun& run) {
    const MembraneInput& in = run.input.membrane;
    const CellInput& cell = run.input.cells.front();
    const Experiment e = read_experiment(in.experiment);
    const double low = in.shear_bounds[0] / micronewton, high = in.shear_bounds[1] / micronewton;
    const std::vector<membrane::FitParameter> parameters{
        {.start = cell.shear_modulus / micronewton,
         .low = low,
         .high = high,
         .step = 0.01 * (low + high) / 2},
        {.start = rest_state(cell).reduced_curvature,
         .low = in.curvature_bounds[0],
         .high = in.curvature_bounds[1],
         .step = 0.02 * (in.curvature_bounds[1] - in.curvature_bounds[0])}};
    output::Table trials{{"shear_modulus_uN_per_m", "spontaneous_curvature", "chi2"}, {}};
    const membrane::FitResult fit = membrane::fit(parameters, [&](const std::vector<double>& p) {
        const auto r = residuals(curve(run, p, e.force), e);
        double chi2 = 0;
        for (const double value : r) chi2 += value * value;
        trials.rows.push_back({p[0], p[1], chi2});
        run.log.detail(fmt::format("K_S {:.6g} uN/m, c0 {:.6g}: chi2 {:.8g}", p[0], p[1], chi2));
        return r;
    });
    report(run, fit);
    output::write_table(run.folder.path() / "calibration.csv", trials);

    const auto best = curve(run, fit.parameters, e.force);
    DiameterCurve axial, transverse;
    for (const auto& p : best) {
        axial.force.push_back(p.force_pN);
        axial.value.push_back(p.axial_um);
        transverse.force.push_back(p.force_pN);
        transverse.value.push_back(p.transverse_um);
    }
    run.summary.observables["axial_rms_um"] = distance(axial, e.force, e.axial).rms_um;
    run.summary.observables["transverse_rms_um"] = distance(transverse, e.force, e.transverse).rms_um;
    run.summary.observables["axial_inside_bars"] = distance(axial, e.force, e.axial).inside;
    run.summary.observables["transverse_inside_bars"] = distance(transverse, e.force, e.transverse).inside;
    run.plot({.title = fmt::format("{}: K_S = {:.3g} \xC2\xB5N/m, c0 = {:.3g}", run.input.title,
                                   fit.parameters[0], fit.parameters[1]),
              .x_label = "pulling force, pN",
              .y_label = "diameter, \xC2\xB5m",
              .curves = {measured_curve("measured", e.force, e.axial),
                         measured_curve("", e.force, e.transverse),
                         {.label = "axial", .x = axial.force, .y = axial.value, .colour = 0},
                         {.label = "transverse", .x = transverse.force, .y = transverse.value, .colour = 1}}},
             "plot_calibration");
}

}  // namespace hemoflux::apps
