#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/output/reference_table.hpp"
#include "apps/report/charts.hpp"
#include "apps/report/quantity_name.hpp"
#include "apps/tweezers.hpp"

namespace hemoflux::report {
namespace fs = std::filesystem;
namespace {

using output::Curve;

/// A chart of some columns of a table against another.
Chart chart_of(const output::Table& table, const std::string& key, const std::string& title,
               const std::string& x, const std::string& x_label, const std::string& y_label,
               const std::vector<std::pair<std::string, std::string>>& columns) {
    Chart chart{.key = key, .plot = {.title = title, .x_label = x_label, .y_label = y_label, .curves = {}}};
    for (const auto& [name, label] : columns)
        chart.plot.curves.push_back({.label = label, .x = table.column(x), .y = table.column(name)});
    return chart;
}

/// Diameters of every cell against the pulling force, with measured points.
void add_stretch(const RunRecord& run, std::vector<Chart>& charts) {
    const output::Table* table = run.table("stretch.csv");
    if (table == nullptr) return;
    Chart chart{.key = "stretch",
                .plot = {.title = "Stretched diameters",
                         .x_label = "pulling force, pN",
                         .y_label = "diameter, \xC2\xB5m",
                         .curves = {}}};
    chart.replaces = "plot_stretch";
    const auto cell = table->column("cell"), force = table->column("force_pN"),
               axial = table->column("axial_um"), transverse = table->column("transverse_um");
    const std::set<double> cells(cell.begin(), cell.end());
    for (const double c : cells) {
        std::vector<std::array<double, 3>> rows;
        for (std::size_t i = 0; i < cell.size(); ++i)
            if (cell[i] == c) rows.push_back({force[i], axial[i], transverse[i]});
        std::sort(rows.begin(), rows.end());
        const std::string name = run.text(fmt::format("cell[{}].name", static_cast<int>(c)));
        const std::string before = cells.size() < 2 ? ""
                                   : name.empty()   ? fmt::format("cell {}, ", c)
                                                    : name + ", ";
        for (const std::size_t d : {1U, 2U}) {
            Curve curve{.label = before + (d == 1 ? "axial" : "transverse"), .x = {}, .y = {}};
            curve.colour = static_cast<int>(c);
            curve.dashed = d == 2;
            for (const auto& row : rows) {
                curve.x.push_back(row[0]);
                curve.y.push_back(row[d]);
            }
            chart.plot.curves.push_back(std::move(curve));
        }
    }
    const fs::path file = run.text("membrane.experiment");
    if (!file.empty() && fs::exists(file)) {
        const apps::Experiment measured = apps::read_experiment(file);
        for (const auto* diameter : {&measured.axial, &measured.transverse}) {
            Curve points = apps::measured_curve(diameter == &measured.axial ? "measured" : "", measured.force,
                                                *diameter);
            points.colour = 6;
            chart.plot.curves.push_back(std::move(points));
        }
    } else if (!file.empty()) {
        chart.note = "The file of the measurements is no longer there.";
    }
    charts.push_back(std::move(chart));
}

/// Points of the profiles that the case compares a centreline with; nothing where a file is gone.
void add_profiles(const RunRecord& run, const std::string& field, const std::string& along, Chart& chart) {
    const toml::array* profiles = run.input.get("profile") ? run.input.get("profile")->as_array() : nullptr;
    for (std::size_t i = 0; profiles && i < profiles->size(); ++i) {
        const auto text = [&](const std::string& key) {
            return run.text(fmt::format("profile[{}].{}", i, key));
        };
        if (text("field") != field || text("along") != along || text("through") != "auto") continue;
        if (!fs::exists(text("file"))) {
            chart.note = "The file of a reference profile is no longer there.";
            continue;
        }
        output::ReferenceTable table = output::read_reference_table(text("file"));
        if (!text("rows[0]").empty()) table = table.where(text("rows[0]"), text("rows[1]"));
        Curve points{.label = text("label"),
                     .x = table.numbers(text("columns[0]")),
                     .y = table.numbers(text("columns[1]")),
                     .points = true};
        chart.plot.curves.push_back(std::move(points));
    }
}

void add_centrelines(const RunRecord& run, std::vector<Chart>& charts) {
    for (const auto& [field, along] : {std::pair{"u", "y"}, {"v", "x"}}) {
        const output::Table* table = run.table(fmt::format("centreline_{}.csv", field));
        if (table == nullptr) continue;
        Chart chart = chart_of(
            *table, fmt::format("centreline_{}", field), fmt::format("{} on the centreline", field), along,
            fmt::format("{} / L", along), fmt::format("{} / U", field), {{field, "this run"}});
        add_profiles(run, field, along, chart);
        chart.replaces = fmt::format("plot_profile_{}_{}", field, along);
        charts.push_back(std::move(chart));
    }
}

/// Computed and exact profiles, profile_u_along_y.csv.
void add_exact_profiles(const RunRecord& run, std::vector<Chart>& charts) {
    for (const auto& [file, table] : run.tables) {
        if (!file.starts_with("profile_")) continue;
        const std::string stem = file.substr(8, file.size() - 12);
        std::string words = stem;
        std::replace(words.begin(), words.end(), '_', ' ');
        const std::string x = table.columns.front();
        Chart chart{.key = "profile_" + stem,
                    .plot = {.title = words,
                             .x_label = quantity_name(x).with_unit(),
                             .y_label = "\xC2\xB5m/s",
                             .curves = {}}};
        chart.replaces = "plot_" + stem;
        for (std::size_t c = 1; c < table.columns.size(); ++c) {
            const std::string& name = table.columns[c];
            const auto at = name.find(" at ");
            const bool exact = name.starts_with("exact");
            Curve curve{.label = (exact ? "exact" : "computed") +
                                 (at == std::string::npos ? std::string() : ", t = " + name.substr(at + 4)),
                        .x = table.column(x),
                        .y = table.column(name)};
            curve.points = !exact;
            curve.colour = static_cast<int>((c - 1) / 2);
            chart.plot.curves.push_back(std::move(curve));
        }
        charts.push_back(std::move(chart));
    }
}

void add_wall(const RunRecord& run, std::vector<Chart>& charts) {
    const output::Table* wall = run.table("wall.csv");
    if (wall == nullptr) return;
    for (const auto& [name, title] : {std::pair{"pressure_coefficient", "Pressure coefficient on the body"},
                                      {"friction_coefficient", "Friction coefficient on the body"}}) {
        Chart chart =
            chart_of(*wall, name, title, "angle_deg", "angle from the rear, degrees", "", {{name, ""}});
        chart.replaces = fmt::format("plot_{}", name);
        charts.push_back(std::move(chart));
    }
}

void add_plain_tables(const RunRecord& run, std::vector<Chart>& charts) {
    if (const output::Table* table = run.table("errors.csv")) {
        charts.push_back(chart_of(*table, "errors", "Error against the exact solution", "time_s", "time, s",
                                  "relative error",
                                  {{"relative", "L2"}, {"largest", "largest"}, {"density", "density"}}));
        charts.back().plot.log_y = true;
    }
    if (const output::Table* table = run.table("thickness.csv"))
        charts.push_back(chart_of(*table, "thickness", "Thickness of the disc", "radius_um",
                                  "radius, \xC2\xB5m", "thickness, \xC2\xB5m",
                                  {{"mean_um", "mean"}, {"least_um", "least"}, {"greatest_um", "greatest"}}));
    const bool drawn = std::any_of(run.plots.begin(), run.plots.end(),
                                   [](const fs::path& plot) { return plot.stem() == "plot_recovery"; });
    if (const output::Table* table = run.table("recovery.csv"); table && !drawn)
        charts.push_back(chart_of(*table, "recovery", "Recovery", "time_s", "time, s", "length / width",
                                  {{"length_over_width", ""}}));
}

/// Observables of a sweep: those with a fitted order, with logarithmic axes; without any the first few.
void add_sweep(const RunRecord& run, std::vector<Chart>& charts) {
    if (!run.sweep || run.sweep->rows.empty()) return;
    const SweepTable& table = *run.sweep;
    const bool plotted = std::any_of(run.plots.begin(), run.plots.end(),
                                     [](const fs::path& plot) { return plot.stem() == "plot_sweep"; });
    const auto ordered = [&](const std::string& name) {
        return run.summary && (run.summary->observables.contains("order_" + name) ||
                               run.summary->observables.contains("limit_" + name));
    };
    const bool any_order = std::any_of(table.columns.begin(), table.columns.end(), ordered);
    constexpr std::size_t most = 6;
    const std::string x_label =
        (table.rows.front().front().starts_with('[') ? "largest of " : "") + table.columns.front();
    for (std::size_t c = table.keys; c < table.columns.size() && charts.size() < most; ++c) {
        const std::string& name = table.columns[c];
        if (name == "wall_s" || name == "cpu_s" || (any_order || plotted ? !ordered(name) : false)) continue;
        const QuantityName words = quantity_name(name);
        Chart chart{
            .key = "sweep_" + name,
            .plot = {.title = words.text, .x_label = x_label, .y_label = words.with_unit(), .curves = {}}};
        chart.plot.log_x = chart.plot.log_y = ordered(name);
        const auto x = table.abscissas(), y = table.numbers(c);
        chart.plot.curves.push_back({.label = "", .x = x, .y = y, .colour = 0});
        chart.plot.curves.push_back({.label = "", .x = x, .y = y, .points = true, .colour = 0});
        charts.push_back(std::move(chart));
    }
}

}  // namespace

std::vector<Chart> table_charts(const RunRecord& run) {
    std::vector<Chart> charts;
    add_stretch(run, charts);
    add_centrelines(run, charts);
    add_exact_profiles(run, charts);
    add_wall(run, charts);
    add_plain_tables(run, charts);
    add_sweep(run, charts);
    std::erase_if(charts, [](const Chart& chart) { return !has_data(chart); });
    return charts;
}

}  // namespace hemoflux::report
