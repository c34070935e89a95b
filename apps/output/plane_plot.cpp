#include "apps/output/plane_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "apps/output/child.hpp"
#include "apps/output/gnuplot_text.hpp"

namespace hemoflux::output {
namespace {

void add_lines(std::string& script, const std::vector<Polyline>& lines) {
    for (const Polyline& line : lines) {
        for (const auto& [x, y] : line) fmt::format_to(std::back_inserter(script), "{:.6g} {:.6g}\n", x, y);
        script += "\n";
    }
}

std::string script_of(const PlanePlot& p, const std::filesystem::path& path) {
    const auto& [x, y] = p.lattice;
    const double width = x.back() - x.front(), height = y.back() - y.front();
    const bool keyed =
        std::any_of(p.lines.begin(), p.lines.end(), [](const LineSet& l) { return !l.label.empty(); });
    // the plane fills what titles, colours and key leave
    const double across = std::min(900.0, 900.0 * width / height), scale = across / width;
    const int wide = static_cast<int>(across + (p.colour.empty() ? 0 : 170) + (keyed ? 190 : 0) + 160),
              high = static_cast<int>(scale * height + 190);
    std::string s = fmt::format(
        "set terminal pngcairo size {},{} font 'DejaVu Sans,15'\nset output {}\n"
        "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n"
        "set size ratio -1\nset xrange [{}:{}]\nset yrange [{}:{}]\nset tics out nomirror\n"
        "set border lc rgb '#404040'\n",
        wide, high, quoted(path.string()), quoted(p.title), quoted(p.x_label), quoted(p.y_label), x.front(),
        x.back(), y.front(), y.back());
    s += keyed ? "set key outside right top vertical Left reverse noenhanced samplen 1.5\n" : "unset key\n";
    std::string plots;
    const auto add = [&plots](const std::string& item) {
        plots += (plots.empty() ? "plot " : ", \\\n  ") + item;
    };
    if (!p.colour.empty()) {
        // viridis, read as well in grey and by colour-blind readers
        s += "set palette defined (0 '#440154', 1 '#414487', 2 '#2a788e', 3 '#22a884', 4 '#7ad151', 5 "
             "'#fde725')\n";
        s += fmt::format("set cblabel {} noenhanced\n$colour << END\n", quoted(p.colour_label));
        for (std::size_t j = 0; j < y.size(); ++j)
            for (std::size_t i = 0; i < x.size(); ++i)
                fmt::format_to(std::back_inserter(s), "{:.6g} {:.6g} {:.5g}\n", x[i], y[j],
                               p.colour[p.lattice.at(i, j)]);
        s += "END\n";
        add("$colour using 1:2:3 with image notitle");
    }
    for (std::size_t l = 0; l < p.lines.size(); ++l) {
        const LineSet& set = p.lines[l];
        if (set.lines.empty()) continue;
        s += fmt::format("$lines{} << END\n", l);
        add_lines(s, set.lines);
        s += "END\n";
        add(fmt::format("$lines{} with lines lw {} lc rgb '{}' {}", l, set.width, set.colour,
                        set.label.empty() ? "notitle" : "title " + quoted(set.label)));
    }
    if (!p.body.empty()) {
        s += "$body << END\n";
        add_lines(s, {p.body});
        s += "END\n";
        add("$body with filledcurves closed fillstyle solid 1 border lc rgb '#404040' fc rgb '#b0b0b0' "
            "notitle");
    }
    return s + plots + "\n";
}

}  // namespace

std::optional<std::string> plot_plane(const PlanePlot& spec, const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    if (!find_program("gnuplot"))
        return "no picture " + name + ": gnuplot is missing (Debian package gnuplot-nox)";
    const bool empty =
        spec.colour.empty() && spec.body.empty() &&
        std::all_of(spec.lines.begin(), spec.lines.end(), [](const LineSet& l) { return l.lines.empty(); });
    if (empty) return "no picture " + name + ": there is nothing to draw";
    const ChildResult result = run_child({"gnuplot", "-"}, script_of(spec, path), std::chrono::seconds(60));
    if (!result.ok()) return "no picture " + name + ": gnuplot: " + result.why();
    return std::nullopt;
}

}  // namespace hemoflux::output
