#include "apps/report/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "apps/report/html.hpp"
#include "apps/report/quantity_name.hpp"
#include "apps/report/results.hpp"

namespace hemoflux::report {
namespace {

/// One row over all runs: a dash where a run has nothing.
std::string row(const std::string& heading, const std::string& key, const std::vector<RunRecord>& runs,
                const std::function<std::string(const output::Summary&)>& value) {
    std::string text =
        fmt::format("<tr><th scope=\"row\" data-observable=\"{}\">{}</th>", escape(key), escape(heading));
    for (const RunRecord& run : runs)
        text += "<td>" + (run.summary ? value(*run.summary) : number(NAN)) + "</td>";
    return text + "</tr>\n";
}

std::string observed(const output::Summary& summary, const std::string& name) {
    const auto found = summary.observables.find(name);
    const double value = found == summary.observables.end() ? NAN : found->second;
    if (name == "converged" && std::isfinite(value)) return value == 1 ? "yes" : "no";
    std::string text = number(value);
    for (const auto& c : output::compare(summary))
        if (c.name == name && c.verdict != output::Comparison::Verdict::reported)
            text += "<br>" + verdict(c.verdict);
    return text;
}

/// Whether the curves of two charts share their axes.
bool alike(const Chart& a, const Chart& b) {
    return a.key == b.key && a.plot.x_label == b.plot.x_label && a.plot.y_label == b.plot.y_label;
}

void lay_over(Chart& chart, const Chart& more, const std::string& run, std::size_t index) {
    for (output::Curve curve : more.plot.curves) {
        const bool measured = curve.points && index > 0;
        // references are the same for all runs
        if (measured &&
            std::any_of(chart.plot.curves.begin(), chart.plot.curves.end(),
                        [&](const output::Curve& c) { return c.points && c.x == curve.x && c.y == curve.y; }))
            continue;
        if (!curve.points) {
            const bool plain = curve.label.empty() || curve.label == "this run";
            curve.label = plain ? run : run + ": " + curve.label;
            const bool second = std::count_if(more.plot.curves.begin(), more.plot.curves.end(),
                                              [](const output::Curve& c) { return !c.points; }) > 1 &&
                                curve.label != run + ": " + more.plot.curves.front().label;
            curve.dashed = curve.dashed || second;
            curve.colour = static_cast<int>(index);
        }
        chart.plot.curves.push_back(std::move(curve));
    }
    for (const output::Band& band : more.plot.bands)
        if (std::none_of(chart.plot.bands.begin(), chart.plot.bands.end(), [&](const output::Band& known) {
                return known.low == band.low && known.high == band.high;
            }))
            chart.plot.bands.push_back(band);
    if (chart.note.empty()) chart.note = more.note;
}

}  // namespace

std::string comparison_table(const std::vector<RunRecord>& runs) {
    std::set<std::string> referenced, observables, labels, errors;
    for (const RunRecord& run : runs) {
        if (!run.summary) continue;
        for (const auto& [name, value] : run.summary->observables) observables.insert(name);
        for (const auto& [name, reference] : run.summary->references) referenced.insert(name);
        for (const auto& [name, text] : run.summary->labels) labels.insert(name);
        for (const auto& [name, value] : run.summary->errors_estimated) errors.insert(name);
    }
    std::string text =
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Comparison\">"
        "<table class=\"grid compare\"><thead><tr><th scope=\"col\"></th>";
    for (std::size_t i = 0; i < runs.size(); ++i)
        text += fmt::format("<th scope=\"col\"><a href=\"#run-{}\">{}</a></th>", i, escape(runs[i].name));
    text += "</tr></thead><tbody>\n<tr><th scope=\"row\">Status</th>";
    for (const RunRecord& run : runs) text += "<td>" + escape(run.status.word) + "</td>";
    text += "</tr>\n";
    for (const std::string& name : labels)
        text += row(quantity_name(name).text, name, runs, [&](const output::Summary& s) {
            const auto found = s.labels.find(name);
            return found == s.labels.end() ? number(NAN) : escape(found->second);
        });
    for (const std::string& name : referenced) observables.erase(name);
    std::vector<std::string> names(referenced.begin(), referenced.end());
    names.insert(names.end(), observables.begin(), observables.end());
    for (const std::string& name : names)
        text += row(quantity_name(name).with_unit(), name, runs,
                    [&](const output::Summary& s) { return observed(s, name); });
    using Getter = double (*)(const output::Summary&);
    const std::pair<const char*, Getter> rest[] = {
        {"Volume, largest relative change", [](const output::Summary& s) { return s.conservation.volume; }},
        {"Area, largest relative change", [](const output::Summary& s) { return s.conservation.area; }},
        {"Mean density per strain unit",
         [](const output::Summary& s) { return s.conservation.mean_density_per_strain; }},
        {"Displacement of the centroid, \xC2\xB5m",
         [](const output::Summary& s) { return s.conservation.centroid_um; }},
        {"Steps", [](const output::Summary& s) { return s.performance.steps; }},
        {"Wall time, s", [](const output::Summary& s) { return s.performance.wall_s; }},
        {"Processor time, s", [](const output::Summary& s) { return s.performance.cpu_s; }},
        {"Peak memory, MiB", [](const output::Summary& s) { return s.performance.peak_rss_mib; }}};
    for (const auto& [heading, get] : rest)
        if (std::any_of(runs.begin(), runs.end(), [get = get](const RunRecord& run) {
                return run.summary && std::isfinite(get(*run.summary));
            }))
            text += row(heading, heading, runs,
                        [get = get](const output::Summary& s) { return number(get(s), 3); });
    for (const std::string& name : errors)
        text += row("Estimated error: " + quantity_name(name).text + ", %", name, runs,
                    [&](const output::Summary& s) {
                        const auto found = s.errors_estimated.find(name);
                        return number(found == s.errors_estimated.end() ? NAN : 100 * found->second, 3);
                    });
    return text + "</tbody></table></div>\n";
}

std::vector<Chart> overlaid(const std::vector<RunRecord>& runs, const std::vector<RunCharts>& charts) {
    std::vector<Chart> out;
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (const Chart& chart : charts[i].charts) {
            auto under =
                std::find_if(out.begin(), out.end(), [&](const Chart& c) { return alike(c, chart); });
            if (under == out.end()) {
                under = out.insert(out.end(), chart);
                under->plot.curves.clear();
                under->plot.bands.clear();
                under->window.reset();
                under->note.clear();
            }
            lay_over(*under, chart, runs[i].name, i);
        }
    return out;
}

}  // namespace hemoflux::report
