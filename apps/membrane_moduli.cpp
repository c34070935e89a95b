// Moduli of a flat sheet, measured under every in-plane law.
#include <fmt/format.h>

#include <cmath>

#include "apps/cell_builder.hpp"
#include "apps/membrane_task.hpp"
#include "apps/output/history.hpp"
#include "membrane/sheet.hpp"

namespace hemoflux::apps {
namespace {

constexpr const char* law_names[] = {"wlc", "wlc-power", "wlc-hydrostatic", "neo-hookean", "skalak"};
constexpr int rings = 4;
constexpr double edge = 0.25;  // um

/// Energy per rest area of the sheet, 1e-5 N/m, stretched along x and y; infinite beyond the springs' end.
class Sheet {
  public:
    Sheet(const membrane::Parameters& parameters, double ratio)
        : batch_(membrane::flat_sheet(parameters, rings, edge, ratio)), rest_(batch_.positions(0)) {
        batch_.compute_forces();
        area_ = batch_.sums(0).area;
    }
    double energy(double x, double y) {
        auto moved = rest_;
        for (Vec3d& r : moved) r = {x * r.x, y * r.y, r.z};
        batch_.set_positions(0, moved);
        return batch_.try_compute_forces() ? batch_.energies(0).total() / area_ : INFINITY;
    }
    /// The lateral stretch that costs least, by golden section.
    double lateral(double x) {
        const double golden = (std::sqrt(5.0) - 1) / 2;
        double low = 0.3, high = 1.3;
        for (int i = 0; i < 60; ++i) {
            const double a = high - golden * (high - low), b = low + golden * (high - low);
            (energy(x, a) < energy(x, b) ? high : low) = energy(x, a) < energy(x, b) ? b : a;
        }
        return (low + high) / 2;
    }
    /// Tension along x per rest width of a strip whose sides are free, 1e-5 N/m.
    double tension(double x) {
        constexpr double h = 1e-4;
        const double y = lateral(x);  // at the minimum over y, dE/dx is the partial derivative
        return (energy(x + h, y) - energy(x - h, y)) / (2 * h);
    }

  private:
    membrane::Batch batch_;
    std::vector<Vec3d> rest_;
    double area_ = 0;
};

void report(MembraneRun& run, const std::string& law, const membrane::SheetModuli& measured,
            const membrane::SheetModuli& exact) {
    const auto put = [&](const char* name, double value, double reference) {
        run.summary.observables[law + "." + name] = value;
        run.summary.references[law + "." + name] = {reference, {}, {}, "closed form"};
    };
    put("shear_modulus_uN_per_m", measured.shear * micronewton_per_unit, exact.shear * micronewton_per_unit);
    put("area_modulus_uN_per_m", measured.area * micronewton_per_unit, exact.area * micronewton_per_unit);
    put("young_modulus_uN_per_m", measured.young * micronewton_per_unit, exact.young * micronewton_per_unit);
    put("poisson_ratio", measured.poisson, exact.poisson);
}

}  // namespace

void run_moduli(MembraneRun& run) {
    const CellInput& cell = run.input.cells.front();
    const double ratio = cell.spring_ratio.value_or(membrane::red_blood_cell::stretch_ratio);
    output::Table table{{"law", "shear_uN_per_m", "area_uN_per_m", "young_uN_per_m", "poisson", "exact_shear",
                         "exact_area", "exact_young", "exact_poisson"},
                        {}};
    output::PlotSpec plot{.title = run.input.title + ": a strip with free sides",
                          .x_label = "stretch",
                          .y_label = "tension, \xC2\xB5N/m",
                          .curves = {}};
    std::string text = fmt::format("{:<16}{:>10} {:>10} {:>10} {:>8}   (uN/m; closed form behind)", "law",
                                   "shear", "area", "Young", "Poisson");
    for (std::size_t law = 0; law < std::size(law_names); ++law) {
        membrane::Parameters p = membrane_parameters(cell);
        p.network.law = static_cast<membrane::InPlaneLaw>(law);
        const membrane::SheetModuli m = membrane::measured_moduli(p, rings, edge, ratio),
                                    e = membrane::sheet_moduli(p);
        const double u = micronewton_per_unit;
        table.rows.push_back({static_cast<double>(law), m.shear * u, m.area * u, m.young * u, m.poisson,
                              e.shear * u, e.area * u, e.young * u, e.poisson});
        report(run, law_names[law], m, e);
        text += fmt::format("\n{:<16}{:>10.5g} {:>10.5g} {:>10.5g} {:>8.5f}", law_names[law], m.shear * u,
                            m.area * u, m.young * u, m.poisson);
        text +=
            fmt::format("   {:.5g} {:.5g} {:.5g} {:.5f}", e.shear * u, e.area * u, e.young * u, e.poisson);
        Sheet sheet(p, ratio);
        output::Curve& curve =
            plot.curves.emplace_back(output::Curve{.label = law_names[law], .x = {}, .y = {}});
        for (int i = 0; i <= 50; ++i) {
            curve.x.push_back(1 + 0.02 * i);
            curve.y.push_back(sheet.tension(curve.x.back()) * u);
        }
    }
    output::write_table(run.folder.path() / "moduli.csv", table);
    run.log.info(text);
    run.plot(plot, "plot_moduli");
}

}  // namespace hemoflux::apps
