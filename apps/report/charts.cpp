#include "apps/report/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "apps/report/quantity_name.hpp"

namespace hemoflux::report {
namespace {

/// Most cells or bodies in one chart.
constexpr std::size_t most_owners = 6;

/// Columns that are shown together.
struct Group {
    std::string key, title, unit;
    std::vector<std::pair<std::string, std::string>> columns;  ///< name without its owner, label
    double least = 0;                                          ///< curves that vary by less are noise
    bool averaged = false, log_y = false;
    std::string replaces = "";
};

const std::vector<Group>& groups() {
    static const std::vector<Group> all{
        {"inclination",
         "Inclination",
         "degrees",
         {{"inclination_deg", ""}},
         1e-6,
         true,
         false,
         "plot_inclination"},
        {"tank_treading", "Tank-treading angle", "degrees", {{"tank_treading_deg", ""}}, 1e-6, true},
        {"deformation", "Taylor deformation", "D", {{"taylor_d", ""}}, 1e-9, true},
        {"diameters",
         "Diameters",
         "\xC2\xB5m",
         {{"axial_um", "axial"}, {"transverse_um", "transverse"}},
         1e-6},
        {"deformation_index", "Deformation index", "%", {{"deformation_index_pct", ""}}, 1e-6, true},
        {"energy", "Energy of the membrane", "aJ", {{"energy_aJ", ""}}, 1e-9},
        {"conservation",
         "Conservation: change since the start",
         "relative change",
         {{"area_error", "area"}, {"volume_error", "volume"}, {"mean_density", "mean density"}},
         1e-13},
        {"position",
         "Position of the centroid",
         "\xC2\xB5m",
         {{"x_um", "x"}, {"y_um", "y"}, {"z_um", "z"}},
         1e-6},
        {"speed", "Mean speed", "\xC2\xB5m/s", {{"cell_speed_um_s", "cells"}, {"flow_speed_um_s", "flow"}}},
        {"force", "Force", "N", {{"force_x_N", "x"}, {"force_y_N", "y"}, {"force_z_N", "z"}}},
        {"torque", "Torque", "N m", {{"torque_x_Nm", "x"}, {"torque_y_Nm", "y"}, {"torque_z_Nm", "z"}}},
        {"angular",
         "Angular velocity",
         "1/s",
         {{"angular_x_1_per_s", "x"}, {"angular_y_1_per_s", "y"}, {"angular_z_1_per_s", "z"}}},
        {"centre",
         "Velocity in the middle",
         "\xC2\xB5m/s",
         {{"centre_exact_um_per_s", "exact"}, {"centre_u_um_per_s", "computed"}},
         0,
         false,
         false,
         "plot_centre"},
        {"residual",
         "Convergence",
         "residual (root mean square)",
         {{"residual", ""},
          {"residual_density", "density"},
          {"residual_u", "u"},
          {"residual_v", "v"},
          {"residual_w", "w"}},
         0,
         false,
         true,
         "plot_convergence"},
        {"measure", "Measure of the steady state", "change", {{"measure", ""}}, 0, false, true}};
    return all;
}

/// Columns without a chart: the axis itself, and what only the program's authors look at.
const std::set<std::string> left_out{"step",   "time_s",  "strain", "dt_s",   "evaluations", "cpu_s",
                                     "krylov", "courant", "axis_x", "axis_y", "axis_z"};

std::string owner_of(const std::string& column) {
    const auto dot = column.rfind('.');
    return dot == std::string::npos ? "" : column.substr(0, dot);
}

std::string bare(const std::string& column) { return column.substr(column.rfind('.') + 1); }

bool is_number(const std::string& text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a curve varies by more than noise.
bool varies(const std::vector<double>& values, double least) {
    double low = INFINITY, high = -INFINITY;
    for (const double v : values)
        if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    return high - low > std::max(least, 1e-9 * std::max(std::abs(low), std::abs(high)));
}

std::optional<output::Reference> reference_of(const RunRecord& run, const std::string& column) {
    if (!run.summary) return {};
    const std::string name = column == "axial_um"        ? "axial_diameter_um"
                             : column == "transverse_um" ? "transverse_diameter_um"
                                                         : column;
    const auto found = run.summary->references.find(name);
    return found == run.summary->references.end() ? std::nullopt : std::optional(found->second);
}

void add_reference(const RunRecord& run, const std::string& column, output::PlotSpec& plot) {
    const auto r = reference_of(run, column);
    if (!r) return;
    if (r->low && r->high && *r->low < *r->high) plot.bands.push_back({"accepted", *r->low, *r->high});
    if (r->reference) plot.bands.push_back({"reference", *r->reference, *r->reference});
}

/// The part of the strain over which the observables of a coupled run are averaged.
std::optional<std::array<double, 2>> window_of(const RunRecord& run, double last) {
    if (run.kind != "coupled" || !run.summary) return {};
    if (const auto* given = run.input.at_path("output.window_strain").as_array();
        given && given->size() == 2) {
        const auto from = given->get(0)->value<double>(), to = given->get(1)->value<double>();
        if (from && to) return std::array{*from, *to};
    }
    return std::array{0.4 * last, last};
}

class HistoryCharts {
  public:
    explicit HistoryCharts(const RunRecord& run) : run_(run), history_(*run.table("history.csv")) {
        for (const auto& [name, label] :
             {std::pair{"strain", "strain G t"}, {"time_s", "time, s"}, {"step", "iteration"}})
            if (std::find(history_.columns.begin(), history_.columns.end(), name) != history_.columns.end()) {
                x_ = history_.column(name);
                x_label_ = label;
                break;
            }
        for (const std::string& column : history_.columns)
            if (!left_out.contains(bare(column))) open_.push_back(column);
    }

    std::vector<Chart> draw() {
        for (const Group& group : groups()) add(group);
        while (!open_.empty()) {
            const std::string name = bare(open_.front());
            const QuantityName words = quantity_name(name);
            add({name, words.text, words.unit, {{name, ""}}});
        }
        return std::move(charts_);
    }

  private:
    /// Draws the columns of a group and strikes them off the open ones.
    void add(const Group& group) {
        Chart chart{.key = group.key,
                    .plot = {.title = group.title, .x_label = x_label_, .y_label = group.unit, .curves = {}}};
        chart.plot.log_y = group.log_y;
        chart.replaces = group.replaces;
        std::size_t hidden = 0;
        for (const auto& [name, label] : group.columns) {
            std::vector<std::string> columns;
            std::copy_if(open_.begin(), open_.end(), std::back_inserter(columns),
                         [&](const std::string& column) { return bare(column) == name; });
            std::erase_if(open_, [&](const std::string& column) { return bare(column) == name; });
            hidden = std::max(hidden, columns.size() > most_owners ? columns.size() - most_owners : 0);
            columns.resize(std::min(columns.size(), most_owners));
            for (std::size_t i = 0; i < columns.size(); ++i)
                add_curve(chart, group, columns[i], label, i, columns.size());
            if (!columns.empty()) add_reference(run_, name, chart.plot);
        }
        // in a run that marches in time the residual says nothing about its end
        if (!has_data(chart) || (group.key == "residual" && run_.kind == "coupled")) return;
        if (hidden > 0)
            chart.note = fmt::format("The first {} of {} are shown.", most_owners, most_owners + hidden);
        if (group.averaged && x_label_.starts_with("strain") && !x_.empty())
            chart.window = window_of(run_, x_.back());
        charts_.push_back(std::move(chart));
    }

    void add_curve(Chart& chart, const Group& group, const std::string& column, const std::string& label,
                   std::size_t owner, std::size_t owners) {
        std::vector<double> y = history_.column(column);
        if (column == "mean_density" && !y.empty())
            for (const double first = y.front(); double& v : y) v = v / first - 1;
        if (!varies(y, group.least)) return;
        std::string name = owner_of(column);
        if (is_number(name)) name.insert(0, "cell ");
        if (owners < 2) name.clear();
        output::Curve curve{.label = name.empty()    ? label
                                     : label.empty() ? name
                                                     : name + ", " + label,
                            .x = x_,
                            .y = y};
        // one colour for each cell, broken lines for a second quantity; with one cell a colour for each quantity
        if (owners > 1) {
            curve.colour = static_cast<int>(owner);
            curve.dashed = label != group.columns.front().second;
        }
        chart.plot.curves.push_back(std::move(curve));
    }

    const RunRecord& run_;
    const output::Table& history_;
    std::vector<double> x_;
    std::string x_label_ = "row";
    std::vector<std::string> open_;
    std::vector<Chart> charts_;
};

}  // namespace

std::vector<Chart> history_charts(const RunRecord& run) {
    const output::Table* history = run.table("history.csv");
    return history && history->rows.size() > 1 ? HistoryCharts(run).draw() : std::vector<Chart>{};
}

RunCharts charts_of(const RunRecord& run) {
    RunCharts out{table_charts(run), {}};
    for (Chart& chart : history_charts(run)) out.charts.push_back(std::move(chart));
    for (const std::filesystem::path& plot : run.plots)
        if (std::none_of(out.charts.begin(), out.charts.end(),
                         [&](const Chart& c) { return c.replaces == plot.stem().string(); }))
            out.plots.push_back(plot);
    return out;
}

}  // namespace hemoflux::report
