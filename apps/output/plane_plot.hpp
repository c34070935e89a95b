/// Pictures of a plane through a flow by gnuplot: a coloured field, contour lines, streamlines, a body.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/plane_field.hpp"

namespace hemoflux::output {

/// Lines of one kind.
struct LineSet {
    std::string label;  ///< in the key; empty: not in it
    std::string colour = "#202020";
    double width = 1;
    std::vector<Polyline> lines;
};

/// What to draw; texts are shown as they are.
struct PlanePlot {
    std::string title, x_label, y_label, colour_label;
    Lattice lattice;
    std::vector<double> colour = {};  ///< a field, NaN: left white; empty: no colours
    std::vector<LineSet> lines = {};
    Polyline body = {};  ///< outline, filled; empty: none
};

/// Draws path (PNG). Returns nothing on success, else one line saying why there is no picture.
std::optional<std::string> plot_plane(const PlanePlot& spec, const std::filesystem::path& path);

}  // namespace hemoflux::output
