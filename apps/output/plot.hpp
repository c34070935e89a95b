/// Line plots by gnuplot.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hemoflux::output {

/// One curve or set of points.
struct Curve {
    std::string label;
    std::vector<double> x, y;                     ///< of equal size; NaN breaks the line
    bool points = false;                          ///< symbols (measurements, references) in place of a line
    std::vector<double> y_error = {};             ///< half-widths of error bars, with points; empty: none
    std::vector<double> y_low = {}, y_high = {};  ///< ends of error bars, with points, in place of y_error
    int colour = -1;                              ///< number in the palette; -1: the next one
    bool dashed = false;                          ///< a broken line
};

/// A horizontal band: an accepted interval, or a single value when low == high.
struct Band {
    std::string label;
    double low, high;
};

/// What to plot; all texts are shown as they are.
struct PlotSpec {
    std::string title, x_label, y_label;
    std::vector<Curve> curves;
    std::vector<Band> bands = {};
    bool log_x = false, log_y = false;
    std::optional<double> y_low = {}, y_high = {};  ///< range of the y axis; automatic where left out
};

/// Draws stem.svg and stem.png. Returns nothing on success, else one line saying why there is no plot (no
/// gnuplot, no finite data, its message): a run never fails for want of a picture.
std::optional<std::string> plot(const PlotSpec& spec, const std::filesystem::path& stem);

/// The gnuplot script that draws a plot into path with this terminal (a gnuplot "set terminal" argument).
std::string gnuplot_script(const PlotSpec& spec, const std::string& terminal,
                           const std::filesystem::path& path);

}  // namespace hemoflux::output
