#include <fmt/format.h>
#include <sys/resource.h>

#include "apps/output/summary.hpp"

namespace hemoflux::output {
namespace {

std::string interval(const Reference& r) {
    if (r.low && r.high) return fmt::format("{:.6g} .. {:.6g}", *r.low, *r.high);
    if (r.low) return fmt::format(">= {:.6g}", *r.low);
    if (r.high) return fmt::format("<= {:.6g}", *r.high);
    return "-";
}

const char* word(Comparison::Verdict verdict) {
    switch (verdict) {
        case Comparison::Verdict::inside:
            return "inside";
        case Comparison::Verdict::outside:
            return "OUTSIDE";
        case Comparison::Verdict::reported:
            return "reported";
    }
    return "";
}

void add(std::string& text, const char* name, double value, const char* format) {
    if (std::isfinite(value))
        text += fmt::format("  {:<33} {}\n", name, fmt::format(fmt::runtime(format), value));
}

void add_references(std::string& text, const Summary& summary) {
    const auto comparisons = compare(summary);
    if (comparisons.empty()) return;
    text += fmt::format("Against references\n  {:<34}{:>12}{:>12}{:>11}  {:<20}{}\n", "", "this run",
                        "reference", "delta", "accepted", "");
    for (const auto& c : comparisons) {
        const auto& reference = c.reference.reference;
        text += fmt::format("  {:<33} {:>12.6g}{:>12}{:>11}  {:<20}{}\n", c.name, c.value,
                            reference ? fmt::format("{:.6g}", *reference) : "-",
                            c.relative ? fmt::format("{:+.2f} %", 100 * *c.relative) : "-",
                            interval(c.reference), word(c.verdict));
        if (!c.reference.source.empty()) text += fmt::format("    {}\n", c.reference.source);
    }
}

}  // namespace

std::string to_table(const Summary& s) {
    std::string text = fmt::format("{}   hemoflux {}, {}, {} thread{}\n", s.case_name, s.version, s.backend,
                                   s.threads, s.threads == 1 ? "" : "s");
    add_references(text, s);
    std::string rest;
    for (const auto& [name, label] : s.labels) rest += fmt::format("  {:<33} {}\n", name, label);
    for (const auto& [name, value] : s.observables)
        if (!s.references.contains(name)) rest += fmt::format("  {:<33} {:.6g}\n", name, value);
    if (!rest.empty()) text += "Observables\n" + rest;

    std::string kept;
    add(kept, "volume, largest relative change", s.conservation.volume, "{:.2e}");
    add(kept, "area, largest relative change", s.conservation.area, "{:.2e}");
    add(kept, "mean density per strain unit", s.conservation.mean_density_per_strain, "{:.2e}");
    add(kept, "centroid displacement", s.conservation.centroid_um, "{:.4f} um");
    if (!kept.empty()) text += "Conservation\n" + kept;

    std::string errors;
    for (const auto& [name, value] : s.errors_estimated) add(errors, name.c_str(), 100 * value, "{:.3g} %");
    if (!errors.empty()) text += "Estimated errors\n" + errors;

    std::string speed;
    add(speed, "wall time", s.performance.wall_s, "{:.1f} s");
    add(speed, "processor time", s.performance.cpu_s, "{:.1f} s");
    add(speed, "steps", s.performance.steps, "{:.0f}");
    add(speed, "residuals per strain unit", s.performance.residuals_per_strain, "{:.0f}");
    add(speed, "cell residuals per second", s.performance.cell_residuals_per_s, "{:.3g}");
    add(speed, "peak memory", s.performance.peak_rss_mib, "{:.0f} MiB");
    if (!speed.empty()) text += "Performance\n" + speed;
    return text;
}

double peak_rss_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace hemoflux::output
