#include "apps/report/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/report/html.hpp"
#include "apps/report/quantity_name.hpp"

namespace hemoflux::report {
namespace {

std::string optional_number(const std::optional<double>& value) {
    return value ? number(*value) : number(NAN);
}

/// A value with its unit.
std::string with_unit(const std::string& key, double value) {
    if (key == "converged") return value == 1 ? "yes" : "no";
    const std::string unit = quantity_name(key).unit;
    if (unit.empty() || !std::isfinite(value)) return number(value);
    return number(value) + " <span class=\"unit\">" + escape(unit) + "</span>";
}

/// A cell whose heading is repeated on narrow screens.
std::string cell(const char* heading, const std::string& html, const char* kind = "num") {
    return fmt::format("<td class=\"{}\" data-label=\"{}\"><span>{}</span></td>", kind, heading, html);
}

std::string name_cell(const std::string& key) {
    return fmt::format("<th scope=\"row\" data-observable=\"{}\">{}</th>", escape(key),
                       escape(quantity_name(key).text));
}

void add(std::vector<Row>& rows, const char* name, double value, const std::string& unit = "") {
    if (std::isfinite(value))
        rows.push_back({name, number(value, 3) + (unit.empty() ? "" : "&nbsp;" + unit)});
}

std::string referenced(const output::Summary& summary) {
    const auto comparisons = output::compare(summary);
    if (comparisons.empty()) return "";
    std::string text =
        "<table class=\"results\"><thead><tr><th scope=\"col\">Against references</th><th scope=\"col\">This "
        "run</th>"
        "<th scope=\"col\">Reference</th><th scope=\"col\">Difference</th><th scope=\"col\">Accepted</th>"
        "<th scope=\"col\"></th></tr></thead><tbody>\n";
    for (const auto& c : comparisons) {
        text += fmt::format(
            "<tr>{}{}{}{}{}{}</tr>\n", name_cell(c.name), cell("This run", with_unit(c.name, c.value)),
            cell("Reference", optional_number(c.reference.reference)),
            cell("Difference", c.relative ? percentage(*c.relative) : number(NAN)),
            cell("Accepted", interval(c.reference)), cell("Verdict", verdict(c.verdict), "verdict"));
        if (!c.reference.source.empty())
            text += fmt::format("<tr class=\"source\"><td colspan=\"6\">{}</td></tr>\n",
                                escape(c.reference.source));
    }
    return text + "</tbody></table>\n";
}

}  // namespace

std::string verdict(output::Comparison::Verdict verdict) {
    switch (verdict) {
        case output::Comparison::Verdict::inside:
            return "<span class=\"inside\">\xE2\x9C\x93&nbsp;inside</span>";
        case output::Comparison::Verdict::outside:
            return "<span class=\"outside\">\xE2\x9C\x97&nbsp;OUTSIDE</span>";
        case output::Comparison::Verdict::reported:
            return "<span class=\"reported\">reported</span>";
    }
    return "";
}

std::string interval(const output::Reference& r) {
    if (r.low && r.high) return number(*r.low) + " to " + number(*r.high);
    if (r.low) return "\xE2\x89\xA5&nbsp;" + number(*r.low);
    if (r.high) return "\xE2\x89\xA4&nbsp;" + number(*r.high);
    return number(NAN);
}

std::string observables_table(const output::Summary& summary) {
    std::string rest;
    for (const auto& [name, label] : summary.labels)
        rest += fmt::format("<tr>{}<td>{}</td></tr>\n", name_cell(name), escape(label));
    for (const auto& [name, value] : summary.observables) {
        if (summary.references.contains(name)) continue;
        rest += fmt::format("<tr>{}<td>{}</td></tr>\n", name_cell(name), with_unit(name, value));
    }
    return referenced(summary) +
           (rest.empty() ? ""
                         : "<table class=\"pairs columns\"><caption>Observables</caption><tbody>\n" + rest +
                               "</tbody></table>\n");
}

std::string quality_tables(const output::Summary& s) {
    std::vector<Row> kept, errors, speed;
    add(kept, "Volume, largest relative change", s.conservation.volume);
    add(kept, "Area, largest relative change", s.conservation.area);
    add(kept, "Mean density per strain unit", s.conservation.mean_density_per_strain);
    add(kept, "Displacement of the centroid", s.conservation.centroid_um, "\xC2\xB5m");
    for (const auto& [name, value] : s.errors_estimated)
        if (std::isfinite(value))
            errors.push_back({quantity_name(name).text, number(100 * value, 3) + "&nbsp;%"});
    add(speed, "Wall time", s.performance.wall_s, "s");
    add(speed, "Processor time", s.performance.cpu_s, "s");
    add(speed, "Steps", s.performance.steps);
    add(speed, "Residuals per strain unit", s.performance.residuals_per_strain);
    if (std::isfinite(s.performance.cell_residuals_per_s))
        speed.push_back({"Cell residuals per second",
                         number(s.performance.cell_residuals_per_s / 1e6, 3) + "&nbsp;million"});
    add(speed, "Peak memory", s.performance.peak_rss_mib, "MiB");
    return "<div class=\"side\">\n" + pairs("Conservation", kept) + pairs("Estimated errors", errors) +
           pairs("Speed", speed) + "</div>\n";
}

std::string sweep_runs_table(const RunRecord& run) {
    if (!run.sweep) return "";
    const SweepTable& table = *run.sweep;
    std::string text =
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Runs of the sweep\">"
        "<table class=\"grid\"><caption>Runs</caption><thead><tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        text += fmt::format(
            "<th scope=\"col\">{}</th>",
            escape(c < table.keys ? table.columns[c] : quantity_name(table.columns[c]).with_unit()));
    text += "</tr></thead><tbody>\n";
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        text += "<tr>";
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const std::string& value = table.rows[i][c];
            double v = NAN;
            const auto [stop, error] = std::from_chars(value.data(), value.data() + value.size(), v);
            const bool numeric = error == std::errc() && stop == value.data() + value.size();
            text += c < table.keys ? "<th scope=\"row\">" + escape(value) + "</th>"
                                   : "<td>" + (numeric ? number(v) : escape(value)) + "</td>";
        }
        text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
}

