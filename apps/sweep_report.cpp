#include "apps/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "apps/extrapolation.hpp"
#include "apps/output/atomic_file.hpp"
#include "apps/output/history.hpp"
#include "apps/output/plot.hpp"
#include "apps/output/summary.hpp"
#include "apps/run_files.hpp"
#include "apps/units.hpp"

namespace hemoflux::apps {
namespace {

std::string bare(const std::string& text) {
    const bool quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'');
    return quoted ? text.substr(1, text.size() - 2) : text;
}

/// The unit behind the number of a quantity, "" when there is none.
std::string unit_of(const std::string& text) {
    char* end = nullptr;
    static_cast<void>(std::strtod(text.c_str(), &end));
    std::string unit(end);
    unit.erase(0, unit.find_first_not_of(' '));
    return unit;
}

/// Runs that differ in the first key only.
struct Series {
    std::string name;  ///< values of the other keys, "" when there is one series
    std::vector<std::size_t> runs;
};

std::vector<Series> series_of(const SweepResults& r) {
    if (!r.sweep.product || r.sweep.keys.size() < 2) {
        Series all;
        for (std::size_t i = 0; i < r.points.size(); ++i) all.runs.push_back(i);
        return {all};
    }
    const std::size_t length = r.sweep.values.front().size();
    std::vector<Series> out;
    for (std::size_t i = 0; i < r.points.size(); ++i) {
        if (i % length == 0) {
            std::string name;
            for (std::size_t k = 1; k < r.sweep.keys.size(); ++k)
                name += fmt::format("{}{}={}", k > 1 ? ", " : "", r.sweep.keys[k], bare(r.points[i][k]));
            out.push_back({name, {}});
        }
        out.back().runs.push_back(i);
    }
    return out;
}

double observed(const std::map<std::string, double>& row, const std::string& name) {
    const auto found = row.find(name);
    return found == row.end() ? NAN : found->second;
}

std::vector<double> column(const SweepResults& r, const Series& series, const std::string& name) {
    std::vector<double> values;
    for (const std::size_t run : series.runs) values.push_back(observed(r.rows[run], name));
    return values;
}

std::vector<double> abscissas(const SweepResults& r, const Series& series) {
    std::vector<double> values;
    for (const std::size_t run : series.runs)
        values.push_back(abscissa(r.points[run].front(), r.sweep.values.front().front()));
    const bool words = std::any_of(values.begin(), values.end(), [](double x) { return !std::isfinite(x); });
    for (std::size_t i = 0; words && i < values.size(); ++i) values[i] = static_cast<double>(i);
    return values;
}

/// All observables that any run has, in alphabetical order.
std::vector<std::string> names_of(const SweepResults& r) {
    std::set<std::string> names;
    for (const auto& row : r.rows)
        for (const auto& [name, value] : row) names.insert(name);
    for (const auto& row : r.labels)
        for (const auto& [name, text] : row) names.insert(name);
    return {names.begin(), names.end()};
}

/// What run i has under a name: a label, or a number in this format.
std::string entry(const SweepResults& r, std::size_t i, const std::string& name, const char* format) {
    if (i < r.labels.size())
        if (const auto label = r.labels[i].find(name); label != r.labels[i].end()) return label->second;
    return fmt::format(fmt::runtime(format), observed(r.rows[i], name));
}

/// A text as a cell of a table: quoted where it holds a comma or quotes, which are doubled (RFC 4180).
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
    return cell + "\"";
}

std::string csv(const SweepResults& r, const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& key : r.sweep.keys) text += key + ",";
    text += fmt::format("{}\n", fmt::join(names, ","));
    for (std::size_t i = 0; i < r.points.size(); ++i) {
        for (const std::string& value : r.points[i]) {
            text += csv_cell(bare(value)) + ",";
        }
        for (std::size_t n = 0; n < names.size(); ++n)
            text += entry(r, i, names[n], "{}") + (n + 1 < names.size() ? "," : "\n");
    }
    return text;
}

std::string printed(const SweepResults& r, const std::vector<std::string>& names) {
    std::vector<std::vector<std::string>> cells(r.points.size() + 1);
    for (const std::string& key : r.sweep.keys) cells[0].push_back(key);
    cells[0].insert(cells[0].end(), names.begin(), names.end());
    for (std::size_t i = 0; i < r.points.size(); ++i) {
        for (const std::string& value : r.points[i]) cells[i + 1].push_back(bare(value));
        for (const std::string& name : names) cells[i + 1].push_back(entry(r, i, name, "{:.6g}"));
    }
    std::vector<std::size_t> width(cells[0].size(), 0);
    for (const auto& row : cells)
        for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
    std::string text;
    for (const auto& row : cells) {
        for (std::size_t c = 0; c < row.size(); ++c) text += fmt::format("{:>{}}  ", row[c], width[c]);
        text += '\n';
    }
    return text;
}

}  // namespace

