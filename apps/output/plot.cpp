#include "apps/output/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/output/child.hpp"
#include "apps/output/gnuplot_text.hpp"

namespace hemoflux::output {
namespace {

// Okabe and Ito's colours, told apart by colour-blind readers as well
constexpr const char* colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#000000"};

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] bool empty() const { return low > high; }
};

/// Ends of the error bar of a point; the point itself where it has none.
std::array<double, 2> bar(const Curve& c, std::size_t i) {
    if (i < c.y_low.size() && i < c.y_high.size() && std::isfinite(c.y_low[i]) && std::isfinite(c.y_high[i]))
        return {c.y_low[i], c.y_high[i]};
    const double e = i < c.y_error.size() && std::isfinite(c.y_error[i]) ? c.y_error[i] : 0.0;
    return {c.y[i] - e, c.y[i] + e};
}

/// The y range that shows all curves and bands, with some air; gnuplot's own ignores bands.
std::string y_range(const PlotSpec& spec) {
    Range range;
    for (const Curve& c : spec.curves)
        for (std::size_t i = 0; i < c.y.size(); ++i) {
            const auto [low, high] = bar(c, i);
            range.include(low);
            range.include(high);
        }
    for (const Band& b : spec.bands) {
        range.include(b.low);
        range.include(b.high);
    }
    const double air = range.high > range.low ? 0.08 * (range.high - range.low)
                       : range.high != 0      ? 0.1 * std::abs(range.high)
                                              : 1;
    const auto end = [&](const std::optional<double>& given, double automatic) {
        if (given) return fmt::format("{}", *given);
        return spec.log_y || range.empty() ? std::string("*") : fmt::format("{}", automatic);
    };
    return fmt::format("[{}:{}]", end(spec.y_low, range.low - air), end(spec.y_high, range.high + air));
}

bool has_data(const PlotSpec& spec) {
    for (const Curve& c : spec.curves)
        for (std::size_t i = 0; i < c.x.size(); ++i)
            if (std::isfinite(c.x[i]) && std::isfinite(c.y[i])) return true;
    return false;
}

}  // namespace

std::string gnuplot_script(const PlotSpec& spec, const std::string& terminal,
                           const std::filesystem::path& path) {
    std::string s = fmt::format("set terminal {}\nset output {}\n", terminal, quoted(path.string()));
    s += fmt::format("set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                     quoted(spec.title), quoted(spec.x_label), quoted(spec.y_label));
    s += "set border 3 lc rgb '#404040'\nset tics nomirror out\nset grid lc rgb '#e0e0e0' lt 1\n"
         "set key outside bottom center horizontal Left reverse noenhanced height 1\nset datafile missing "
         "'nan'\n";
    if (spec.log_x) s += "set logscale x\n";
    if (spec.log_y) s += "set logscale y\n";
    s += fmt::format("set yrange {}\n", y_range(spec));
    for (std::size_t c = 0; c < spec.curves.size(); ++c) {
        const Curve& curve = spec.curves[c];
        s += fmt::format("$curve{} << END\n", c);
        for (std::size_t i = 0; i < curve.x.size(); ++i) {
            // a blank line breaks the drawn line
            if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
                s += "\n";
                continue;
            }
            const auto [low, high] = bar(curve, i);
            s += fmt::format("{} {} {} {}\n", curve.x[i], curve.y[i], low, high);
        }
        s += "END\n";
    }
    std::string plots;
    const auto add = [&plots](const std::string& item) {
        plots += (plots.empty() ? "plot " : ", \\\n  ") + item;
    };
    for (std::size_t b = 0; b < spec.bands.size(); ++b) {
        const Band& band = spec.bands[b];
        if (band.low < band.high) {
            s += fmt::format(
                "set object {} rectangle from graph 0, first {} to graph 1, first {} behind fillcolor rgb "
                "'#009E73' fillstyle solid 0.18 noborder\n",
                b + 1, band.low, band.high);
            add(fmt::format("keyentry with boxes fillstyle solid 0.18 noborder lc rgb '#009E73' title {}",
                            quoted(band.label)));
        } else {
            add(fmt::format("{} with lines dashtype 2 lw 1.5 lc rgb '#404040' title {}", band.low,
                            quoted(band.label)));
        }
    }
    std::size_t points = 0;
    for (std::size_t c = 0; c < spec.curves.size(); ++c) {
        const Curve& curve = spec.curves[c];
        const char* colour =
            colours[(curve.colour < 0 ? c : static_cast<std::size_t>(curve.colour)) % std::size(colours)];
        // a filled dot, then open symbols around it, so that points on top of each other are all seen
        constexpr int symbols[] = {7, 6, 4, 8, 10, 12};
        // points without a name belong to those before
        const std::size_t which = curve.label.empty() && points > 0 ? points - 1 : points;
        const std::string symbol = fmt::format("pointtype {} pointsize {}",
                                               symbols[which % std::size(symbols)], which == 0 ? 0.9 : 1.4);
        if (curve.points && !curve.label.empty()) ++points;
        const bool bars = !curve.y_error.empty() || !curve.y_low.empty();
        const std::string style = !curve.points ? (curve.dashed ? "using 1:2 with lines dashtype 2 lw 2"
                                                                : "using 1:2 with lines lw 2")
                                  : bars        ? "using 1:2:3:4 with yerrorbars " + symbol
                                                : "using 1:2 with points " + symbol;
        add(fmt::format("$curve{} {} lc rgb '{}' title {}", c, style, colour, quoted(curve.label)));
    }
    return s + plots + "\n";
}

std::optional<std::string> plot(const PlotSpec& spec, const std::filesystem::path& stem) {
    for (const Curve& c : spec.curves)
        if (c.x.size() != c.y.size())
            return "no plot " + stem.filename().string() + ": x and y differ in size";
    if (!has_data(spec)) return "no plot " + stem.filename().string() + ": there are no data";
    if (!find_program("gnuplot"))
        return "no plot " + stem.filename().string() + ": gnuplot is missing (Debian package gnuplot-nox)";
    auto svg = stem, png = stem;
    svg += ".svg";
    png += ".png";
    const std::string script =
        gnuplot_script(spec, "svg size 900,600 font 'DejaVu Sans,14' background 'white'", svg) +
        "unset output\nreset\n" +
        gnuplot_script(spec, "pngcairo size 1350,900 font 'DejaVu Sans,16' linewidth 1.5", png);
    const ChildResult result = run_child({"gnuplot", "-"}, script, std::chrono::seconds(60));
    if (!result.ok()) return "no plot " + stem.filename().string() + ": gnuplot: " + result.why();
    return std::nullopt;
}

}  // namespace hemoflux::output