std::string scales_table(const RunRecord& run) {
    // the runs of a sweep choose their own
    const NamedTexts summary = run.is_sweep() ? NamedTexts{} : start_summary(run.log);
    std::vector<Row> chosen, converted;
    for (const auto& [name, value] : summary)
        if (name != "conversion") chosen.push_back({name, escape(value)});
    for (const auto& [name, value] : conversion(summary)) converted.push_back({name, escape(value)});
    if (run.kind == "membrane" || (run.is_sweep() && run.text("kind") == "membrane"))
        converted = {{"length 1", "1&nbsp;\xC2\xB5m"},
                     {"force 1",
                      "10<sup>\xE2\x88\x92"
                      "11</sup>&nbsp;N"},
                     {"tension 1",
                      "10<sup>\xE2\x88\x92"
                      "5</sup>&nbsp;N/m"},
                     {"energy 1",
                      "10<sup>\xE2\x88\x92"
                      "17</sup>&nbsp;J"},
                     {"pressure 1", "10&nbsp;Pa"},
                     {"time 1",
                      "10<sup>\xE2\x88\x92"
                      "5</sup>&nbsp;s"}};
    return pairs("Conversion to computed units", converted) + pairs("As chosen at the start", chosen);
}

std::string environment_table(const RunRecord& run) {
    std::vector<Row> rows;
    const auto add_text = [&rows](const std::string& name, const std::string& value) {
        if (!value.empty()) rows.push_back({name, escape(value)});
    };
    const NamedTexts logged = environment(run.log);
    const auto from_log = [&logged](const std::string& name) {
        const auto found =
            std::find_if(logged.begin(), logged.end(), [&](const auto& one) { return one.first == name; });
        return found == logged.end() ? std::string() : found->second;
    };
    add_text("Hemoflux", run.summary ? run.summary->version : from_log("version"));
    add_text("Backend", run.summary ? run.summary->backend : from_log("backend"));
    add_text("Threads", run.summary ? std::to_string(run.summary->threads) : from_log("threads"));
    add_text("Processor", from_log("processor"));
    if (!run.log.empty()) {
        add_text("Begun", run.log.front().date);
        add_text(run.status.ending == Ending::finished ? "Finished" : "Last message", run.log.back().date);
    }
    add_text("Folder", run.folder.string());
    return pairs("Environment", rows);
}

}  // namespace hemoflux::report
