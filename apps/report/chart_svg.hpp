/// Charts as inline SVG, coloured by the style sheet of the page.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/output/plot.hpp"

namespace hemoflux::report {

/// What to draw. Charts of several runs with the same key show the same and are laid over each other.
struct Chart {
    std::string key;
    output::PlotSpec plot;  ///< curves, reference bands, labels
    std::optional<std::array<double, 2>> window =
        {};                     ///< the part of the x axis over which observables are averaged
    std::string note = {};      ///< shown below; what is left out
    std::string replaces = {};  ///< stem of the plot_*.svg of the run that shows the same
};

/// Whether there is anything to draw.
bool has_data(const Chart& chart);

/// The chart as a figure element: title, SVG with axes, units, bands and curves, legend below. Long curves are thinned
/// so that every peak stays. Curves keep their order as colours unless they name one.
std::string chart_svg(const Chart& chart);

}  // namespace hemoflux::report