double abscissa(const std::string& value, const std::string& first) {
    if (!value.empty() && value.front() == '[') {
        double largest = NAN;
        std::string rest = value.substr(1, value.size() - 2);
        while (!rest.empty()) {
            const auto comma = std::min(rest.find(','), rest.size());
            std::string item = rest.substr(0, comma);
            item.erase(0, item.find_first_not_of(' '));
            const double x = abscissa(item, item);
            if (!(x <= largest)) largest = x;
            rest.erase(0, comma + 1);
        }
        return largest;
    }
    const std::string text = bare(value), unit = unit_of(bare(first));
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (end == text.c_str()) return NAN;
    return unit.empty() ? number : quantity(text, unit);
}

double fitted_order(const std::vector<double>& x, const std::vector<double>& y) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0 && y[i] > 0)) continue;
        const double lx = std::log(x[i]), ly = std::log(y[i]);
        n += 1, sx += lx, sy += ly, sxx += lx * lx, sxy += lx * ly;
    }
    return n < 2 ? NAN : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

std::map<std::string, double> sweep_orders(const SweepResults& r) {
    std::map<std::string, double> orders;
    const bool counted = r.sweep.keys.front().ends_with("cells");
    for (const Series& s : series_of(r)) {
        const std::string behind = s.name.empty() ? "" : " " + s.name;
        std::vector<double> x = abscissas(r, s);
        if (const auto& range = r.sweep.order_range)
            for (double& one : x)
                if (one < (*range)[0] || one > (*range)[1]) one = NAN;
        if (counted)
            for (double& one : x) one = 1 / one;
        for (const std::string& name : r.sweep.order)
            orders["order_" + name + behind] = fitted_order(x, column(r, s, name));
        for (const std::string& name : r.sweep.extrapolate) {
            const Extrapolation fit = extrapolate(x, column(r, s, name));
            orders["limit_" + name + behind] = fit.limit;
            orders["order_" + name + behind] = fit.order;
        }
    }
    return orders;
}

void report(const Case& base, const SweepResults& r, const RunOptions& options) {
    const std::vector<std::string> names = names_of(r);
    output::write_file(options.output / "sweep.csv", csv(r, names));
    output::Summary summary = start_summary(base);
    summary.references.clear();
    for (const ReferenceInput& one : base.references)
        if (of_sweep(one)) summary.references[one.observable] = {one.value, one.low, one.high, one.source};
    summary.observables = sweep_orders(r);
    summary.performance.wall_s = summary.performance.cpu_s = 0;
    for (const auto& row : r.rows) {
        if (row.empty()) continue;
        summary.performance.wall_s += row.at("wall_s");
        summary.performance.cpu_s += row.at("cpu_s");
    }
    output::write_summary(options.output / "summary.json", summary);

    const std::vector<std::string>& shown = r.sweep.observables.empty() ? names : r.sweep.observables;
    std::string message;
    if (base.output.pictures) {
        output::PlotSpec plot{
            .title = base.title, .x_label = r.sweep.keys.front(), .y_label = "", .curves = {}};
        plot.log_x = r.sweep.log_x;
        plot.log_y = r.sweep.log_y;
        for (const std::string& name : shown)
            for (const Series& s : series_of(r)) {
                const std::vector<double> values = column(r, s, name);
                if (std::none_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
                    continue;
                const std::string text = s.name.empty() ? name : name + ", " + s.name;
                plot.curves.push_back({.label = text, .x = abscissas(r, s), .y = values});
                plot.curves.push_back({.label = "", .x = abscissas(r, s), .y = values, .points = true});
            }
        for (const MeasuredInput& m : r.sweep.measured) {
            const output::Table table = output::read_table(m.file);
            plot.curves.push_back({.label = m.label,
                                   .x = table.column(m.x),
                                   .y = table.column(m.y),
                                   .points = true,
                                   .dashed = true});
        }
        if (const auto failed = output::plot(plot, options.output / "plot_sweep")) message = *failed;
    }
    if (options.quiet) return;
    fmt::print("{}{}{}\n", printed(r, shown), output::to_table(summary), closing_line(options.output));
    if (!message.empty()) fmt::print(stderr, "warning: {}\n", message);
}

}  // namespace hemoflux::apps
