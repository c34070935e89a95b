#include "apps/report/page.hpp"

#include <fmt/format.h>

#include "apps/report/animation.hpp"
#include "apps/report/assets.hpp"
#include "apps/report/charts.hpp"
#include "apps/report/comparison.hpp"
#include "apps/report/description.hpp"
#include "apps/report/html.hpp"
#include "apps/report/results.hpp"

namespace hemoflux::report {
namespace fs = std::filesystem;
namespace {

std::string section(const std::string& id, const std::string& heading, const std::string& content) {
    if (content.empty()) return "";
    return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escape(heading), content);
}

std::string badge(const RunRecord& run) {
    const char* kind = run.status.ending == Ending::finished ? "finished"
                       : run.status.ending == Ending::failed ? "failed"
                                                             : "open";
    return fmt::format(
        "<p class=\"badges\"><span class=\"badge\">{}</span> <span class=\"badge {}\">{}</span></p>\n",
        escape(kind_in_words(run)), kind, escape(run.status.word));
}

/// Why a run is not finished, what is missing, and its warnings.
std::string notices(const RunRecord& run) {
    std::string text;
    if (!run.status.message.empty())
        text +=
            fmt::format("<p class=\"notice strong\" role=\"alert\"><strong>{}.</strong> {}</p>\n",
                        run.status.ending == Ending::failed ? "This run failed" : "This run is not finished",
                        escape(run.status.message));
    for (const std::string& missing : run.missing)
        text += "<p class=\"notice\">" + escape(missing) + ".</p>\n";
    for (const LogEntry& entry : run.log)
        if (entry.level == "warning" && !entry.text.starts_with("interrupted"))
            text += "<p class=\"notice\">Warning of the run: " + escape(entry.text) + "</p>\n";
    return text;
}

std::string results(const RunRecord& run) {
    std::string text = sweep_runs_table(run);
    if (run.summary) text += observables_table(*run.summary) + quality_tables(*run.summary);
    if (run.is_sweep())
        text +=
            "<p class=\"note\">Each run is in a folder of its own, run_00, run_01, \xE2\x80\xA6, of which "
            "hemoflux report "
            "makes a page too.</p>\n";
    else if (!run.summary)
        text += "<p class=\"note\">There are no results: the run has not come to its end.</p>\n";
    return text;
}

std::string figures(const std::vector<Chart>& charts, const std::vector<fs::path>& plots) {
    std::string text;
    for (const Chart& chart : charts) text += chart_svg(chart);
    for (const fs::path& plot : plots) {
        const std::string name = plot.stem().string();
        text += fmt::format(
            "<figure class=\"chart\"><img class=\"paper\" alt=\"{0}\" src=\"{1}\"><figcaption "
            "class=\"below\">{0}</figcaption></figure>\n",
            escape(name), data_url(plot, "image/svg+xml"));
    }
    return text.empty() ? "" : "<div class=\"charts\">\n" + text + "</div>\n";
}

std::string pictures(const RunRecord& run) {
    std::string text;
    for (const fs::path& picture : run.pictures) {
        std::string name = picture.stem().string().substr(8);
        for (char& c : name) c = c == '_' ? ' ' : c;
        text += fmt::format(
            "<figure class=\"picture\"><img class=\"paper\" alt=\"{0}\" src=\"{1}\"><figcaption "
            "class=\"below\">{0}</figcaption></figure>\n",
            escape(name), data_url(picture, "image/png"));
    }
    return text.empty() ? "" : "<div class=\"pictures\">\n" + text + "</div>\n";
}

std::string case_file(const RunRecord& run) {
    return fmt::format(
        "<details><summary>Case file with every default ({})</summary><pre><code>{}</code></pre></details>\n",
        run.is_sweep() ? "sweep.toml" : "resolved.toml", escape(run.resolved));
}

/// What several runs do not share.
std::string details_of(const RunRecord& run) {
    return case_file(run) + "<div class=\"side\">\n" + scales_table(run) + environment_table(run) +
           "</div>\n";
}

std::string heading_of_cells(const RunRecord& run) {
    if (run.kind == "coupled") return "Cell in motion";
    return run.kind == "membrane" ? "Shapes of the cell" : "Bodies in motion";
}

std::string one_run(const RunRecord& run) {
    const RunCharts charts = charts_of(run);
    return fmt::format("<header>\n{}<h1>{}</h1>\n<p class=\"lead\">{}</p>\n{}</header>\n", badge(run),
                       escape(run.title), escape(description(run)), notices(run)) +
           section("results", "Results", results(run)) +
           section("cell", heading_of_cells(run), animation(run)) +
           section("plots", "Plots", figures(charts.charts, charts.plots)) +
           section("pictures", "Pictures", pictures(run)) +
           section("case", "Case, scales, environment", details_of(run));
}

std::string several_runs(const std::vector<RunRecord>& runs) {
    std::string names, cells, details;
    std::vector<RunCharts> charts;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const RunRecord& run = runs[i];
        charts.push_back(charts_of(run));
        names +=
            fmt::format("<li><a href=\"#run-{}\">{}</a>: {}</li>\n", i, escape(run.name), escape(run.title));
        cells += animation(run, most_animation_bytes / runs.size());
        details += fmt::format("<section id=\"run-{}\">\n{}<h2>{}: {}</h2>\n<p class=\"lead\">{}</p>\n{}{}",
                               i, badge(run), escape(run.name), escape(run.title), escape(description(run)),
                               notices(run), results(run));
        details += figures({}, charts.back().plots) + pictures(run) + details_of(run) + "</section>\n";
    }
    return fmt::format("<header>\n<h1>Comparison of {} runs</h1>\n<ul class=\"lead\">\n{}</ul>\n</header>\n",
                       runs.size(), names) +
           section("results", "Results", comparison_table(runs)) +
           section("cell", "Cells in motion",
                   cells.empty() ? "" : "<div class=\"viewers\">\n" + cells + "</div>\n") +
           section("plots", "Plots", figures(overlaid(runs, charts), {})) + details;
}

}  // namespace

std::string build_page(const std::vector<RunRecord>& runs) {
    const std::string title =
        runs.size() == 1 ? runs.front().title : fmt::format("Comparison of {} runs", runs.size());
    const std::string body = runs.size() == 1 ? one_run(runs.front()) : several_runs(runs);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n<link rel=\"icon\" "
        "href=\"data:,\">\n"
        "<style>\n{}</style>\n</head>\n<body>\n<main>\n{}</main>\n<footer>Made by hemoflux {} from the "
        "output folder{} of "
        "the run{}.</footer>\n<script>\n{}</script>\n</body>\n</html>\n",
        escape(title), page_css, body, HEMOFLUX_VERSION, runs.size() == 1 ? "" : "s",
        runs.size() == 1 ? "" : "s", viewer_js);
}

}  // namespace hemoflux::report
